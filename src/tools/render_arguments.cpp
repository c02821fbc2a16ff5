#include "tools/render_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <utility>

#include "tools/numbers.h"

namespace tyndall::tools {
namespace {

// "0.1", "auto", "auto(1%)", "auto(0.01)".
std::optional<scene::Step> read_step(std::string_view text) {
  if (text == "auto") return scene::Step::automatic_unproven();
  const bool automatic = text.starts_with("auto(") && text.ends_with(")");
  if (automatic) text = text.substr(5, text.size() - 6);
  const bool percent = automatic && text.ends_with("%");
  if (percent) text.remove_suffix(1);
  const std::optional<double> number = read_decimal<double>(text);
  if (!number || !(*number > 0)) return std::nullopt;
  if (!automatic) return scene::Step(*number);
  const double tolerance = percent ? *number / 100 : *number;
  return tolerance < 1 ? std::optional(scene::Step::automatic_within(tolerance)) : std::nullopt;
}

constexpr Choice<MultipleScatteringChoice> multiple_scatterings[] = {
    {scene::MultipleScattering::full, MultipleScatteringChoice::full},
    {scene::ApproximateScattering::keyword, MultipleScatteringChoice::approximate},
};

std::string aov_names() {
  std::string names;
  for (const render::AovInfo& info : render::aov_infos())
    names += (names.empty() ? "" : " ") + std::string(info.name);
  return names;
}

void add_picture_options(CLI::App& command, RenderArguments& arguments) {
  add_whole_text_option(command, "--resolution", "Size of the picture in pixels, in place of the scene's",
                        [&arguments](const std::string& text, const WholeOption& option) {
                          const auto [width, height] = read_wholes<int, 2>(option, text);
                          arguments.resolution = Pair<int>{width, height};
                        });
  add_whole_text_option(
      command, "--crop",
      "Render only the pixels from (x0, y0) up to, not including, (x1, y1); the others stay black",
      [&arguments](const std::string& text, const WholeOption& option) {
        const auto [x0, y0, x1, y1] = read_wholes<int, 4>(option, text);
        if (x1 <= x0 || y1 <= y0) refuse(option.name, "X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1", text);
        arguments.crop = {x0, y0, x1, y1};
      });
}

void add_quality_options(CLI::App& command, RenderArguments& arguments) {
  add_whole(command, "--samples", arguments.samples, "Samples a pixel, in place of the scene's");
  const RealOption& step = real_option("--step");
  add_text_option(
      command, step.name, step.form,
      "Length of a step through a volume in metres, or auto(TOLERANCE): as long as proven bounds of the "
      "density allow; in place of the scene's (a volume's own stays)",
      [&arguments, &step](const std::string& text) {
        arguments.step = read_step(text);
        if (!arguments.step) refuse(step.name, wanted(step), text);
      });
  add_whole(command, "--light-samples", arguments.light_samples,
            "Direct-light samples a march, in place of the scene's");
  add_whole(command, "--bounces", arguments.bounces, "Scatterings after the first, in place of the scene's");
  command
      .add_option_function<std::string>(
          "--multiple-scattering",
          [&arguments](const std::string& text) {
            for (const auto& [name, choice] : multiple_scatterings)
              if (name == text) arguments.multiple_scattering = choice;
            if (!arguments.multiple_scattering)
              refuse("--multiple-scattering", "one of " + names_of(multiple_scatterings, ", "), text);
          },
          "Follow light through all scatterings in media, or approximate those after the first ones, in "
          "place "
          "of what the scene says")
      ->option_text(names_of(multiple_scatterings, "|"));
  add_whole(command, "--seed", arguments.seed, "Seed of the random numbers, in place of the scene's");
  add_whole_text_option(command, "--sample-range", "Render the samples A to B, both included, of each pixel",
                        [&arguments](const std::string& text, const WholeOption& option) {
                          const auto [first, last] = read_wholes<int, 2>(option, text);
                          if (last < first) refuse(option.name, "A..B with A no more than B", text);
                          arguments.sample_range = SampleRange{first, last};
                        });
}

// An option whose value is one of a table's names.
template <class Method, std::size_t count>
void add_choice(CLI::App& command, const std::string& option, const Choice<Method> (&table)[count],
                Method& method, const std::string& help) {
  command
      .add_option_function<std::string>(
          option,
          [option, &table, &method](const std::string& text) {
            for (const auto& [name, entry] : table)
              if (name == text) {
                method = entry;
                return;
              }
            refuse(option, "one of " + names_of(table, ", "), text);
          },
          fmt::format("For experts: {} (default: {})", help, name_in(table, method)))
      ->option_text(names_of(table, "|"));
}

void add_method_options(CLI::App& command, RenderArguments& arguments) {
  add_choice(command, "--method", methods, arguments.method, "how paths go through media");
  add_choice(command, "--distance", distances, arguments.distance,
             "how distances for direct light are drawn");
  add_choice(command, "--transmittance", transmittances, arguments.transmittance,
             "how much of a light arrives through what has no closed form");
  add_choice(command, "--emission", emissions, arguments.emission_sampling,
             "whether media that emit are sampled as lights or met by chance");
}

// Options that say when a rendering ends, and what it writes beside the picture.
void add_goal_options(CLI::App& command, RenderArguments& arguments) {
  CLI::Option* error =
      add_real(command, "--error", arguments.error,
               "Sample each part of the picture until the root of its mean squared relative error is "
               "below this; --samples is then the most a pixel gets");
  CLI::Option* time_limit =
      add_real(command, "--time-limit", arguments.time_limit,
               "End after so many seconds of rendering; --samples is then the most a pixel gets");
  command.get_option("--sample-range")->excludes(command.get_option("--samples"));
  // Parts of a picture that are put together later must not each decide when they are good enough.
  for (CLI::Option* goal : {error, time_limit})
    for (const char* part : {"--crop", "--sample-range"}) goal->excludes(command.get_option(part));
  command
      .add_option_function<std::string>(
          "--aov",
          [&arguments](const std::string& text) {
            for (std::size_t begin = 0; begin <= text.size();) {
              const std::size_t end = std::min(text.find(',', begin), text.size());
              const auto aov = render::aov_of_name(std::string_view(text).substr(begin, end - begin));
              if (!aov) refuse("--aov", "names with commas between them: " + aov_names(), text);
              arguments.aovs.add(*aov);
              begin = end + 1;
            }
          },
          "Write more channels into an .exr: " + aov_names())
      ->option_text("A,B");
}

void add_running_options(CLI::App& command, RenderArguments& arguments) {
  add_whole(command, "--threads", arguments.threads,
            "Threads to use, in place of as many as the machine has");
  command
      .add_option("--stats", arguments.statistics_file,
                  "Write times and counts of the run to this file, as JSON")
      ->option_text("FILE.json");
  command.add_flag("--strict", arguments.strict,
                   "Make values of shaders out of their range, a tolerance that is not kept and light that the "
                   "film loses an error");
  command.add_flag("--profile", arguments.profile,
                   "Print the share of each source line in the shaders' time");
  command.add_flag("--quiet", arguments.quiet, "Say nothing but errors and warnings");
  command.add_flag("--json", arguments.json, "Print problems and statistics as JSON on standard output");
  auto* pixel = add_whole_text_option(
      command, "--pixel", "With --sample: replay one sample of this pixel and print what happens on its path",
      [&arguments](const std::string& text, const WholeOption& option) {
        const auto [x, y] = read_wholes<int, 2>(option, text);
        arguments.pixel = Pair<int>{x, y};
      });
  auto* sample =
      add_whole(command, "--sample", arguments.sample, "With --pixel: the sample to replay, counted from 0");
  pixel->needs(sample);
  sample->needs(pixel);
}

// The text as one word of a shell's command line.
std::string shell_word(const std::string& text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

void add_render_options(CLI::App& command, RenderArguments& arguments) {
  command.add_option("scene", arguments.scene.path, "The scene to render")->required()->option_text("SCENE");
  command.add_option("-o,--output", arguments.output, "The picture to write: .exr (linear) or .png (sRGB)")
      ->option_text("OUT");
  add_scene_options(command, arguments.scene);
  add_picture_options(command, arguments);
  add_quality_options(command, arguments);
  add_method_options(command, arguments);
  add_goal_options(command, arguments);
  add_running_options(command, arguments);
}

void apply_settings(const RenderArguments& arguments, scene::RenderSettings& settings) {
  if (arguments.resolution) {
    settings.width = arguments.resolution->x;
    settings.height = arguments.resolution->y;
  }
  settings.samples = arguments.samples.value_or(settings.samples);
  settings.step = arguments.step.value_or(settings.step);
  settings.light_samples = arguments.light_samples.value_or(settings.light_samples);
  settings.bounces = arguments.bounces.value_or(settings.bounces);
  if (arguments.multiple_scattering == MultipleScatteringChoice::full)
    settings.multiple_scattering.approximate.reset();
  else if (arguments.multiple_scattering && !settings.multiple_scattering.approximate)
    settings.multiple_scattering.approximate.emplace();
  settings.seed = arguments.seed.value_or(settings.seed);
}

std::string replay_command(const RenderArguments& arguments, int x, int y, std::uint64_t sample) {
  std::string command = "tyndall render " + shell_word(arguments.scene.path);
  const auto add = [&command](std::string_view option, const auto& value) {
    if (value) command += fmt::format(" {} {}", option, *value);
  };
  add("--frame", arguments.scene.frame);
  for (const auto& [variable, expression] : arguments.scene.overrides)
    command += " --set " + shell_word(variable + "=" + expression);
  for (const std::string& directory : arguments.scene.include_directories)
    command += " --include " + shell_word(directory);
  if (arguments.scene.allow_outside) command += " --allow-outside";
  if (arguments.resolution)
    command += fmt::format(" --resolution {}x{}", arguments.resolution->x, arguments.resolution->y);
  add("--samples", arguments.samples);
  if (arguments.step) command += " --step " + shell_word(scene::describe(*arguments.step));
  add("--light-samples", arguments.light_samples);
  add("--bounces", arguments.bounces);
  if (arguments.multiple_scattering)
    command += fmt::format(" --multiple-scattering {}",
                           name_in(multiple_scatterings, *arguments.multiple_scattering));
  add("--seed", arguments.seed);
  add("--error", arguments.error);
  if (arguments.aovs.has(render::Aov::variance)) command += " --aov variance";
  const RenderArguments defaults;
  if (arguments.method != defaults.method) command += fmt::format(" --method {}", name(arguments.method));
  if (arguments.distance != defaults.distance)
    command += fmt::format(" --distance {}", name(arguments.distance));
  if (arguments.transmittance != defaults.transmittance)
    command += fmt::format(" --transmittance {}", name(arguments.transmittance));
  if (arguments.emission_sampling != defaults.emission_sampling)
    command += fmt::format(" --emission {}", name_in(emissions, arguments.emission_sampling));
  return command + fmt::format(" --pixel {},{} --sample {}", x, y, sample);
}

}  // namespace tyndall::tools
