#include "tools/render_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "compile/compiled_scene.h"
#include "image/files.h"
#include "tools/denoising.h"
#include "tools/interrupt.h"
#include "tools/memory.h"
#include "tools/picture_output.h"
#include "tools/profile.h"
#include "tools/progress.h"
#include "tools/render_checks.h"
#include "tools/report.h"
#include "tools/run_report.h"

namespace tyndall::tools {
namespace {

ProgressStyle progress_style(const RenderArguments& arguments) {
  if (arguments.quiet) return ProgressStyle::none;
  return error_output_is_terminal() ? ProgressStyle::bar : ProgressStyle::lines;
}

FrameOutcome replay(const RenderArguments& arguments, const compile::CompiledScene& world) {
  const render::Replay replayed = render::replay(world, render_options_of(arguments), arguments.pixel->x,
                                                 arguments.pixel->y, *arguments.sample);
  const Rgb& radiance = replayed.radiance;
  if (arguments.json)
    return {ExitStatus::done,
            {{"radiance", {radiance.x, radiance.y, radiance.z}}, {"trace", replayed.trace}}};
  print_result(replayed.trace);
  print_result(fmt::format("radiance {} {} {}\n", radiance.x, radiance.y, radiance.z));
  return {ExitStatus::done, {}};
}

render::RenderResult render_with_progress(const RenderArguments& arguments,
                                          const compile::CompiledScene& world, PictureOutput& output,
                                          SequenceProgress* sequence) {
  render::RenderOptions options = render_options_of(arguments);
  options.stop = &catch_interrupts();
  ProgressPrinter printer(progress_style(arguments), sequence);
  render::Progress progress = printer.callback();
  progress.wants_pause = [&output](double seconds) { return output.is_due(seconds); };
  progress.pass = [&output](const render::Film& film, const render::Statistics& so_far,
                            const std::string& rest) { output.save(film, so_far, rest); };
  return render::render(world, options, progress, output.unfinished(world, options));
}

// Every shader's programs with what was run of them.
std::vector<ProgramLanes> programs_of(const scene::Scene& scene, const render::Statistics& statistics) {
  std::vector<ProgramLanes> programs;
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    const scene::Medium& medium = scene.media[i];
    programs.push_back({"medium " + medium.name, &medium.full, statistics.medium_lanes[2 * i]});
    programs.push_back({"medium " + medium.name, &medium.extinction, statistics.medium_lanes[2 * i + 1]});
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    programs.push_back(
        {"material " + scene.materials[i].name, &scene.materials[i].program, statistics.material_lanes[i]});
  return programs;
}

std::string write_statistics(const RenderArguments& arguments, const nlohmann::json& statistics) {
  if (arguments.statistics_file.empty()) return {};
  const std::string text = statistics.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  return image::write_file_whole(arguments.statistics_file, std::as_bytes(std::span(text)));
}

FrameOutcome end_with_problems(FrameSource& source) {
  const LoadedScene& text = source.text();
  source.tell_problems();
  return {ExitStatus::problem,
          {{"diagnostics", to_json(text.diagnostics, text.sources)}},
          false,
          source.is_bad_at_all_times()};
}

FrameOutcome misused(const std::string& message) { return {misuse(message), {}, false, true}; }

// Says why there is no picture, if there is none.
void tell_what_is_not_written(const RenderArguments& arguments, bool good, bool any) {
  if (!any)
    print_error(
        fmt::format("'{}' was not written: the run ended before any pixel had a sample", arguments.output));
  else if (!good)
    print_error(fmt::format("'{}' was not written, for --strict wants none of this", arguments.output));
}

// Writes the picture, unless --strict made errors of what was met, and the statistics, and says what is to be
// said of the run.
FrameOutcome finish(const RenderArguments& arguments, FrameSource& source, PictureOutput& output,
                    const render::RenderResult& result, StageSeconds& seconds) {
  LoadedScene& text = source.text();
  const scene::Scene& scene = source.scene();
  report_run_problems(arguments, scene, result.statistics, text.diagnostics);
  const bool good = !text.diagnostics.has_errors(), any = result.statistics.samples > 0;
  Stopwatch watch;
  std::string problem = good && any ? output.finish(result) : std::string();
  if (!good) output.discard();
  seconds.write = watch.lap();
  nlohmann::json statistics = statistics_json(scene, source.identity().scene_hash, seconds, result.statistics,
                                              text.sources, text.assets);
  statistics["reuse"] = source.reuse_json();
  if (problem.empty()) problem = write_statistics(arguments, statistics);
  source.tell_problems();
  if (!problem.empty()) return failed_frame(problem);
  tell_what_is_not_written(arguments, good, any);
  if (arguments.profile) print_result(profile_text(programs_of(scene, result.statistics), text.sources));
  statistics["diagnostics"] = to_json(text.diagnostics, text.sources);
  FrameOutcome outcome{ExitStatus::done, std::move(statistics)};
  if (!arguments.quiet && good && any) print_message(summary_line(arguments, scene, result.statistics));
  if (!good || !any) outcome.status = ExitStatus::problem;
  if (good && result.statistics.stopped) outcome.status = ExitStatus::interrupted;
  return outcome;
}

}  // namespace

render::RenderOptions render_options_of(const RenderArguments& arguments) {
  render::RenderOptions options;
  options.threads = arguments.threads;
  options.method = arguments.method;
  options.distance = arguments.distance;
  options.transmittance = arguments.transmittance;
  options.emission_sampling = arguments.emission_sampling;
  options.crop = arguments.crop;
  options.aovs = recorded_outputs(arguments);
  options.error = arguments.error;
  options.time_limit = arguments.time_limit;
  if (arguments.error || arguments.time_limit)
    options.sample_count = arguments.settings.get(&scene::RenderSettings::samples);
  if (arguments.sample_range) {
    options.first_sample = arguments.sample_range->first;
    options.sample_count = arguments.sample_range->last - arguments.sample_range->first + 1;
  }
  return options;
}

FrameOutcome failed_frame(const std::string& message) {
  print_error(message);
  FrameOutcome outcome{ExitStatus::problem,
                       {{"diagnostics", {{{"severity", "error"}, {"message", message}}}}}};
  outcome.ends_all = image::tells_of_full_disk(message);
  return outcome;
}

FrameOutcome render_frame(const RenderArguments& arguments, const FrameSetting& setting) {
  FrameSource& source = setting.source;
  if (!source.read(arguments)) return end_with_problems(source);
  LoadedScene& text = source.text();
  if (const std::string problem = setting.files.read_by_scene(text.files_read); !problem.empty())
    return failed_frame(problem);
  if (const std::string problem = settings_problem(arguments, source.scene().settings); !problem.empty())
    return misused(problem);
  if (!arguments.pixel) source.tell_problems();
  if (const std::string ignored = what_is_ignored(arguments, source.scene().settings);
      !ignored.empty() && source.is_news(ignored))
    print_warning(ignored);

  StageSeconds seconds{text.seconds.read, text.seconds.parse, text.seconds.resolve};
  Stopwatch watch;
  const compile::CompiledScene& world = source.compiled();
  seconds.compile = watch.lap();
  if (arguments.pixel) return replay(arguments, world);

  PictureOutput output(arguments, world.scene, source.identity());
  const render::RenderResult result = with_memory("to render the picture", [&] {
    return render_with_progress(arguments, world, output, setting.sequence);
  });
  seconds.render = watch.lap();
  return with_memory("to write the picture",
                     [&] { return finish(arguments, source, output, result, seconds); });
}

}  // namespace tyndall::tools
