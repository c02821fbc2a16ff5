#include "tools/plan_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tools/files_in_use.h"
#include "tools/frame_source.h"
#include "tools/render_checks.h"
#include "tools/report.h"
#include "tools/sequence_checks.h"

namespace tyndall::tools {
namespace {

// Whole numbers that all frames have, or do not.
struct Samples {
  int least = 0, most = 0;

  void add(int samples) {
    least = least == 0 ? samples : std::min(least, samples);
    most = std::max(most, samples);
  }
};

ExitStatus end_with(const std::string& message) { return print_error(message), ExitStatus::problem; }

// Why the samples cannot be split.
std::string split_problem(const Samples& samples, int split) {
  if (split == 1) return {};
  if (samples.least != samples.most)
    return fmt::format("--split wants as many samples in each frame, and these have {} to {}: give --samples",
                       samples.least, samples.most);
  if (split > samples.least)
    return fmt::format(
        "--split {} wants as many samples of a pixel or more, and there {} {}: give --samples, or "
        "fewer parts",
        split, samples.least == 1 ? "is" : "are", samples.least);
  return {};
}

// Reads one frame; a problem is told.
ExitStatus check_frame(const RenderArguments& arguments, FrameSource& source, FilesInUse& files) {
  const bool is_good = source.read(arguments);
  source.tell_problems();
  if (!is_good) return ExitStatus::problem;
  if (const std::string problem = files.read_by_scene(source.text().files_read); !problem.empty())
    return end_with(problem);
  const scene::RenderSettings& settings = source.scene().settings;
  if (const std::string problem = settings_problem(arguments, settings); !problem.empty())
    return misuse(problem);
  if (const std::string ignored = what_is_ignored(arguments, settings);
      !ignored.empty() && source.is_news(ignored))
    print_warning(ignored);
  return ExitStatus::done;
}

}  // namespace

ExitStatus check_frames(const RenderArguments& given, int split, PlannedFrames& frames) {
  RenderArguments arguments = given;
  arguments.scene.warns_of_frame = false;
  std::error_code failed;
  if (const auto status = std::filesystem::status(arguments.scene.path, failed);
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return end_with(fmt::format("'{}' is no file that the tasks of a plan could read", arguments.scene.path));
  FrameSource source(arguments.scene, true);
  frames.numbers = frames_of(arguments, source);
  if (!is_sequence(arguments)) frames.numbers = {arguments.scene.frame.value_or(frames.numbers.front())};
  if (const std::string problem = frame_name_problem(arguments, frames.numbers.size()); !problem.empty())
    return misuse(problem);
  warn_of_frames_outside(frames.numbers, source, arguments.scene);

  Samples samples;
  ExitStatus worst = ExitStatus::done;
  for (const int frame : frames.numbers) {
    const RenderArguments one = of_frame(arguments, frame);
    FilesInUse files;
    if (const std::string problem = output_problem(one, files); !problem.empty()) return end_with(problem);
    const ExitStatus status = check_frame(one, source, files);
    if (status == ExitStatus::misuse || (status != ExitStatus::done && source.is_bad_at_all_times()))
      return status;
    if (status != ExitStatus::done)
      worst = status;
    else
      samples.add(source.scene().settings.samples);
  }
  if (worst != ExitStatus::done) return worst;
  if (const std::string problem = split_problem(samples, split); !problem.empty()) return misuse(problem);
  frames.samples = samples.least;
  return ExitStatus::done;
}

}  // namespace tyndall::tools
