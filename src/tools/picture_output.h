// Where a render goes: the picture or part that it ends as, and, while it lasts, the picture so far and a
// checkpoint beside it, from which --resume goes on.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "render/render.h"
#include "tools/identity.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// "fog.exr.checkpoint", the file beside an output. It is written as parts are (render/film/part_file.h).
std::string checkpoint_path(const std::string& output);

// Removes it, if there is one.
void remove_checkpoint(const std::string& output);

// Why nothing can be written to a path, as image::check_writable() tells it; it may be a part's.
std::string output_path_problem(const std::string& path);

class PictureOutput {
 public:
  // `scene` and `arguments` outlive it.
  PictureOutput(const RenderArguments& arguments, const scene::Scene& scene, PictureIdentity identity);

  // What an earlier run left, with --resume. It is warned of what is of no use, and of what is there and not
  // asked for.
  std::optional<render::Unfinished> unfinished(const compile::CompiledScene& world,
                                               const render::RenderOptions& options);
  // Whether it is time for save(); may be called by any thread.
  bool is_due(double seconds) const { return seconds >= next_; }
  // Writes the checkpoint and the picture so far when it is time. What fails is told at once, and rendering
  // goes on: what was written before stays.
  void save(const render::Film& film, const render::Statistics& so_far, const std::string& rest);
  // Writes what the render ended as, and then removes the checkpoint; or, of a render that was stopped, a
  // checkpoint and the picture so far. A message, or an empty string.
  std::string finish(const render::RenderResult& result);

  // Removes the checkpoint of a render that ends without an output.
  void discard() const;

 private:
  image::Image picture(const render::Film& film) const;
  image::Metadata metadata(const render::Statistics& statistics) const;
  // Whether the output has become the whole picture since this run began, which --resume would have found: a
  // farm may run a task twice. A picture so far is no better.
  bool is_finished_by_another() const;
  std::string write_checkpoint(const render::Film& film, const std::string& rest);
  std::string write_output(const render::RenderResult& result) const;
  void tell_failure(const std::string& problem);

  const RenderArguments& arguments_;
  const scene::Scene& scene_;
  PictureIdentity identity_;
  std::string checkpoint_;    // its path; empty: a device or pipe has none
  std::atomic<double> next_;  // [s] of rendering
  bool told_failure_ = false;
};

}  // namespace tyndall::tools
