#include "tools/denoising.h"

#include "base/check.h"
#include "denoise/denoise.h"

namespace tyndall::tools {

namespace {

// The image with a picture's R, G and B in place of its own, which become noisy.R, ….
image::Image with_picture(const image::Image& image, const image::Image& picture) {
  image::Image out{
      image.width, image.height, {"R", "G", "B", "noisy.R", "noisy.G", "noisy.B"}, {}, image.place};
  out.channels.insert(out.channels.end(), image.channels.begin() + 3, image.channels.end());
  const std::size_t channels = image.channels.size();
  out.pixels.reserve(image.pixels.size() + picture.pixels.size());
  for (std::size_t i = 0, k = 0; i < image.pixels.size(); i += channels, k += 3) {
    const auto from = image.pixels.begin() + static_cast<std::ptrdiff_t>(i);
    out.pixels.insert(out.pixels.end(), {picture.pixels[k], picture.pixels[k + 1], picture.pixels[k + 2]});
    out.pixels.insert(out.pixels.end(), from, from + static_cast<std::ptrdiff_t>(channels));
  }
  return out;
}

}  // namespace

render::AovSet recorded_outputs(const RenderArguments& arguments) {
  render::AovSet outputs = arguments.aovs;
  if (arguments.denoise)
    for (const std::string_view name : denoise::outputs) outputs.add(*render::aov_of_name(name));
  return outputs;
}

image::Image picture_to_write(const render::Film& film, bool denoise, const std::string& path, int threads) {
  image::Image image = film.image();
  if (!denoise) return image;
  denoise::Result result = denoise::denoise(image, threads);
  CHECK(result.error.empty());
  return path.ends_with(".exr") ? with_picture(image, result.picture) : std::move(result.picture);
}

}  // namespace tyndall::tools
