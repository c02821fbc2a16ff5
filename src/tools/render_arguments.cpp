#include "tools/render_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <utility>

#include "tools/denoising.h"
#include "tools/frame_list.h"
#include "tools/numbers.h"
#include "tools/shell_word.h"

namespace tyndall::tools {
namespace {

std::vector<std::string_view> aov_names() {
  std::vector<std::string_view> names;
  for (const render::AovInfo& info : render::aov_infos()) names.push_back(info.name);
  return names;
}

// Options that take a part of the picture.
void add_part_options(CLI::App& command, RenderArguments& arguments) {
  add_whole_text_option(
      command, "--crop",
      "Render only the pixels from (x0, y0) up to, not including, (x1, y1); the others stay black",
      [&arguments](const std::string& text, const WholeOption& option) {
        arguments.crop = read_window(option, text);
      });
  add_whole_text_option(command, "--sample-range", "Render the samples A to B, both included, of each pixel",
                        [&arguments](const std::string& text, const WholeOption& option) {
                          const auto [first, last] = read_wholes<int, 2>(option, text);
                          if (last < first) refuse(option.name, "A..B with A no more than B", text);
                          arguments.sample_range = SampleRange{first, last};
                        });
  command
      .add_option("--part-of", arguments.part_of,
                  "Do nothing if this picture, which the part is to be merged into, is there already")
      ->option_text("OUT");
}

// Options that render more than one frame.
void add_sequence_options(CLI::App& command, RenderArguments& arguments) {
  add_text_option(command, "--frames", real_option("--frames").form,
                  "Render these frames, each into a file of its number: -o 'out.####.exr'; without --frames "
                  "and --frame such an output gets all frames of `animation`",
                  [&arguments](const std::string& text) {
                    arguments.frames = read_frames(text);
                    if (!arguments.frames) refuse("--frames", real_option("--frames").wanted, text);
                  })
      ->excludes(command.get_option("--frame"));
  command
      .add_option("--movie", arguments.movie,
                  "Make a movie of the sequence by ffmpeg, which must be installed: .mp4, .mov or .mkv")
      ->option_text("OUT.mp4");
  command.add_flag("--overwrite", arguments.overwrite,
                   "Render the frames of a sequence that are there already, too");
}

// An option whose value is one of a table's names.
template <class Method, std::size_t count>
void add_choice(CLI::App& command, const std::string& option, const std::array<Choice<Method>, count>& table,
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
            refuse_name(option, names_of(table), text);
          },
          fmt::format("For experts: {} (default: {})", help, name_in(table, method)))
      ->option_text(names_of(table, "|"));
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
  // Parts of a picture that are put together later must not each decide when they are good enough.
  for (CLI::Option* goal : {error, time_limit})
    for (const char* part : {"--crop", "--sample-range"}) goal->excludes(command.get_option(part));
  add_output_option(command, arguments.aovs);
  command.add_flag("--denoise", arguments.denoise,
                   "Denoise the picture; an .exr keeps the undenoised one as noisy.R, noisy.G, noisy.B");
}

void add_running_options(CLI::App& command, RenderArguments& arguments) {
  add_whole(command, "--threads", arguments.threads,
            "Threads to use, in place of as many as the machine has");
  command
      .add_option("--stats", arguments.statistics_file,
                  "Write times and counts of the run to this file, as JSON")
      ->option_text("FILE.json");
  add_real(command, "--checkpoint-interval", arguments.checkpoint_interval,
           "Seconds from one checkpoint to the next, in place of 10, or more where writing takes long");
  command.add_flag("--resume", arguments.resume,
                   "Go on from the checkpoint that a run of the same command left beside the output");
  command.add_flag(
      "--strict", arguments.strict,
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
  pixel->excludes(command.get_option("--frames"));
  pixel->needs(sample);
  sample->needs(pixel);
}

}  // namespace

render::PixelWindow read_window(const WholeOption& option, const std::string& text) {
  const auto [x0, y0, x1, y1] = read_wholes<int, 4>(option, text);
  if (x1 <= x0 || y1 <= y0) refuse(option.name, "X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1", text);
  return {x0, y0, x1, y1};
}

void add_output_option(CLI::App& command, render::AovSet& aovs) {
  command
      .add_option_function<std::string>(
          "--aov",
          [&aovs](const std::string& text) {
            for (std::size_t begin = 0; begin <= text.size();) {
              const std::size_t end = std::min(text.find(',', begin), text.size());
              const std::string_view name = std::string_view(text).substr(begin, end - begin);
              const auto aov = render::aov_of_name(name);
              if (!aov) refuse_name("--aov", aov_names(), name);
              aovs.add(*aov);
              begin = end + 1;
            }
          },
          fmt::format("Write more channels into an .exr: {}", fmt::join(aov_names(), " ")))
      ->option_text("A,B");
}

void add_method_options(CLI::App& command, RenderArguments& arguments) {
  add_choice(command, "--method", methods, arguments.method, "how paths go through media");
  add_choice(command, "--distance", distances, arguments.distance,
             "how distances for direct light are sampled");
  add_choice(command, "--transmittance", transmittances, arguments.transmittance,
             "how much of a light arrives through what has no closed form");
  add_choice(command, "--emission", emissions, arguments.emission_sampling,
             "whether media that emit are sampled as lights or left to rays that pass through them");
}

void add_render_options(CLI::App& command, RenderArguments& arguments) {
  command.add_option("scene", arguments.scene.path, "The scene to render")->required()->option_text("SCENE");
  command
      .add_option(
          "-o,--output", arguments.output,
          "The picture to write: .exr (linear), or .png, .jpg or .tif (developed); or a part of it to "
          "merge: .tynpart")
      ->option_text("OUT");
  add_scene_options(command, arguments.scene);
  add_sequence_options(command, arguments);
  add_setting_options(command, arguments.settings);
  add_view_options(command, arguments.view, "in place of what the scene says");
  add_part_options(command, arguments);
  add_method_options(command, arguments);
  add_goal_options(command, arguments);
  add_running_options(command, arguments);
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
  for (const auto& [option, text] : as_options(arguments.settings))
    command += fmt::format(" {} {}", option, shell_word(text));
  add("--error", arguments.error);
  if (recorded_outputs(arguments).grouped()) command += " --aov variance";
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
