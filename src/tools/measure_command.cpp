// `tyndall measure`: speed against accuracy of a scene's settings.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "image/files.h"
#include "tools/commands.h"
#include "tools/content.h"
#include "tools/files_in_use.h"
#include "tools/identity.h"
#include "tools/interrupt.h"
#include "tools/measure/full_report.h"
#include "tools/measure/given_reference.h"
#include "tools/measure/measuring.h"
#include "tools/numbers.h"
#include "tools/render_checks.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

struct MeasureArguments {
  RenderArguments base;
  std::vector<Sweep> sweeps;
  MeasureGoals goals;
  std::optional<double> reference_error;
  std::string reference, keep, output;
  bool csv = false, features = false;
};

// No process is ready sooner [s].
constexpr double least_budget = 1e-3;

// "90s", "10min", "1h".
std::optional<double> read_duration(std::string_view text) {
  constexpr std::pair<std::string_view, double> units[] = {{"min", 60}, {"s", 1}, {"h", 3600}};
  for (const auto& [unit, seconds] : units) {
    if (!text.ends_with(unit)) continue;
    const auto number = read_decimal<double>(text.substr(0, text.size() - unit.size()));
    return number && *number * seconds >= least_budget ? std::optional(*number * seconds) : std::nullopt;
  }
  return std::nullopt;
}

ExitStatus fail_to_measure(const std::string& message) { return print_error(message), ExitStatus::problem; }

// What the pictures in the file of measurements are of, in parts that a message can name.
nlohmann::json facts_of_scene(const MeasureArguments& arguments, LoadedScene& loaded) {
  const scene::RenderSettings settings = std::exchange(loaded.scene.settings, {});
  const PictureIdentity identity = identity_of(arguments.base, loaded, loaded.scene);
  loaded.scene.settings = settings;
  nlohmann::json files = nlohmann::json::array();
  for (const PictureIdentity::File& file : identity.files)
    if (!file.is_text) files.push_back({file.path, file.hash});
  scene::RenderSettings rendered = settings;
  apply(arguments.base.settings, rendered);
  return {{"version", identity.version},
          {"simd", identity.simd},
          {"scene", identity.scene_hash},
          {"files", files},
          {"frame", identity.frame},
          {"resolution", {rendered.resolution.width, rendered.resolution.height}}};
}

// Beside the page, unless another is named; empty: nothing is kept.
std::string kept_file(const MeasureArguments& arguments) {
  if (!arguments.keep.empty() || arguments.output.empty()) return arguments.keep;
  return arguments.output + ".measured";
}

std::string file_problem(const MeasureArguments& arguments, FilesInUse& files) {
  std::string problem = files.read(arguments.base.scene.path, "the scene");
  const auto check = [&problem](auto&& next) {
    if (problem.empty()) problem = next();
  };
  if (!arguments.reference.empty()) check([&] { return files.read(arguments.reference, "the reference"); });
  if (const std::string kept = kept_file(arguments); !kept.empty()) {
    check([&] { return image::check_file_writable(kept); });
    check([&] { return files.write(kept, "the file of measurements"); });
  }
  if (!arguments.output.empty()) {
    check([&] { return image::check_file_writable(arguments.output); });
    check([&] { return files.write(arguments.output, "-o"); });
  }
  return problem;
}

// What is wrong with one of the settings in this scene.
std::string grid_problem(const std::vector<MeasuredSetting>& settings, const scene::Scene& scene) {
  for (const MeasuredSetting& setting : settings) {
    scene::RenderSettings own = scene.settings;
    apply(setting.arguments.settings, own);
    if (const std::string problem = settings_problem(setting.arguments, own); !problem.empty())
      return fmt::format("{}: {}", setting.name(), problem);
  }
  return {};
}

void print_report(const MeasureArguments& arguments, const MeasureReport& report) {
  if (arguments.base.json)
    print_json(to_json(report));
  else
    print_result(arguments.csv ? csv_of(report) : table_of(report));
}

bool is_swept(const std::vector<MeasuredSetting>& settings, const char* name) {
  return settings[0].value(name) != nullptr;
}

