// `tyndall render`: a scene to a picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <variant>

#include "compile/compiled_scene.h"
#include "image/files.h"
#include "tools/commands.h"
#include "tools/files_in_use.h"
#include "tools/interrupt.h"
#include "tools/memory.h"
#include "tools/profile.h"
#include "tools/progress.h"
#include "tools/report.h"
#include "tools/run_report.h"

namespace tyndall::tools {
namespace {

// Prints the problems so far, for people or as JSON; a rendering that ends here has no more to say.
ExitStatus end_with(const RenderArguments& arguments, const Diagnostics& diagnostics,
                    const Sources& sources) {
  print_diagnostics(diagnostics, sources);
  if (arguments.json) print_json({{"diagnostics", to_json(diagnostics, sources)}});
  return ExitStatus::problem;
}

ExitStatus fail(const RenderArguments& arguments, const std::string& message) {
  print_error(message);
  if (arguments.json) print_json({{"diagnostics", {{{"severity", "error"}, {"message", message}}}}});
  return ExitStatus::problem;
}

ExitStatus misuse(const std::string& message) {
  print_error(message);
  return ExitStatus::misuse;
}

// Statistics go into a file of their own kind, so that a slip of the pen cannot replace another; a device or
// pipe has whatever name it has.
std::string statistics_problem(const std::string& path) {
  if (!path.ends_with(".json") && image::appears_whole(path))
    return fmt::format("--stats wants a name that ends in .json, not '{}'", path);
  return image::check_file_writable(path);
}

// What can be said against the output files before any work is done.
std::string output_problem(const RenderArguments& arguments, FilesInUse& files) {
  std::string problem = files.read(arguments.scene.path, "the scene");
  const auto check = [&problem](auto&& next) {
    if (problem.empty()) problem = next();
  };
  if (!arguments.output.empty()) {
    check([&] { return image::check_writable(arguments.output); });
    check([&] { return files.write(arguments.output, "-o"); });
  }
  if (!arguments.statistics_file.empty()) {
    check([&] { return statistics_problem(arguments.statistics_file); });
    check([&] { return files.write(arguments.statistics_file, "--stats"); });
  }
  return problem;
}

// What of the options does not fit this scene's picture.
std::string picture_problem(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  const std::string size = fmt::format("a picture of {}x{}", settings.width, settings.height);
  if (const auto& crop = arguments.crop)
    if (crop->x1 > settings.width || crop->y1 > settings.height)
      return fmt::format("--crop {},{},{},{} reaches outside {}", crop->x0, crop->y0, crop->x1, crop->y1,
                         size);
  if (const auto& pixel = arguments.pixel)
    if (pixel->x >= settings.width || pixel->y >= settings.height)
      return fmt::format("--pixel {},{} is outside {}", pixel->x, pixel->y, size);
  return {};
}

// What of the options does not go with the scene's multiple scattering.
std::string scattering_problem(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  if (!settings.multiple_scattering.approximate || !render::by_ratio(arguments.transmittance)) return {};
  return fmt::format(
      "--transmittance {} does not go with `multiple_scattering: approximate`, which wants optical depths: "
      "use "
      "march, jackknife or series, or --multiple-scattering full",
      name(arguments.transmittance));
}

// What of the options and the scene will not be heeded.
void warn_of_what_is_ignored(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  if (arguments.method != render::Method::decoupled && settings.light_samples > 1)
    print_warning(
        fmt::format("light_samples {} has no effect with --method {}: only decoupled marching takes more "
                    "than one light point for a segment of a path",
                    settings.light_samples, name(arguments.method)));
}

double exposure_of(const scene::Scene& scene) {
  return std::visit([](const auto& camera) { return camera.exposure; }, scene.camera);
}

render::RenderOptions options_of(const RenderArguments& arguments) {
  render::RenderOptions options;
  options.threads = arguments.threads;
  options.method = arguments.method;
  options.distance = arguments.distance;
  options.transmittance = arguments.transmittance;
  options.emission_sampling = arguments.emission_sampling;
  options.crop = arguments.crop;
  options.aovs = arguments.aovs;
  options.error = arguments.error;
  options.time_limit = arguments.time_limit;
  if (arguments.error || arguments.time_limit) options.sample_count = arguments.samples;
  if (arguments.sample_range) {
    options.first_sample = arguments.sample_range->first;
    options.sample_count = arguments.sample_range->last - arguments.sample_range->first + 1;
  }
  return options;
}

ProgressStyle progress_style(const RenderArguments& arguments) {
  if (arguments.quiet) return ProgressStyle::none;
  return error_output_is_terminal() ? ProgressStyle::bar : ProgressStyle::lines;
}

ExitStatus replay(const RenderArguments& arguments, const compile::CompiledScene& world) {
  const render::Replay replayed =
      render::replay(world, options_of(arguments), arguments.pixel->x, arguments.pixel->y, *arguments.sample);
  const Rgb& radiance = replayed.radiance;
  if (arguments.json) {
    print_json({{"radiance", {radiance.x, radiance.y, radiance.z}}, {"trace", replayed.trace}});
  } else {
    print_result(replayed.trace);
    print_result(fmt::format("radiance {} {} {}\n", radiance.x, radiance.y, radiance.z));
  }
  return ExitStatus::done;
}

// The picture so far is written when a pass ends, but at most so often, and never for long [s].
class PicturesSoFar {
 public:
  PicturesSoFar(const RenderArguments& arguments, const scene::Scene& scene, std::string scene_hash)
      : arguments_(arguments), scene_(scene), scene_hash_(std::move(scene_hash)) {}

