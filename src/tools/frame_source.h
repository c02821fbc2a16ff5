// The frames of a scene, one after the other: its text is read once, and what frames have in common is kept
// from one to the next (resolve/kept.h, compile/kept.h).
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>

#include "compile/compiled_scene.h"
#include "compile/kept.h"
#include "tools/identity.h"
#include "tools/load.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

class FrameSource {
 public:
  // Reads the text; its problems are in text().diagnostics.
  FrameSource(const SceneRequest& request, bool is_sequence);

  // What is known of the text and of the frame that was read last.
  LoadedScene& text() { return *text_; }
  // What `animation` says, if anything.
  std::optional<scene::Animation> animation(const SceneRequest& request) const;

  // Reads the scene of the arguments' frame. False after an error, which is in text().diagnostics.
  bool read(const RenderArguments& arguments);
  // The frame that was read last, with the settings of the command line.
  const scene::Scene& scene() const { return world_ ? world_->scene : text_->scene; }
  const PictureIdentity& identity() const { return identity_; }
  const compile::CompiledScene& compiled();

  // Begins anew: what was kept is no longer right, or takes memory that is wanted.
  void forget();

  // What of the last frame was there from the frame before, for the statistics.
  nlohmann::json reuse_json() const;
  // Whether all frames are as bad as the one that was read last: its errors are not those of its time.
  bool is_bad_at_all_times() const;

  // Prints the problems of the last frame that it has not printed yet: all, or in a sequence those that no
  // frame before had.
  void tell_problems();
  // Whether a text, whatever its numbers, is asked about for the first time.
  bool is_news(const std::string& text);

 private:
  bool files_have_changed() const;
  scene::Scene& changing_scene() { return world_ ? world_->scene : text_->scene; }

  bool is_sequence_;
  std::unique_ptr<LoadedScene> text_;
  std::optional<scene::RenderSettings> own_settings_;  // of the last scene; nothing: there is none
  PictureIdentity identity_;
  std::map<std::string, std::string> files_;  // that are no text: paths with what hash_of_file said of them
  compile::Kept kept_;
  std::optional<compile::CompiledScene> world_;  // of the last scene, once it is asked for
  Diagnostics of_scene_;
  bool was_read_ = false, scene_is_kept_ = false;
  std::set<std::string> told_;
  std::size_t told_of_frame_ = 0;  // diagnostics of the last frame
};

}  // namespace tyndall::tools
