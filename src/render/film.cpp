#include "render/film.h"

#include "base/check.h"

namespace tyndall::render {

Film::Film(int width, int height) : width_(width), height_(height) {
  CHECK_GT(width, 0);
  CHECK_GT(height, 0);
  pixels_.resize(static_cast<std::size_t>(width) * height);
}

void Film::add(int x, int y, const Rgb& radiance) {
  Pixel& pixel = pixels_[index(x, y)];
  pixel.r.add(radiance.x);
  pixel.g.add(radiance.y);
  pixel.b.add(radiance.z);
  ++pixel.samples;
}

Rgb Film::mean(int x, int y) const {
  const Pixel& pixel = pixels_[index(x, y)];
  if (pixel.samples == 0) return {};
  const double n = pixel.samples;
  return Rgb(Vec3d{pixel.r.value() / n, pixel.g.value() / n, pixel.b.value() / n});
}

image::Image Film::image() const {
  image::Image out{width_, height_, {"R", "G", "B"}, {}};
  out.pixels.reserve(pixels_.size() * 3);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const Rgb c = mean(x, y);
      out.pixels.insert(out.pixels.end(), {c.x, c.y, c.z});
    }
  return out;
}

}  // namespace tyndall::render
