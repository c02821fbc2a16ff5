// `tyndall compare`: how far one picture is from another.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "image/compare.h"
#include "image/image.h"
#include "tools/commands.h"
#include "tools/numbers.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

struct CompareArguments {
  std::string picture, reference, metric = "relmse";
  std::optional<double> max;
  bool json = false;
};

std::string shape_text(const image::Image& image) {
  return fmt::format("{}x{} with channels {}", image.width, image.height, fmt::join(image.channels, " "));
}

ExitStatus run_compare(const CompareArguments& arguments) {
  const image::ReadResult picture = image::read(arguments.picture),
                          reference = image::read(arguments.reference);
  for (const image::ReadResult* read : {&picture, &reference})
    if (!read->image) print_error(read->error);
  if (!picture.image || !reference.image) return ExitStatus::problem;
  if (shape_text(*picture.image) != shape_text(*reference.image)) {
    print_error(fmt::format("the pictures cannot be compared: '{}' is {}, '{}' is {}", arguments.picture,
                            shape_text(*picture.image), arguments.reference, shape_text(*reference.image)));
    return ExitStatus::problem;
  }

  const image::Comparison comparison = image::compare(*picture.image, *reference.image);
  const bool close = !arguments.max || comparison.relative_mse <= *arguments.max;
  if (arguments.json) {
    print_json({{"relmse", comparison.relative_mse},
                {"max_difference", comparison.max_difference},
                {"mean", comparison.mean},
                {"reference_mean", comparison.reference_mean},
                {"not_finite", comparison.not_finite},
                {"passed", close}});
  } else {
    print_result(fmt::format("relmse {:.6g}\nmax difference {:.6g}\nmean {:.6g}\nreference mean {:.6g}\n",
                             comparison.relative_mse, comparison.max_difference, comparison.mean,
                             comparison.reference_mean));
    if (comparison.not_finite > 0) print_result(fmt::format("values not finite {}\n", comparison.not_finite));
  }
  if (!close)
    print_error(fmt::format("{} {:.6g} is not at most {:.6g}", arguments.metric, comparison.relative_mse,
                            *arguments.max));
  return close ? ExitStatus::done : ExitStatus::test_failed;
}

}  // namespace

void add_compare_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("compare", "Tell how far a picture is from a reference");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("picture", arguments->picture, "The picture")->required()->option_text("A");
  command->add_option("reference", arguments->reference, "The picture that is taken as true")
      ->required()
      ->option_text("B");
  command->add_option("--metric", arguments->metric, "What --max limits (default: relmse)")
      ->check(CLI::IsMember({"relmse"}))
      ->option_text("relmse");
  add_real(*command, "--max", arguments->max, "Fail, with exit status 3, when the metric is greater");
  command->add_flag("--json", arguments->json, "Print the numbers as JSON on standard output");
  command->callback([arguments, &action] { action = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace tyndall::tools