// What of the sweeps changes less than it seems to.
void warn_of_idle_sweeps(const std::vector<MeasuredSetting>& settings, const scene::Scene& scene) {
  const auto own = std::count_if(scene.volumes.begin(), scene.volumes.end(),
                                 [](const scene::Volume& volume) { return volume.step.has_value(); });
  if (own > 0 && is_swept(settings, "step"))
    print_warning(
        fmt::format("{} of {} volumes have a `step` of their own, which the sweep does not change: leave it "
                    "away to measure it",
                    own, scene.volumes.size()));
  for (const MeasuredSetting& setting : settings) {
    scene::RenderSettings rendered = scene.settings;
    apply(setting.arguments.settings, rendered);
    if (const std::string ignored = what_is_ignored(setting.arguments, rendered); !ignored.empty())
      return print_warning(ignored);
  }
}

// Prints the report and writes the page.
ExitStatus tell(const MeasureArguments& arguments, const MeasureReport& report, const scene::Scene& scene,
                const Measuring* measuring, bool interrupted) {
  print_report(arguments, report);
  if (!arguments.output.empty())
    if (const std::string problem = write_page(arguments.output, report, scene, measuring); !problem.empty())
      return fail_to_measure(problem);
  if (!report.complete && !arguments.base.quiet) {
    const std::string kept = measuring != nullptr ? kept_file(arguments) : std::string();
    print_message(fmt::format(
        "not all is measured: {}; a smaller --resolution takes less time\n",
        measuring == nullptr ? "a longer --budget goes further"
        : kept.empty()       ? "a longer --budget goes further, and --keep FILE lets the same command go on"
                             : fmt::format("the same command goes on from '{}'", kept)));
  }
  return interrupted ? ExitStatus::interrupted : ExitStatus::done;
}

ReportRequest report_request(const MeasureArguments& arguments) {
  return {arguments.base.scene.path, arguments.reference, arguments.base.threads, arguments.goals.seeds};
}

// Whether settings are measured: without --features always.
bool measures_settings(const MeasureArguments& arguments) {
  return !arguments.features || !arguments.sweeps.empty();
}

// What features cost, if that is asked for; a message, or an empty string.
std::string add_feature_costs(const MeasureArguments& arguments, LoadedScene& loaded,
                              const std::atomic<bool>& stop, MeasureReport& report) {
  std::string problem;
  if (!arguments.features || stop) return problem;
  report.feature_costs = measure_features({loaded.scene, arguments.base, arguments.goals.seeds,
                                           arguments.goals.budget_seconds, arguments.base.quiet},
                                          stop, problem);
  report.complete = report.complete && report.feature_costs.complete;
  return problem;
}

