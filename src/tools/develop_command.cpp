// `tyndall develop`: a rendered picture as one to look at.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "denoise/denoise.h"
#include "image/colors.h"
#include "image/develop.h"
#include "image/image.h"
#include "render/film/film.h"
#include "tools/commands.h"
#include "tools/files_in_use.h"
#include "tools/identity.h"
#include "tools/memory.h"
#include "tools/numbers.h"
#include "tools/part_facts.h"
#include "tools/render_arguments.h"
#include "tools/report.h"
#include "tools/view_options.h"

namespace tyndall::tools {
namespace {

using image::Image;

struct DevelopArguments {
  std::string picture, output, layer;
  GivenView view;
  bool denoise = false;
  std::optional<render::PixelWindow> crop;
};

// What a file that is no picture is, and what makes one of it.
std::string why_no_picture(const std::string& path) {
  if (is_part(path) || path.ends_with(checkpoint_extension))
    return fmt::format("'{}' is {}: {}", path, is_part(path) ? "a part of a picture" : "a checkpoint",
                       is_part(path) ? "merge the parts, and develop the .exr that they give"
                                     : "render with --resume, and develop the picture that it ends as");
  if (path.ends_with(".tyn")) return fmt::format("'{}' is a scene: render it, and develop the .exr", path);
  return {};
}

std::string picture_files_problem(const DevelopArguments& arguments) {
  if (std::string problem = why_no_picture(arguments.picture); !problem.empty()) return problem;
  FilesInUse files;
  if (std::string problem = files.read(arguments.picture, "the picture"); !problem.empty()) return problem;
  if (std::string problem = image::check_writable(arguments.output); !problem.empty()) return problem;
  return files.write(arguments.output, "-o");
}

// ------------------------------------------------------------------------------------------------------
// layers

// The names before the dots of channels that have one: "beauty" of "beauty.R".
std::vector<std::string> layers_of(const std::vector<std::string>& channels) {
  std::vector<std::string> layers;
  for (const std::string& channel : channels) {
    const std::string layer = channel.substr(0, channel.rfind('.'));
    if (layer.size() < channel.size() && std::find(layers.begin(), layers.end(), layer) == layers.end())
      layers.push_back(layer);
  }
  return layers;
}

// The channels of a layer that are its colours, or the one that it has; none where there is neither. The
// layer without a name is that of channels without a dot.
std::vector<std::size_t> shown_channels(const std::vector<std::string>& channels, const std::string& layer) {
  const std::string begin = layer.empty() ? "" : layer + ".";
  std::vector<std::size_t> rgb;
  for (const char* name : {"R", "G", "B"})
    if (const std::size_t i = image::find_channel(channels, begin + name); i < channels.size())
      rgb.push_back(i);
  if (rgb.size() == 3) return rgb;
  std::vector<std::size_t> single;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& name = channels[i];
    const bool is_of_layer = layer.empty() ? name.find('.') == std::string::npos
                                           : image::same_name(name, layer) || name.starts_with(begin);
    if (is_of_layer && !image::same_name(name, begin + "A")) single.push_back(i);
  }
  return single.size() == 1 ? single : std::vector<std::size_t>{};
}

// Only these channels, called R, G and B, or Y.
Image of_channels(const Image& image, const std::vector<std::size_t>& chosen) {
  Image out{image.width, image.height, {"Y"}, {}, image.place};
  if (chosen.size() == 3) out.channels = {"R", "G", "B"};
  out.pixels.reserve(image.pixels.size() / image.channels.size() * chosen.size());
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
    for (const std::size_t channel : chosen) out.pixels.push_back(image.pixels[i + channel]);
  return out;
}

// The light that is to be shown; or nothing, with the reason in `problem`.
std::optional<Image> light_of(const DevelopArguments& arguments, const Image& image, std::string& problem) {
  const std::vector<std::string> layers = layers_of(image.channels);
  std::vector<std::size_t> chosen = shown_channels(image.channels, arguments.layer);
  // Colours of the only layer are rather meant than a depth beside them.
  if (chosen.size() < 3 && arguments.layer.empty() && layers.size() == 1)
    if (const auto of_layer = shown_channels(image.channels, layers[0]); of_layer.size() > chosen.size())
      chosen = of_layer;
  if (!chosen.empty()) return of_channels(image, chosen);
  problem = fmt::format("'{}' has no {}: its channels are {}", arguments.picture,
                        arguments.layer.empty() ? "R, G and B" : fmt::format("layer '{}'", arguments.layer),
                        fmt::join(image.channels, ", "));
  if (!layers.empty())
    problem += fmt::format("; show a layer with --layer {}", fmt::join(layers, ", --layer "));
  return std::nullopt;
}

// The same with R, G and B denoised, where that is asked for; nothing where it cannot be.
std::optional<Image> denoised_light(const DevelopArguments& arguments, const Image& image,
                                    std::string& problem) {
  if (!arguments.layer.empty()) {
    problem = "--denoise denoises R, G and B; --layer shows other channels. Leave out one of them";
    return std::nullopt;
  }
  denoise::Result result = denoise::denoise(image);
  if (result.error.empty()) {
    result.picture.place = image.place;
    return std::move(result.picture);
  }
  problem = fmt::format("cannot denoise '{}': {}", arguments.picture, result.error);
  return std::nullopt;
}

// ------------------------------------------------------------------------------------------------------
// numbers

// Tells of pixels that no camera would give.
void warn_of_bad_pixels(const std::string& path, const Image& image) {
  std::size_t not_numbers = 0, infinite = 0;
  const std::size_t channels = image.channels.size();
  for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
    const auto any = [&](auto&& is) {
      return std::any_of(image.pixels.begin() + static_cast<std::ptrdiff_t>(i),
                         image.pixels.begin() + static_cast<std::ptrdiff_t>(i + channels), is);
    };
    if (any([](float v) { return std::isnan(v); }))
      ++not_numbers;
    else if (any([](float v) { return std::isinf(v); }))
      ++infinite;
  }
  const auto pixels = [](std::size_t n) { return fmt::format("{} pixel{}", n, n == 1 ? "" : "s"); };
  if (not_numbers > 0)
    print_warning(fmt::format("'{}' has {} with values that are no numbers: they are shown black", path,
                              pixels(not_numbers)));
  if (infinite > 0)
    print_warning(fmt::format("'{}' has {} with infinite values: they are shown as bright as can be", path,
                              pixels(infinite)));
}

