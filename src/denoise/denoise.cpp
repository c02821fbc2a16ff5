#include "denoise/denoise.h"

#include <cmath>

#include "base/numerics.h"
#include "base/parallel.h"
#include "denoise/window.h"

namespace tyndall::denoise {

namespace {

constexpr int centre_distance = 4;   // of windows, each way
constexpr int error_radius = 5;      // of the square that errors are averaged over
constexpr float outlying = 16;       // times the noise around: what a pixel is then trusted for half in a fit
constexpr float quiet = 0.05f;       // of the noise around
constexpr float enough = 0.3f;       // weight; what is missing of it is the pixel's own
constexpr float negligible = 0.01f;  // part of the picture's noise below which a layer's is left alone
constexpr int tile_side = 64;        // a multiple of it, above 2 window_radius

// Planes of a layer that both of its halves share.
struct Noise {
  Plane raw;       // (first - second)²/2, the sum over the channels: of the variance of a half, one sample
  Plane variance;  // its mean around a pixel
  Plane around;    // its mean over a window
  Plane reliability;  // of a pixel in a regression
};

Noise noise_of(const Layer& layer, int threads) {
  const int width = layer.first[0].width(), height = layer.first[0].height();
  Noise noise{Plane(width, height), {}, {}, Plane(width, height)};
  for_rows(height, threads, [&](int y) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int x = 0; x < width; ++x)
        *noise.raw.at(x, y) += 0.5f * sqr(*layer.first[c].at(x, y) - *layer.second[c].at(x, y));
  });
  noise.variance = box_mean(noise.raw, 2, threads);
  noise.around = box_mean(noise.raw, window_radius, threads);
  for_rows(height, threads, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float usual = *noise.around.at(x, y), here = *noise.raw.at(x, y);
      *noise.reliability.at(x, y) = usual > 0 ? 1 / (1 + sqr(here / (outlying * usual))) : 1.0f;
    }
  });
  noise.variance.extend();
  noise.reliability.extend();
  return noise;
}

// Adds up the variances of all layers.
void add_variance(const Noise& noise, int threads, Plane& total) {
  for_rows(total.height(), threads, [&](int y) {
    for (int x = 0; x < total.width(); ++x) *total.at(x, y) += *noise.variance.at(x, y);
  });
}

struct Filtered {
  Colors color;  // sums of weighted predictions, then their means
  Plane weight;
};

// Calls body(x0, y0, x1, y1) for each tile of the picture, in four turns so that no two tiles at work are
// neighbours: what windows of both add to the same pixel is added in the same order by any number of threads.
template <class Body>
void for_tiles(int width, int height, int threads, Body&& body) {
  const int columns = (width + tile_side - 1) / tile_side, rows = (height + tile_side - 1) / tile_side;
  for (int turn = 0; turn < 4; ++turn) {
    const int across = (columns + 1 - turn % 2) / 2, down = (rows + 1 - turn / 2) / 2;
    parallel_for(static_cast<std::size_t>(across * down), threads, [&](std::size_t i, int) {
      const int x0 = (2 * (static_cast<int>(i) % across) + turn % 2) * tile_side,
                y0 = (2 * (static_cast<int>(i) / across) + turn / 2) * tile_side;
      body(x0, y0, std::min(x0 + tile_side, width), std::min(y0 + tile_side, height));
    });
  }
}

// `color` of one half, with weights from the other.
Filtered filter(const Inputs& inputs, const Colors& color, const Colors& guide, const Noise& noise,
                const Plane& total_variance, int threads) {
  const int width = inputs.width, height = inputs.height;
  Filtered out;
  WindowPlanes planes;
  for (std::size_t c = 0; c < 3; ++c) {
    out.color[c] = Plane(width, height);
    planes.guide[c] = &guide[c];
    planes.color[c] = &color[c];
    planes.sum[c] = &out.color[c];
  }
  out.weight = Plane(width, height);
  planes.weight = &out.weight;
  planes.variance = &noise.variance;
  planes.reliability = &noise.reliability;
  for (const Feature& feature : inputs.features) {
    planes.features.push_back(&feature.value);
    planes.feature_variances.push_back(&feature.variance);
  }
  const auto is_noisy = [&](int x, int y) {
    return *noise.variance.at(x, y) > negligible * *total_variance.at(x, y);
  };
  for_tiles(width, height, threads, [&](int x0, int y0, int x1, int y1) {
    for (int y = y0 + centre_distance / 2; y < y1; y += centre_distance)
      for (int x = x0 + centre_distance / 2; x < x1; x += centre_distance)
        if (is_noisy(x, y)) add_window(planes, x, y);
  });
  // Pixels that are like none of the centres, perhaps for what is beside them, are compared by themselves.
  for_tiles(width, height, threads, [&](int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        if (is_noisy(x, y) && *out.weight.at(x, y) < enough) add_window(planes, x, y);
  });
  for_rows(height, threads, [&](int y) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int x = 0; x < width; ++x) {
        const float weight = *out.weight.at(x, y);
        float& value = *out.color[c].at(x, y);
        value = (value + std::max(enough - weight, 0.0f) * *color[c].at(x, y)) / std::max(weight, enough);
      }
  });
  return out;
}

