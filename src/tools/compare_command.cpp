// `tyndall compare`: how far one picture is from another.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "image/false_colors.h"
#include "image/flip.h"
#include "image/image.h"
#include "tools/commands.h"
#include "tools/comparison.h"
#include "tools/files_in_use.h"
#include "tools/memory.h"
#include "tools/numbers.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

using image::Image;

const std::vector<std::string_view> metrics{"relmse", "mse", "flip", "ldr-flip", "hdr-flip", "outliers"};
const std::vector<std::string_view> maps{"flip", "ldr-flip", "hdr-flip", "relative"};

struct CompareArguments {
  std::string picture, reference, metric, map, map_of = "flip";
  std::optional<double> max, significance;
  std::optional<double> pixels_per_degree;
  bool json = false;

  bool wants_flip() const { return metric.empty() || metric.find("flip") != std::string::npos; }
  double resolution() const { return pixels_per_degree.value_or(image::flip_pixels_per_degree); }
};

std::string map_problem(const CompareArguments& arguments) {
  if (arguments.map.empty()) return {};
  FilesInUse files;
  for (const std::string& path : {arguments.picture, arguments.reference})
    if (std::string problem = files.read(path, "the picture"); !problem.empty()) return problem;
  if (std::string problem = image::check_writable(arguments.map); !problem.empty()) return problem;
  return files.write(arguments.map, "--map");
}

double mean_error(const Image& errors) {
  return std::accumulate(errors.pixels.begin(), errors.pixels.end(), 0.0) /
         std::max(static_cast<double>(errors.pixels.size()), 1.0);
}

// An .exr gets the errors themselves.
std::string write_map(const CompareArguments& arguments, const Image& errors) {
  const bool keeps_numbers = arguments.map.ends_with(".exr");
  return image::write(arguments.map, keeps_numbers ? errors : image::in_false_colors(errors),
                      {{"Software", "Tyndall " TYNDALL_VERSION}});
}

// Finds what is to be told, and writes the map; a message, or an empty string.
std::string measure(const CompareArguments& arguments, const PicturePair& pair, ComparisonResult& result) {
  result = compare_pair(pair);
  const std::string metric = arguments.metric.empty() ? "flip" : arguments.metric;
  std::optional<Image> errors;
  if (arguments.wants_flip() && result.main.not_finite == 0) {
    errors = errors_of(metric, pair, arguments.resolution());
    result.flip = mean_error(*errors);
    result.flip_kind = flip_kind(metric, pair);
  }
  if (arguments.map.empty()) return {};
  if (!errors || flip_kind(metric, pair) != flip_kind(arguments.map_of, pair))
    errors = errors_of(arguments.map_of, pair, arguments.resolution());
  return write_map(arguments, *errors);
}

double value_of(std::string_view metric, const ComparisonResult& result) {
  if (metric == "mse") return result.main.mse;
  if (metric == "outliers") return result.outliers;
  if (metric == "relmse") return result.main.relative_mse;
  return result.flip.value_or(std::numeric_limits<double>::quiet_NaN());
}

// Whether the pictures are as close as is asked for; tells what is not.
bool is_close(const CompareArguments& arguments, const PicturePair& pair, const ComparisonResult& result) {
  bool close = true;
  const std::string metric = arguments.metric.empty() ? "relmse" : arguments.metric;
  if (const double value = value_of(metric, result); arguments.max && !(value <= *arguments.max)) {
    print_error(fmt::format("{} {:.6g} is not at most {:.6g}", metric, value, *arguments.max));
    close = false;
  }
  if (!arguments.significance) return close;
  const bool agrees =
      result.z_test && result.z_test->pixels_agree() && result.z_test->means_agree(*arguments.significance);
  if (!agrees)
    print_error(result.z_test ? fmt::format("the z-test tells the pictures apart: {}",
                                            describe(*result.z_test, pair.picture))
                              : "the z-test has nothing to go by where values are not finite");
  return close && agrees;
}

// What was asked for of light alone; empty: nothing.
std::string_view light_kind(const CompareArguments& arguments) {
  constexpr std::string_view of_light = "hdr-flip";
  const bool wanted =
      arguments.metric == of_light || (!arguments.map.empty() && arguments.map_of == of_light);
  return wanted ? of_light : std::string_view();
}

ExitStatus fail_to_compare(const std::string& message) { return print_error(message), ExitStatus::problem; }

ExitStatus run_compare(const CompareArguments& arguments) {
  if (arguments.significance && *arguments.significance >= 1)
    return misuse("--significance wants a number above 0 and below 1, for instance 0.001");
  if (const std::string problem = map_problem(arguments); !problem.empty()) return fail_to_compare(problem);
  const std::optional<PicturePair> pair = read_pair(arguments.picture, arguments.reference);
  if (!pair) return ExitStatus::problem;
  if (const std::string_view kind = light_kind(arguments); !kind.empty() && !pair->are_light)
    return fail_to_compare(
        fmt::format("{} compares light, of two .exr: ldr-flip compares what a display shows, and flip takes "
                    "the one that suits the files",
                    kind));
  ComparisonResult result;
  if (const std::string problem =
          with_memory("to compare the pictures", [&] { return measure(arguments, *pair, result); });
      !problem.empty())
    return fail_to_compare(problem);
  if (arguments.significance && !pair->no_z_test.empty())
    return fail_to_compare(fmt::format("--significance: {}", pair->no_z_test));
  if (arguments.significance && !result.z_test && result.main.not_finite == 0)
    return fail_to_compare(
        "--significance wants the variance of R, G and B in one of the pictures at least: render with "
        "--aov variance");
  const bool close = is_close(arguments, *pair, result);
  if (arguments.json) {
    nlohmann::json json = to_json(result);
    json["passed"] = close;
    print_json(json);
  } else {
    print_result(to_text(result, *pair));
  }
  return close ? ExitStatus::done : ExitStatus::test_failed;
}

void add_name(CLI::App& command, const char* option, std::string& target, const std::string& help,
              const std::vector<std::string_view>& names) {
  std::string form;
  for (const std::string_view name : names) form += fmt::format("{}{}", form.empty() ? "" : "|", name);
  command.add_option(option, target, help)
      ->check([&names](const std::string& text) { return name_problem(names, text); })
      ->option_text(form);
}

Action compare_options(CLI::App& command) {
  const auto arguments = std::make_shared<CompareArguments>();
  command.add_option("picture", arguments->picture, "The picture")->required()->option_text("A");
  command.add_option("reference", arguments->reference, "The picture that is taken as true")
      ->required()
      ->option_text("B");
  add_name(command, "--metric", arguments->metric, "What --max limits (default: relmse)", metrics);
  add_real(command, "--max", arguments->max, "Fail, with exit status 3, when the metric is greater");
  add_real(command, "--significance", arguments->significance,
           "Fail, with exit status 3, when a z-test tells the pictures apart at this significance");
  command
      .add_option("--map", arguments->map,
                  "Write a picture of the errors in false colours; an .exr gets the errors themselves")
      ->option_text("OUT");
  add_name(command, "--map-of", arguments->map_of, "Which errors --map shows (default: flip)", maps);
  add_real(command, "--pixels-per-degree", arguments->pixels_per_degree,
           "Pixels per degree of what the eye sees, for FLIP (default: 67)");
  command.add_flag("--json", arguments->json, "Print the numbers as JSON on standard output");
  return [arguments] { return run_compare(*arguments); };
}

}  // namespace

constinit const Command compare_command{"compare", "Tell how far a picture is from a reference",
                                        compare_options};

}  // namespace tyndall::tools
