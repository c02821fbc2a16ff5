#include "tools/measure/thumbnails.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "image/false_colors.h"
#include "tools/html.h"

namespace tyndall::tools {
namespace {

constexpr int largest_width = 480;  // [pixels]

Thumbnail thumbnail_of(const image::Image& picture, const image::View& view) {
  image::Image small = picture;
  if (picture.width > largest_width) {
    const int height = std::max(1, picture.height * largest_width / picture.width);
    if (std::string problem = image::resize(picture, largest_width, height, small); !problem.empty())
      return {.problem = std::move(problem)};
  }
  std::vector<unsigned char> bytes;
  if (std::string problem = image::encode_png(small, view, bytes); !problem.empty())
    return {.problem = std::move(problem)};
  return {.uri = "data:image/png;base64," + base64(bytes)};
}

}  // namespace

image::Image picture_of(std::vector<float> pixels, int width, int height) {
  return {width, height, {"R", "G", "B"}, std::move(pixels)};
}

Thumbnail shown_picture(const image::Image& picture, const image::View& view) {
  return thumbnail_of(picture, view);
}

Thumbnail error_map(const image::Image& picture, const image::Image& reference, double most) {
  double mean = 0;
  for (const float value : reference.pixels) mean += value / static_cast<double>(reference.pixels.size());
  const double floor = 0.01 * sqr(mean);
  image::Image map = reference;
  for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
    double square = 0;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double r = reference.pixels[c], scale = sqr(r) + floor;
      if (scale > 0) square += sqr(picture.pixels[c] - r) / scale / 3;
    }
    const image::SrgbColor color = image::color_of_level(std::sqrt(square) / most);
    for (std::size_t c = 0; c < 3; ++c)
      map.pixels[i + c] = image::linear_from_srgb(static_cast<float>(color[c]));
  }
  return thumbnail_of(map, image::View::of_numbers());
}

}  // namespace tyndall::tools
