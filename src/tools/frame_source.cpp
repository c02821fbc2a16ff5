#include "tools/frame_source.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/content.h"
#include "tools/memory.h"
#include "tools/report.h"
#include "tools/setting_options.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {
namespace {

nlohmann::json counts(const Reuse& reuse) { return {{"kept", reuse.kept}, {"rebuilt", reuse.rebuilt}}; }

}  // namespace

FrameSource::FrameSource(const SceneRequest& request, bool is_sequence)
    : is_sequence_(is_sequence), text_(load(request, Stage::tree)) {}

std::optional<scene::Animation> FrameSource::animation(const SceneRequest& request) const {
  if (!text_->source.valid() || text_->diagnostics.full()) return std::nullopt;
  resolve::Options options;
  options.overrides = request.overrides;
  return resolve::animation_of(text_->tree, text_->sources, text_->symbols, options);
}

bool FrameSource::read(const RenderArguments& arguments) {
  text_->diagnostics = text_->of_text;
  told_of_frame_ = 0;
  if (!text_->source.valid() || text_->diagnostics.full()) return false;
  if (files_have_changed()) forget();
  scene_is_kept_ = own_settings_ && text_->kept.still;
  if (was_read_) text_->seconds = {};
  was_read_ = true;
  if (scene_is_kept_) {
    scene::Scene& scene = changing_scene();
    scene.settings = *own_settings_;
    scene.frame = arguments.scene.frame.value_or(scene.frame);
    const auto& animation = text_->kept.animation;
    scene.time = animation ? scene::opening_time(*animation, scene.frame) : 0;
    text_->diagnostics = of_scene_;
  } else {
    if (world_) compile::keep(*world_, kept_);
    world_.reset();
    own_settings_.reset();
    SceneRequest request = arguments.scene;
    request.amend_settings = [&](scene::RenderSettings& settings) { apply(arguments.settings, settings); };
    request.strict = arguments.strict;
    load_scene(request, *text_, is_sequence_ ? Keeps::for_other_frames : Keeps::nothing);
    of_scene_ = text_->diagnostics;
    if (text_->diagnostics.has_errors()) return false;
    own_settings_ = text_->scene.settings;
  }
  identity_ = identity_of(arguments, *text_, scene());
  files_.clear();
  for (const PictureIdentity::File& file : identity_.files)
    if (!file.is_text) files_[file.path] = file.hash;
  apply(arguments.settings, changing_scene().settings);
  return true;
}

void FrameSource::forget() {
  text_->kept.forget_files();
  own_settings_.reset();
  kept_ = {};
}

bool FrameSource::files_have_changed() const {
  const std::filesystem::path folder =
      std::filesystem::path(text_->sources[text_->source].name()).parent_path();
  return std::any_of(files_.begin(), files_.end(), [&](const auto& file) {
    return hash_of_file((folder / file.first).string()) != file.second;
  });
}

const compile::CompiledScene& FrameSource::compiled() {
  if (!world_)
    world_.emplace(with_memory("to compile the scene",
                               [&] { return compile::compile(std::move(text_->scene), kept_); }));
  return *world_;
}

nlohmann::json FrameSource::reuse_json() const {
  if (scene_is_kept_) return {{"scene", "kept"}};
  return {{"scene", "rebuilt"},
          {"files", counts(text_->kept.files)},
          {"meshes", counts(kept_.reused_meshes)},
          {"bounds", counts(kept_.reused_grids)}};
}

bool FrameSource::is_bad_at_all_times() const {
  return !text_->source.valid() || text_->of_text.has_errors() ||
         (text_->diagnostics.has_errors() && text_->kept.timeless);
}

bool FrameSource::is_news(const std::string& text) {
  std::string key = text;
  std::erase_if(key, [](unsigned char c) { return std::isdigit(c) != 0 || c == '.' || c == '-'; });
  return told_.insert(key).second;
}

void FrameSource::tell_problems() {
  const std::vector<Diagnostic>& all = text_->diagnostics.all();
  const std::size_t first = std::exchange(told_of_frame_, all.size());
  if (first == 0 && !is_sequence_) return print_diagnostics(text_->diagnostics, text_->sources);
  for (std::size_t i = first; i < all.size(); ++i) {
    const std::string text = render_text(all[i], text_->sources, error_output_has_color());
    if (!is_sequence_ || is_news(text)) print_message(text);
  }
}

}  // namespace tyndall::tools
