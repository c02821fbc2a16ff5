#include "image/develop.h"

#include <algorithm>
#include <cmath>

#include "image/bloom.h"
#include "image/colors.h"
#include "image/metering.h"
#include "image/tone_curve.h"
#include "image/white_balance.h"

namespace tyndall::image {

namespace {

// IEC 61966-2-1, of a value in [0, 1].
float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

Rgb srgb_from_linear(const Rgb& c) {
  return {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)};
}

// With the black around a part.
Image whole_image(const Image& image) {
  const Image::Place place = whole_of(image);
  if (place.whole_width == image.width && place.whole_height == image.height) {
    Image same = image;
    same.place = {};
    return same;
  }
  Image whole{place.whole_width, place.whole_height, image.channels, {}};
  whole.pixels.resize(whole.index(0, whole.height, 0));
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(0, y, 0)),
                static_cast<std::ptrdiff_t>(image.index(0, 1, 0)),
                whole.pixels.begin() + static_cast<std::ptrdiff_t>(whole.index(place.x, y + place.y, 0)));
  return whole;
}

// Interleaved gradient noise, in [0, 1), of which any few pixels side by side have values that are evenly
// apart (Jimenez 2014, "Next generation post processing in Call of Duty: Advanced Warfare").
double gradient_noise(int x, int y) {
  const double at = 0.06711056 * x + 0.00583715 * y, turns = 52.9829189 * (at - std::floor(at));
  return turns - std::floor(turns);
}

}  // namespace

double stops_of(const View& view, const Image& image) {
  return view.exposure.stops + (view.exposure.metered ? metered_stops(image) : 0);
}

Image expose(const Image& image, const View& view) {
  Image exposed = whole_image(image);
  const ColorChannels channels = color_channels(image.channels);
  const auto scale = static_cast<float>(std::exp2(stops_of(view, image)));
  if (channels.is_grey())
    for (float& value : exposed.pixels) value *= scale;
  else
    for (std::size_t i = 0; i < exposed.pixels.size(); i += image.channels.size())
      channels.set_color(&exposed.pixels[i], channels.color(&exposed.pixels[i]) * scale);
  if (view.white && !channels.is_grey()) {
    const WhiteBalance balance(*view.white);
    for (std::size_t i = 0; i < exposed.pixels.size(); i += image.channels.size())
      channels.set_color(&exposed.pixels[i], balance.balanced(channels.color(&exposed.pixels[i])));
  }
  if (view.bloom > 0) add_bloom(exposed, channels, view.bloom);
  return exposed;
}

Image develop(const Image& image, const View& view) {
  Image shown = expose(image, view);
  const ColorChannels channels = color_channels(image.channels);
  const bool is_grey = channels.is_grey();
  const std::size_t count = image.channels.size();
  for (std::size_t i = 0; i < shown.pixels.size(); i += count) {
    float* pixel = &shown.pixels[i];
    const Rgb color = srgb_from_linear(tone_curve(view.tonemap, channels.color(pixel)));
    for (std::size_t k = 0; k < count; ++k)
      if (is_grey || std::find(channels.rgb.begin(), channels.rgb.end(), k) == channels.rgb.end())
        pixel[k] = srgb_from_linear(tone_curve(is_grey ? view.tonemap : Tonemap::none, Rgb(pixel[k])).x);
    if (!is_grey) channels.set_color(pixel, color);
  }
  return shown;
}

Image develop_in_8_bits(const Image& image, const View& view) {
  Image shown = develop(image, view);
  const bool is_dithered = view.tonemap != Tonemap::none;
  const std::size_t channels = shown.channels.size();
  std::size_t i = 0;
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      // The same for all channels: grey stays grey.
      const double noise = gradient_noise(x + view.first_x, y + view.first_y);
      for (std::size_t c = 0; c < channels; ++c, ++i) {
        const double step = 255 * std::clamp(double{shown.pixels[i]}, 0.0, 1.0), whole = std::round(step);
        // What is a whole step but for rounding stays one.
        constexpr double rounding = 1e-3;
        const bool nearest = !is_dithered || std::abs(step - whole) < rounding;
        shown.pixels[i] = static_cast<float>((nearest ? whole : std::floor(step + noise)) / 255);
      }
    }
  return shown;
}

}  // namespace tyndall::image