// Adds to `picture` what denoising changes of a layer.
void add_change(const Inputs& inputs, const Layer& layer, const Noise& noise, const Plane& total_variance,
                int threads, Colors& change) {
  const int width = inputs.width, height = inputs.height;
  const Filtered first = filter(inputs, layer.first, layer.second, noise, total_variance, threads),
                 second = filter(inputs, layer.second, layer.first, noise, total_variance, threads);
  // Squared errors of the filter's result and of the undenoised mean, in units of the noise around, and
  // these.
  Plane of_filter(width, height), of_noise(width, height), precision(width, height);
  for_rows(height, threads, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float filter_error = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const float a = *layer.first[c].at(x, y), b = *layer.second[c].at(x, y),
                    fa = *first.color[c].at(x, y), fb = *second.color[c].at(x, y);
        filter_error += 0.5f * (sqr(fa - b) + sqr(fb - a)) - 0.5f * sqr(a - b) - 0.25f * sqr(fa - fb);
      }
      // Where there is hardly any noise, a window's noise is the measure: no pixel speaks for all.
      const float variance = *noise.variance.at(x, y) + quiet * *noise.around.at(x, y),
                  scale = variance > 0 ? 1 / variance : 0;
      *of_filter.at(x, y) = filter_error * scale;
      *of_noise.at(x, y) = 0.5f * *noise.raw.at(x, y) * scale;
      *precision.at(x, y) = scale;
    }
  });
  of_filter = box_mean(of_filter, error_radius, threads);
  of_noise = box_mean(of_noise, error_radius, threads);
  precision = box_mean(precision, error_radius, threads);
  for_rows(height, threads, [&](int y) {
    for (int x = 0; x < width; ++x) {
      // A pixel that is noisier than those around it has more to win.
      const float own = std::max(*noise.raw.at(x, y), *noise.variance.at(x, y)) * *precision.at(x, y);
      const float filter_error = std::max(*of_filter.at(x, y), 0.0f),
                  noise_error = *of_noise.at(x, y) * std::max(own, 1.0f);
      if (!(noise_error > 0)) continue;
      const float share = noise_error / (noise_error + filter_error);
      for (std::size_t c = 0; c < 3; ++c)
        *change[c].at(x, y) += share * 0.5f *
                               (*first.color[c].at(x, y) + *second.color[c].at(x, y) -
                                (*layer.first[c].at(x, y) + *layer.second[c].at(x, y)));
    }
  });
}

}  // namespace

Result denoise(const image::Image& image, int threads) {
  InputsResult read = inputs_of(image, threads);
  if (!read.inputs) return {{}, read.error};
  const Inputs& inputs = *read.inputs;
  Colors change;
  for (Plane& plane : change) plane = Plane(inputs.width, inputs.height);
  std::vector<Noise> noises;
  Plane total_variance(inputs.width, inputs.height);
  for (const Layer& layer : inputs.layers) {
    noises.push_back(noise_of(layer, threads));
    add_variance(noises.back(), threads, total_variance);
  }
  for (std::size_t i = 0; i < inputs.layers.size(); ++i)
    add_change(inputs, inputs.layers[i], noises[i], total_variance, threads, change);
  const auto channels = *undenoised_channels(image);
  image::Image picture{image.width, image.height, {"R", "G", "B"}, {}, image.place};
  picture.pixels.resize(picture.index(0, image.height, 0));
  for_rows(image.height, threads, [&](int y) {
    for (int x = 0; x < image.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const float undenoised = image.at(x, y, channels[c]), value = undenoised + *change[c].at(x, y);
        picture.at(x, y, c) = std::isfinite(value) ? value : std::isfinite(undenoised) ? undenoised : 0.0f;
      }
  });
  return {std::move(picture), {}};
}

}  // namespace tyndall::denoise