// Measures, and tells of it what is known at the end.
ExitStatus measure_scene(const MeasureArguments& arguments, const std::vector<MeasuredSetting>& settings,
                         LoadedScene& loaded) {
  scene::RenderSettings common = loaded.scene.settings;
  apply(arguments.base.settings, common);
  const std::atomic<bool>& stop = catch_interrupts();
  if (!measures_settings(arguments)) {
    MeasureReport report = empty_report(report_request(arguments), loaded.scene, common);
    report.complete = true;
    if (const std::string problem = add_feature_costs(arguments, loaded, stop, report); !problem.empty())
      return fail_to_measure(problem);
    return tell(arguments, report, loaded.scene, nullptr, stop);
  }
  const nlohmann::json facts = facts_of_scene(arguments, loaded);
  const auto [width, height] = common.resolution;
  GivenReference given;
  if (!arguments.reference.empty()) given = read_reference(arguments.reference, width, height);
  if (!given.problem.empty()) return fail_to_measure(given.problem);
  const std::string kept = kept_file(arguments);
  Measurements measurements(kept, facts,
                            3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (!measurements.problem().empty()) return fail_to_measure(measurements.problem());
  if (!measurements.replaced().empty())
    print_warning(fmt::format("'{}' has measurements of something else, which are dropped: other {}", kept,
                              measurements.replaced()));
  Measuring measuring(loaded.scene, settings, arguments.goals, std::move(given.reference), measurements);
  if (const std::string problem = measuring.run(stop, arguments.base.quiet); !problem.empty())
    return fail_to_measure(problem);
  MeasureReport report = full_report(report_request(arguments), loaded.scene, common, measuring);
  if (const std::string problem = add_feature_costs(arguments, loaded, stop, report); !problem.empty())
    return fail_to_measure(problem);
  return tell(arguments, report, loaded.scene, &measuring, stop);
}

ExitStatus run_measure(const MeasureArguments& arguments) {
  const std::vector<MeasuredSetting> settings = grid_of(arguments.base, arguments.sweeps);
  if (!arguments.output.empty() && !arguments.output.ends_with(".html") &&
      image::appears_whole(arguments.output))
    return misuse(fmt::format("measure writes a page, -o OUT.html, not '{}'", arguments.output));
  if (arguments.csv && arguments.base.json)
    return misuse("measure prints its results as --json or as --csv, not both: give one");
  if (arguments.csv && arguments.features && !arguments.sweeps.empty())
    return misuse("--csv prints one table, of the settings of --sweep or of --features: leave one of them");
  if (!arguments.base.aovs.empty() && !arguments.features)
    return misuse("--aov is for --features, which measures what output channels cost: give both or neither");
  FilesInUse files;
  if (const std::string problem = file_problem(arguments, files); !problem.empty())
    return fail_to_measure(problem);
  SceneRequest request = arguments.base.scene;
  request.amend_settings = [&](scene::RenderSettings& own) { apply(arguments.base.settings, own); };
  const std::unique_ptr<LoadedScene> loaded = load(request);
  print_diagnostics(loaded->diagnostics, loaded->sources);
  if (loaded->diagnostics.has_errors()) return ExitStatus::problem;
  if (const std::string problem = files.read_by_scene(loaded->files_read); !problem.empty())
    return fail_to_measure(problem);
  if (const std::string problem = grid_problem(settings, loaded->scene); !problem.empty())
    return misuse(problem);
  warn_of_idle_sweeps(settings, loaded->scene);
  return measure_scene(arguments, settings, *loaded);
}

void add_measure_options(CLI::App& command, MeasureArguments& arguments) {
  command
      .add_option_function<std::vector<std::string>>(
          "--sweep",
          [&arguments](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) arguments.sweeps.push_back(read_sweep(text));
          },
          fmt::format(
              "Measure each of these values of a parameter: {}; of several parameters all combinations",
              fmt::join(swept_names(), " ")))
      ->allow_extra_args(false)
      ->option_text("NAME=VALUE,VALUE,...");
  add_whole(command, "--seeds", arguments.goals.seeds,
            "Renders of each setting, each with a seed of its own (default: 4)");
  add_text_option(command, "--budget", "TIME", "How long to measure, for instance 90s or 10min, the default",
                  [&arguments](const std::string& text) {
                    const auto seconds = read_duration(text);
                    if (!seconds)
                      refuse("--budget", "a time such as 90s, 10min or 1h, at least 0.001s", text);
                    arguments.goals.budget_seconds = *seconds;
                  });
  command
      .add_option("--reference", arguments.reference,
                  "A converged picture to compare with; without it one is made by --method tracking")
      ->option_text("REF.exr");
  add_real(
      command, "--reference-error", arguments.reference_error,
      "Sample the reference until the root of its mean squared relative error is below this (default: 0.01)");
  command
      .add_option(
          "--keep", arguments.keep,
          "Keep what is measured in this file, and go on from what it has; the default is OUT.html.measured")
      ->option_text("FILE");
}

void add_feature_options(CLI::App& command, MeasureArguments& arguments) {
  command.add_flag(
      "--features", arguments.features,
      "Measure what each feature of the scene costs: render it without motion blur, each medium, "
      "each light, and so on");
  add_output_option(command, arguments.base.aovs);
}

Action measure_options(CLI::App& command) {
  const auto arguments = std::make_shared<MeasureArguments>();
  RenderArguments& base = arguments->base;
  command.add_option("scene", base.scene.path, "The scene to measure")->required()->option_text("SCENE");
  add_measure_options(command, *arguments);
  add_feature_options(command, *arguments);
  command.add_option("-o,--output", arguments->output, "Write a page with plots and pictures")
      ->option_text("OUT.html");
  add_scene_options(command, base.scene);
  add_setting_options(command, base.settings);
  add_method_options(command, base);
  add_whole(command, "--threads", base.threads, "Threads to use, in place of as many as the machine has");
  command.add_flag("--quiet", base.quiet, "Say nothing but errors, warnings and the results");
  command.add_flag("--json", base.json, "Print the results as JSON in place of a table");
  command.add_flag("--csv", arguments->csv, "Print the results as CSV in place of a table");
  return [arguments] {
    if (arguments->reference_error) arguments->goals.reference_error = *arguments->reference_error;
    try {
      return run_measure(*arguments);
    } catch (const CLI::ParseError& error) {
      return misuse(error.what());
    }
  };
}

}  // namespace

constinit const Command measure_command{"measure", "Measure speed against accuracy of a scene's settings",
                                        measure_options};

}  // namespace tyndall::tools
