// `tyndall render`: a scene to a picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "tools/commands.h"
#include "tools/files_in_use.h"
#include "tools/picture_output.h"
#include "tools/render_checks.h"
#include "tools/render_frame.h"
#include "tools/renew_view.h"
#include "tools/report.h"
#include "tools/sequence.h"
#include "tools/sequence_checks.h"
#include "tools/staleness.h"

namespace tyndall::tools {
namespace {

// Whether all outputs are there as they would be rendered; statistics are written last.
bool is_there(const RenderArguments& arguments) {
  std::error_code ignored;
  const std::string& statistics = arguments.statistics_file;
  return (statistics.empty() || std::filesystem::exists(statistics, ignored)) && why_stale(arguments).empty();
}

ExitStatus render_one(const RenderArguments& arguments) {
  if (is_in_whole(arguments)) {
    if (!arguments.quiet)
      print_message(fmt::format("{}: what it is a part of is there already: '{}'\n", arguments.output,
                                arguments.part_of));
    return ExitStatus::done;
  }
  if (arguments.resume && is_there(arguments)) {
    remove_checkpoint(arguments.output);
    if (has_other_view(arguments)) {
      FrameSource source(arguments.scene, false);
      if (const std::string problem = renew_view(arguments, source); !problem.empty())
        return print_error(problem), ExitStatus::problem;
    }
    if (!arguments.quiet) print_message(fmt::format("{}: it is there already\n", arguments.output));
    return ExitStatus::done;
  }
  FilesInUse files;
  FrameOutcome outcome;
  if (const std::string problem = output_problem(arguments, files); !problem.empty()) {
    outcome = failed_frame(problem);
  } else {
    FrameSource source(arguments.scene, false);
    outcome = render_frame(arguments, {source, files});
  }
  if (arguments.json && !outcome.report.is_null()) print_json(outcome.report);
  return outcome.status;
}

ExitStatus run_render(const RenderArguments& arguments) {
  if (arguments.output.empty() && !arguments.pixel)
    return misuse("render wants the picture to write: -o OUT.exr");
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return misuse(problem);
  if (is_sequence(arguments)) return render_sequence(arguments);
  if (!arguments.movie.empty())
    return misuse("--movie wants a sequence: -o 'out.####.exr', with or without --frames");
  return render_one(arguments.scene.frame ? of_frame(arguments, *arguments.scene.frame) : arguments);
}

Action render_options(CLI::App& command) {
  const auto arguments = std::make_shared<RenderArguments>();
  add_render_options(command, *arguments);
  return [arguments] { return run_render(*arguments); };
}

}  // namespace

constinit const Command render_command{"render", "Render a scene to a picture", render_options};

}  // namespace tyndall::tools