std::string crop_problem(const DevelopArguments& arguments, const Image& image) {
  const auto& crop = arguments.crop;
  if (!crop || (crop->x1 <= image.width && crop->y1 <= image.height)) return {};
  return fmt::format("--crop {},{},{},{} reaches outside '{}', which is {}x{}", crop->x0, crop->y0, crop->x1,
                     crop->y1, arguments.picture, image.width, image.height);
}

Image cropped(const Image& image, const render::PixelWindow& crop) {
  Image out{crop.x1 - crop.x0, crop.y1 - crop.y0, image.channels, {}};
  for (int y = crop.y0; y < crop.y1; ++y)
    out.pixels.insert(out.pixels.end(),
                      image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(crop.x0, y, 0)),
                      image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(crop.x1, y, 0)));
  return out;
}

// What the picture tells of its making, and what was done to it now.
image::Metadata metadata_of_developed(const image::Metadata& told, const image::View& view, double stops,
                                      const DevelopArguments& arguments) {
  image::Metadata metadata{{"Software", "Tyndall " TYNDALL_VERSION}};
  for (const std::string_view name : entries_of_making)
    if (std::string value = metadata_entry(told, name); !value.empty())
      metadata.emplace_back(std::string(name), std::move(value));
  std::string done = fmt::format("exposure={} tonemap={}", describe(view.exposure), describe(view.tonemap));
  if (view.exposure.metered) done += fmt::format(" stops={:.4f}", stops);
  if (const auto& white = view.white) done += fmt::format(" white={},{},{}", white->x, white->y, white->z);
  if (view.bloom > 0) done += fmt::format(" bloom={}", view.bloom);
  if (arguments.denoise) done += " denoise=on";
  if (!arguments.layer.empty()) done += fmt::format(" layer={}", arguments.layer);
  if (const auto& crop = arguments.crop)
    done += fmt::format(" crop={},{},{},{}", crop->x0, crop->y0, crop->x1, crop->y1);
  metadata.emplace_back(std::string(developed_entry), done);
  return metadata;
}

ExitStatus no_picture(const std::string& message) { return print_error(message), ExitStatus::problem; }

ExitStatus run_develop(const DevelopArguments& arguments) {
  std::string problem = picture_files_problem(arguments);
  if (!problem.empty()) return no_picture(problem);
  const image::ReadResult read = image::read(arguments.picture);
  if (!read.image) return no_picture(read.error);
  const std::optional<Image> light = arguments.denoise ? denoised_light(arguments, *read.image, problem)
                                                       : light_of(arguments, *read.image, problem);
  if (light) problem = crop_problem(arguments, *light);
  if (!problem.empty()) return no_picture(problem);
  warn_of_bad_pixels(arguments.picture, *light);

  image::View view = in_place(arguments.view, read.view);
  const double stops = image::stops_of(view, *light);
  const image::Metadata metadata = metadata_of_developed(read.metadata, view, stops, arguments);
  if (view.exposure.metered)
    print_message(fmt::format("{}: metered exposure {:.2f}\n", arguments.output, stops));
  view.exposure = {stops, false};
  Image exposed = image::expose(*light, view);
  image::View shown{.tonemap = view.tonemap};
  if (const auto& crop = arguments.crop) {
    exposed = cropped(exposed, *crop);
    shown.first_x = crop->x0;
    shown.first_y = crop->y0;
  }
  problem = image::write(arguments.output, exposed, metadata, shown);
  return problem.empty() ? ExitStatus::done : no_picture(problem);
}

Action develop_options(CLI::App& command) {
  const auto arguments = std::make_shared<DevelopArguments>();
  command.add_option("picture", arguments->picture, "The picture: an .exr of Tyndall or of another program")
      ->required()
      ->option_text("PICTURE");
  command
      .add_option("-o,--output", arguments->output,
                  "The picture to write: .png or .jpg (8 bits), .tif (16 bits), or .exr (light, without "
                  "a tone curve)")
      ->required()
      ->option_text("OUT");
  add_view_options(command, arguments->view, "in place of what the picture says");
  add_lens_options(command, arguments->view);
  command.add_flag("--denoise", arguments->denoise,
                   "Remove noise first: wants an .exr of `render --denoise` or `render --aov half`");
  add_whole_text_option(
      command, "--crop",
      "Write only the pixels from (x0, y0) up to, not including, (x1, y1), as the whole picture shows them",
      [arguments](const std::string& text, const WholeOption& option) {
        arguments->crop = read_window(option, text);
      });
  command
      .add_option("--layer", arguments->layer,
                  "Show this layer of an .exr in place of its colours: albedo shows albedo.R, .G and .B")
      ->option_text("NAME");
  return
      [arguments] { return with_memory("to develop the picture", [&] { return run_develop(*arguments); }); };
}

}  // namespace

constinit const Command develop_command{"develop", "Make a picture to look at of one that was rendered",
                                        develop_options};

}  // namespace tyndall::tools
