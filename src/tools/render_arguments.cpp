#include "tools/render_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

namespace tyndall::tools {
namespace {

constexpr int max_edge = 1 << 16;   // pixels
constexpr int max_count = 1 << 30;  // samples, bounces
constexpr int max_threads = 1 << 12;
const CLI::Range positive_count(1, max_count);
// CLI11 alone would let -1 through as 2^64 - 1.
const CLI::Validator not_below_zero(
    [](const std::string& text) {
      return text.starts_with('-') ? fmt::format("wants a whole number from 0, not '{}'", text)
                                   : std::string();
    },
    "");

// A finite number above 0, by itself.
CLI::Validator positive_number(std::string_view wanted) {
  return {[wanted](const std::string& text) {
            double value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good =
                error == std::errc() && end == text.data() + text.size() && value > 0 && std::isfinite(value);
            return good ? std::string() : fmt::format("wants {} above 0, not '{}'", wanted, text);
          },
          ""};
}

// Whole numbers with the separators between them and nothing else: "640x360" with "x", "0,0,8,8" with ",".
bool read_numbers(std::string_view text, std::string_view separator, std::span<int> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) {
      if (!text.starts_with(separator)) return false;
      text.remove_prefix(separator.size());
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), numbers[i]);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return text.empty();
}

bool read_number(std::string_view text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0 && std::isfinite(number);
}

// "0.1", "auto", "auto(1%)", "auto(0.01)".
std::optional<scene::Step> read_step(std::string_view text) {
  double number = 0;
  if (text == "auto") return scene::Step::automatic_unproven();
  if (!text.starts_with("auto(") || !text.ends_with(")"))
    return read_number(text, number) ? std::optional<scene::Step>(number) : std::nullopt;
  text = text.substr(5, text.size() - 6);
  const bool percent = text.ends_with("%");
  if (percent) text.remove_suffix(1);
  if (!read_number(text, number) || !((number = percent ? number / 100 : number) < 1)) return std::nullopt;
  return scene::Step::automatic_within(number);
}

constexpr Choice<MultipleScatteringChoice> multiple_scatterings[] = {
    {scene::MultipleScattering::full, MultipleScatteringChoice::full},
    {scene::ApproximateScattering::keyword, MultipleScatteringChoice::approximate},
};

[[noreturn]] void refuse(const std::string& option, std::string_view wanted, const std::string& text) {
  throw CLI::ValidationError(option, fmt::format("wants {}, not '{}'", wanted, text));
}

std::string aov_names() {
  std::string names;
  for (const render::AovInfo& info : render::aov_infos())
    names += (names.empty() ? "" : " ") + std::string(info.name);
  return names;
}

void add_picture_options(CLI::App& command, RenderArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--resolution",
          [&arguments](const std::string& text) {
            int n[2] = {};
            if (!read_numbers(text, "x", n) || std::min(n[0], n[1]) < 1 || std::max(n[0], n[1]) > max_edge)
              refuse("--resolution", fmt::format("WIDTHxHEIGHT, each 1 to {}", max_edge), text);
            arguments.resolution = Pair<int>{n[0], n[1]};
          },
          "Size of the picture in pixels, in place of the scene's")
      ->option_text("WxH");
  command
      .add_option_function<std::string>(
          "--crop",
          [&arguments](const std::string& text) {
            int n[4] = {};
            if (!read_numbers(text, ",", n) || n[0] < 0 || n[1] < 0 || n[2] <= n[0] || n[3] <= n[1])
              refuse("--crop", "x0,y0,x1,y1 with 0 <= x0 < x1 and 0 <= y0 < y1", text);
            arguments.crop = {n[0], n[1], n[2], n[3]};
          },
          "Render only the pixels from (x0, y0) up to, not including, (x1, y1); the others stay black")
      ->option_text("X0,Y0,X1,Y1");
}

void add_quality_options(CLI::App& command, RenderArguments& arguments) {
  command.add_option("--samples", arguments.samples, "Samples a pixel, in place of the scene's")
      ->check(positive_count)
      ->option_text("N");
  command
      .add_option_function<std::string>(
          "--step",
          [&arguments](const std::string& text) {
            arguments.step = read_step(text);
            if (!arguments.step)
              refuse("--step", "a length in metres above 0, auto, or a tolerance: auto(1%)", text);
          },
          "Length of a step through a volume in metres, or auto(TOLERANCE): as long as proven bounds of the "
          "density allow; in place of the scene's (a volume's own stays)")
      ->option_text("X|auto|auto(1%)");
  command
      .add_option("--light-samples", arguments.light_samples,
                  "Direct-light samples a march, in place of the scene's")
      ->check(CLI::Range(1, 1 << 16))
      ->option_text("N");
  command.add_option("--bounces", arguments.bounces, "Scatterings after the first, in place of the scene's")
      ->check(CLI::Range(0, max_count))
      ->option_text("N");
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
  command.add_option("--seed", arguments.seed, "Seed of the random numbers, in place of the scene's")
      ->check(not_below_zero)
      ->option_text("N");
  command
      .add_option_function<std::string>(
          "--sample-range",
          [&arguments](const std::string& text) {
            int n[2] = {};
            if (!read_numbers(text, "..", n) || n[0] < 0 || n[1] < n[0] || n[1] > max_count)
              refuse("--sample-range", "A..B with 0 <= A <= B", text);
            arguments.sample_range = SampleRange{n[0], n[1]};
          },
          "Render the samples A to B, both included, of each pixel")
      ->option_text("A..B");
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
      command
          .add_option("--error", arguments.error,
                      "Sample each part of the picture until the root of its mean squared relative error is "
                      "below this; --samples is then the most a pixel gets")
          ->check(positive_number("a relative error"))
          ->option_text("X");
  CLI::Option* time_limit =
      command
          .add_option("--time-limit", arguments.time_limit,
                      "End after so many seconds of rendering; --samples is then the most a pixel gets")
          ->check(positive_number("seconds"))
          ->option_text("S");
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
  command.add_option("--threads", arguments.threads, "Threads to use (default: as many as the machine has)")
      ->check(CLI::Range(1, max_threads))
      ->option_text("N");
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
  auto* pixel = command
                    .add_option_function<std::string>(
                        "--pixel",
                        [&arguments](const std::string& text) {
                          int n[2] = {};
                          if (!read_numbers(text, ",", n) || n[0] < 0 || n[1] < 0)
                            refuse("--pixel", "x,y counted from 0 at the top left", text);
                          arguments.pixel = Pair<int>{n[0], n[1]};
                        },
                        "With --sample: replay one sample of this pixel and print what happens on its path")
                    ->option_text("X,Y");
  auto* sample =
      command.add_option("--sample", arguments.sample, "With --pixel: the sample to replay, counted from 0")
          ->check(not_below_zero)
          ->option_text("N");
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
