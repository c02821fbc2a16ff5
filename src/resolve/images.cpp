#include "resolve/images.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "image/image.h"
#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

// The index of the channel called so, whatever its case.
std::optional<std::size_t> channel_of(const image::Image& picture, std::string_view name) {
  const auto same = [&](const std::string& channel) {
    return std::equal(channel.begin(), channel.end(), name.begin(), name.end(),
                      [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
  };
  const auto found = std::find_if(picture.channels.begin(), picture.channels.end(), same);
  if (found == picture.channels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - picture.channels.begin());
}

// The channels that make its colour: R, G and B, or what stands for all of them.
std::array<std::size_t, 3> color_channels(const image::Image& picture) {
  const auto r = channel_of(picture, "R"), g = channel_of(picture, "G"), b = channel_of(picture, "B");
  if (r && g && b) return {*r, *g, *b};
  if (picture.channels.size() < 3) return {0, 0, 0};
  return {0, 1, 2};
}

PlanePointer plane_of(const image::Image& picture, std::size_t channel, const std::string& file) {
  std::vector<float> texels;
  texels.reserve(picture.pixels.size() / picture.channels.size());
  for (int y = picture.height; y-- > 0;)
    for (int x = 0; x < picture.width; ++x) texels.push_back(picture.at(x, y, channel));
  return make_plane(fmt::format("{} {}", file, picture.channels[channel]), picture.width, picture.height,
                    std::move(texels));
}

}  // namespace

std::string Images::find(const std::string& name, Span span) {
  const auto path = find_file(run_, run_.sources[span.source].name(), name);
  std::error_code failed;
  if (path && std::filesystem::is_regular_file(*path, failed)) return path->string();
  if (path) {
    run_.diagnostics.error(span, fmt::format("cannot read '{}': it is not a file", name));
    return {};
  }
  const auto& directories = run_.options.include_directories;
  run_.diagnostics.error(
      span, fmt::format("no picture '{}'", name),
      directories.empty()
          ? "looked beside the file that names it; --include adds directories"
          : fmt::format("looked beside the file that names it and in: {}", fmt::join(directories, ", ")));
  return {};
}

std::vector<PlanePointer> Images::planes(const eval::Image& image) {
  if (stand_in_) {
    const PlanePointer black = make_plane("", 1, 1, {0});
    return image.channel.empty() ? std::vector{black, black, black} : std::vector{black};
  }
  const auto [known, is_new] = known_.try_emplace({image.path, image.channel});
  if (is_new) known->second = decoded(image);
  return known->second;
}

std::vector<PlanePointer> Images::decoded(const eval::Image& image) {
  const auto fail = [&](std::string message, std::string help = {}) -> std::vector<PlanePointer> {
    run_.diagnostics.error(image.span, std::move(message), std::move(help));
    return {};
  };
  const image::ReadResult read = image::read_any(image.path, max_image_pixels);
  if (!read.image) return fail(read.error);
  const image::Image& picture = *read.image;
  const std::string file = std::filesystem::path(image.path).filename().string();
  const auto bad = std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                 [](float value) { return !std::isfinite(value); });
  if (bad > 0)
    run_.diagnostics.warning(image.span, fmt::format("'{}' holds {} values that are not finite", file, bad),
                             "they count as 0");
  if (!image.channel.empty()) {
    const auto channel = channel_of(picture, image.channel);
    if (!channel)
      return fail(fmt::format("'{}' has no channel '{}'", file, image.channel),
                  fmt::format("it has: {}", fmt::join(picture.channels, ", ")));
    return {plane_of(picture, *channel, file)};
  }
  std::vector<PlanePointer> planes;
  const auto channels = color_channels(picture);
  for (std::size_t c = 0; c < 3; ++c)
    planes.push_back(c > 0 && channels[c] == channels[0] ? planes[0] : plane_of(picture, channels[c], file));
  return planes;
}

}  // namespace tyndall::resolve
