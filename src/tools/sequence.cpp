#include "tools/sequence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/frame_list.h"
#include "tools/memory.h"
#include "tools/movie.h"
#include "tools/part_facts.h"
#include "tools/picture_output.h"
#include "tools/progress.h"
#include "tools/render_checks.h"
#include "tools/render_frame.h"
#include "tools/renew_view.h"
#include "tools/report.h"
#include "tools/sequence_checks.h"
#include "tools/sequence_progress.h"
#include "tools/staleness.h"

namespace tyndall::tools {
namespace {

// What becomes of a sequence.
struct Tally {
  std::vector<int> missing, there;
  std::size_t rendered = 0, skipped = 0;
  bool interrupted = false;
  ExitStatus worst = ExitStatus::done;

  void count(int frame, const FrameOutcome& outcome) {
    interrupted = outcome.status == ExitStatus::interrupted;
    (outcome.status == ExitStatus::done ? there : missing).push_back(frame);
    skipped += outcome.is_skipped;
    rendered += !outcome.is_skipped && outcome.status == ExitStatus::done;
    if (worst == ExitStatus::done || interrupted) worst = outcome.status;
  }
};

std::string_view outcome_name(const FrameOutcome& outcome) {
  if (outcome.is_skipped) return "skipped";
  if (outcome.status == ExitStatus::interrupted) return "interrupted";
  return outcome.status == ExitStatus::done ? "rendered" : "failed";
}

// Whether the frame is there as it would be rendered; tells why not, where there is another picture.
bool is_there(const RenderArguments& arguments, FrameSource& source, SequenceProgress& progress) {
  std::error_code ignored;
  if (is_in_whole(arguments)) return true;
  if (arguments.overwrite || !std::filesystem::exists(arguments.output, ignored)) return false;
  std::vector<std::string> why = why_stale(arguments);
  if (const std::string& statistics = arguments.statistics_file;
      why.empty() && !statistics.empty() && !std::filesystem::exists(statistics, ignored))
    why.push_back(fmt::format("'{}' is not there", statistics));
  if (why.empty()) {
    remove_checkpoint(arguments.output);
    if (has_other_view(arguments))
      if (const std::string problem = renew_view(arguments, source); !problem.empty()) print_warning(problem);
    return true;
  }
  if (!arguments.quiet)
    print_message(fmt::format("'{}' is rendered again: {}\n", arguments.output, fmt::join(why, "; ")));
  progress.print_line({{"event", "stale"}, {"output", arguments.output}, {"why", why}});
  return false;
}

// "frame 7 of 48: rendered, 3:12 left".
std::string place_text(const RenderArguments& arguments, const FrameOutcome& outcome,
                       const SequenceProgress& progress) {
  const auto left = progress.seconds_left(1);
  return fmt::format("{}: {}{}\n", progress.place(),
                     outcome.is_skipped ? fmt::format("'{}' is there already", arguments.output)
                                        : std::string(outcome_name(outcome)),
                     left && *left > 0 ? fmt::format(", {} left", duration_text(*left)) : "");
}

// A frame that wants too much memory is a bad one; others may want less.
FrameOutcome rendered(const RenderArguments& arguments, const FrameSetting& setting) {
  try {
    return render_frame(arguments, setting);
  } catch (const OutOfMemory& error) {
    setting.source.forget();
    return failed_frame(fmt::format("there is not enough memory {}", error.what()));
  } catch (const std::bad_alloc&) {
    setting.source.forget();
    return failed_frame("there is not enough memory");
  }
}

FrameOutcome render_one(const RenderArguments& arguments, FrameSource& source, SequenceProgress& progress) {
  progress.print_line({{"event", "frame"}, {"output", arguments.output}});
  FilesInUse files;
  FrameOutcome outcome;
  if (const std::string problem = output_problem(arguments, files); !problem.empty())
    outcome = failed_frame(problem);
  else if (is_there(arguments, source, progress))
    outcome = {.status = ExitStatus::done, .report = {}, .is_skipped = true};
  else
    outcome = rendered(arguments, {source, files, &progress});
  progress.end_frame(!outcome.is_skipped && outcome.status == ExitStatus::done);
  if (!arguments.quiet) print_message(place_text(arguments, outcome, progress));
  nlohmann::json line{{"event", "done"}, {"output", arguments.output}, {"outcome", outcome_name(outcome)}};
  if (const auto left = progress.seconds_left(1)) line["seconds_left"] = *left;
  if (!outcome.report.is_null()) {
    line["diagnostics"] = std::move(outcome.report["diagnostics"]);
    outcome.report.erase("diagnostics");
    if (!outcome.report.empty()) line["statistics"] = std::move(outcome.report);
  }
  progress.print_line(std::move(line));
  return outcome;
}

// Shows what there is, in the order of time.
void make_movie(const RenderArguments& arguments, const FrameSource& source, Tally& tally) {
  std::sort(tally.there.begin(), tally.there.end());
  std::vector<std::string> pictures;
  for (const int frame : tally.there) pictures.push_back(numbered(arguments.output, frame));
  const auto animation = source.animation(arguments.scene);
  const std::string problem =
      write_movie(arguments.movie, pictures, arguments.view, animation.value_or(scene::Animation{}).fps);
  if (problem.empty()) {
    if (!arguments.quiet) print_message(fmt::format("{}: {} frames\n", arguments.movie, pictures.size()));
    return;
  }
  print_error(problem);
  if (tally.worst == ExitStatus::done) tally.worst = ExitStatus::problem;
}

ExitStatus summarize(const RenderArguments& arguments, const Tally& tally, double seconds) {
  if (!tally.missing.empty())
    print_error(
        fmt::format("'{}' lacks {}: {}", arguments.output,
                    tally.missing.size() == 1 ? "a frame" : fmt::format("{} frames", tally.missing.size()),
                    frames_text(tally.missing)));
  if (!arguments.quiet)
    print_message(fmt::format(
        "{}: {} frame{} rendered{} in {}\n", arguments.output, tally.rendered, tally.rendered == 1 ? "" : "s",
        tally.skipped ? fmt::format(", {} there already", tally.skipped) : "", duration_text(seconds)));
  if (arguments.json)
    print_json_line({{"event", "end"},
                     {"rendered", tally.rendered},
                     {"skipped", tally.skipped},
                     {"missing", tally.missing},
                     {"seconds", seconds}});
  return tally.worst;
}

}  // namespace

ExitStatus render_sequence(const RenderArguments& given) {
  RenderArguments arguments = given;
  arguments.scene.warns_of_frame = false;
  FrameSource source(arguments.scene, true);
  if (const std::string problem = arguments.movie.empty() ? "" : movie_problem(arguments.movie);
      !problem.empty())
    return print_error(problem), ExitStatus::problem;
  const std::vector<int> frames = frames_of(arguments, source);
  if (const std::string problem = frame_name_problem(arguments, frames.size()); !problem.empty())
    return misuse(problem);
  // The names as they are given: what is wrong with their folder or format is wrong for every frame.
  FilesInUse files;
  if (const std::string problem = output_problem(arguments, files); !problem.empty())
    return print_error(problem), ExitStatus::problem;
  warn_of_frames_outside(frames, source, arguments.scene);

  Stopwatch watch;
  SequenceProgress progress(frames.size(), arguments.json);
  Tally tally;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    progress.begin_frame(frames[i]);
    const FrameOutcome outcome = render_one(of_frame(arguments, frames[i]), source, progress);
    tally.count(frames[i], outcome);
    if (!outcome.ends_all && !tally.interrupted) continue;
    tally.missing.insert(tally.missing.end(), frames.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                         frames.end());
    if (outcome.status == ExitStatus::misuse) return outcome.status;
    break;
  }
  if (!tally.interrupted && !arguments.movie.empty()) make_movie(arguments, source, tally);
  return summarize(arguments, tally, watch.seconds());
}

}  // namespace tyndall::tools