  void write(const render::Film& film, const render::Statistics& statistics) {
    if (!wanted_ || statistics.seconds < next_) return;
    Stopwatch watch;
    image::Metadata metadata = metadata_of(arguments_, scene_, scene_hash_, statistics);
    metadata.emplace_back("tyndall:unfinished", fmt::format("{} samples so far", statistics.samples));
    // A failure is told at the end, when the whole picture is written.
    image::write(arguments_.output, film.image(), metadata, exposure_of(scene_));
    next_ = statistics.seconds + std::max(least_interval, 50 * watch.lap());
  }

 private:
  static constexpr double least_interval = 10;
  const RenderArguments& arguments_;
  const scene::Scene& scene_;
  std::string scene_hash_;
  // A device or pipe wants one picture, and with --strict it is not known yet whether there will be any.
  const bool wanted_ = image::appears_whole(arguments_.output) && !arguments_.strict;
  double next_ = least_interval;
};

render::RenderResult render_with_progress(const RenderArguments& arguments,
                                          const compile::CompiledScene& world,
                                          const std::string& scene_hash) {
  render::RenderOptions options = options_of(arguments);
  options.stop = &catch_interrupts();
  ProgressPrinter printer(progress_style(arguments));
  PicturesSoFar pictures(arguments, world.scene, scene_hash);
  render::Progress progress = printer.callback();
  progress.pass = [&pictures](const render::Film& film, const render::Statistics& so_far) {
    pictures.write(film, so_far);
  };
  return render::render(world, options, progress);
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

std::string write_picture(const RenderArguments& arguments, const scene::Scene& scene,
                          const std::string& scene_hash, const render::RenderResult& result) {
  return image::write(arguments.output, result.film.image(),
                      metadata_of(arguments, scene, scene_hash, result.statistics), exposure_of(scene));
}

std::string write_statistics(const RenderArguments& arguments, const nlohmann::json& statistics) {
  if (arguments.statistics_file.empty()) return {};
  const std::string text = statistics.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  return image::write_file_whole(arguments.statistics_file, std::as_bytes(std::span(text)));
}

// Writes the picture, unless --strict made errors of what was met, and the statistics, and says what is to be
// said of the run.
ExitStatus finish(const RenderArguments& arguments, LoadedScene& loaded, const scene::Scene& scene,
                  const std::string& scene_hash, const render::RenderResult& result, StageSeconds& seconds) {
  report_run_problems(arguments, result.statistics, loaded.diagnostics);
  const bool good = !loaded.diagnostics.has_errors();
  Stopwatch watch;
  std::string problem = good ? write_picture(arguments, scene, scene_hash, result) : std::string();
  seconds.write = watch.lap();
  nlohmann::json statistics = statistics_json(scene, scene_hash, seconds, result.statistics, loaded.sources);
  if (problem.empty()) problem = write_statistics(arguments, statistics);
  print_diagnostics(loaded.diagnostics, loaded.sources);
  if (!problem.empty()) return fail(arguments, problem);
  if (!good)
    print_error(fmt::format("'{}' was not written, for --strict wants none of this", arguments.output));
  if (arguments.profile) print_result(profile_text(programs_of(scene, result.statistics), loaded.sources));
  if (arguments.json) {
    statistics["diagnostics"] = to_json(loaded.diagnostics, loaded.sources);
    print_json(statistics);
  }
  if (!arguments.quiet && good) print_message(summary_line(arguments, scene, result.statistics));
  if (!good) return ExitStatus::problem;
  return result.statistics.stopped ? ExitStatus::interrupted : ExitStatus::done;
}

ExitStatus run_render(const RenderArguments& arguments) {
  if (arguments.output.empty() && !arguments.pixel)
    return misuse("render wants the picture to write: -o OUT.exr");
  if (!arguments.aovs.empty() && !arguments.pixel && !arguments.output.ends_with(".exr"))
    return misuse("--aov wants an .exr to write: other formats have no further channels");
  FilesInUse files;
  if (const std::string problem = output_problem(arguments, files); !problem.empty())
    return fail(arguments, problem);

  const std::unique_ptr<LoadedScene> loaded = load(arguments.scene);
  if (loaded->diagnostics.has_errors()) return end_with(arguments, loaded->diagnostics, loaded->sources);
  if (const std::string problem = files.read_by_scene(loaded->files_read); !problem.empty())
    return fail(arguments, problem);
  const std::string scene_hash = stable_hash(scene::print(loaded->scene));
  apply_settings(arguments, loaded->scene.settings);
  if (const std::string problem = picture_problem(arguments, loaded->scene.settings); !problem.empty())
    return misuse(problem);
  if (const std::string problem = scattering_problem(arguments, loaded->scene.settings); !problem.empty())
    return misuse(problem);
  warn_of_what_is_ignored(arguments, loaded->scene.settings);

  StageSeconds seconds{loaded->seconds.read, loaded->seconds.parse, loaded->seconds.resolve};
  Stopwatch watch;
  const compile::CompiledScene world =
      with_memory("to compile the scene", [&] { return compile::compile(std::move(loaded->scene)); });
  seconds.compile = watch.lap();
  if (arguments.pixel) return replay(arguments, world);

  const render::RenderResult result = with_memory(
      "to render the picture", [&] { return render_with_progress(arguments, world, scene_hash); });
  seconds.render = watch.lap();
  return with_memory("to write the picture",
                     [&] { return finish(arguments, *loaded, world.scene, scene_hash, result, seconds); });
}

}  // namespace

void add_render_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to a picture");
  const auto arguments = std::make_shared<RenderArguments>();
  add_render_options(*command, *arguments);
  command->callback([arguments, &action] { action = [arguments] { return run_render(*arguments); }; });
}

}  // namespace tyndall::tools
