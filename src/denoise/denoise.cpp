#include "denoise/denoise.h"

#include <cmath>

#include "base/numerics.h"
#include "base/parallel.h"
#include "denoise/window.h"

namespace tyndall::denoise {

namespace {

constexpr int centre_distance = 4;  // of windows, each way
constexpr int error_radius = 5;     // of the square that errors are averaged over
constexpr int close_radius = 2;     // and of the one in which a greater error counts, too
constexpr float margin = 1;         // by which it must be greater, in units of the noise
constexpr float outlying = 16;      // times the noise around: what a pixel is then trusted for half in a fit
constexpr float quiet = 0.5f;       // of the noise around
constexpr float enough = 0.3f;      // weight; what is missing of it is the pixel's own
constexpr float negligible = 0.001f;  // part of the picture's noise below which a layer's is left alone
constexpr float noise_left = 0.25f;   // of a variance: at least so much is taken to be left by a first filter
constexpr int tile_side = 64;         // a multiple of it, above 2 window_radius

// Planes of a layer that both of its halves share.
struct Noise {
  Plane raw;       // (first - second)²/2, the sum over the channels: of the variance of a half, one sample
  Plane variance;  // of a half: its mean around a pixel
  Plane of_light;  // of a half: by a pixel's own light and the noise around
  Plane around;    // mean of raw over a window
  Plane reliability;  // of a pixel in a regression
};

// The variance of a half. Noise is about in proportion to a power of the light between that of counted
// photons and that of a factor: pixels around tell the factor, and a dark pixel beside bright ones has its
// own light's.
Plane variance_by_light(const Layer& layer, const Plane& raw, int threads) {
  constexpr float power = 1.5f, dark = 0.1f;  // of the light around: darker pixels are taken for as bright
  const int width = raw.width(), height = raw.height();
  Plane light(width, height), relative(width, height);
  for_rows(height, threads, [&](int y) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int x = 0; x < width; ++x)
        *light.at(x, y) += 0.5f * std::abs(*layer.first[c].at(x, y) + *layer.second[c].at(x, y));
  });
  const Plane around = box_mean(light, window_radius, threads);
  for_rows(height, threads, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float& scale = *light.at(x, y);
      scale = std::pow(scale + dark * *around.at(x, y), power);
      *relative.at(x, y) = scale > 0 ? *raw.at(x, y) / scale : 0.0f;
    }
  });
  Plane variance = box_mean(relative, 2, threads);
  for_rows(height, threads, [&](int y) {
    for (int x = 0; x < width; ++x) *variance.at(x, y) *= *light.at(x, y);
  });
  return variance;
}

Noise noise_of(const Layer& layer, int threads) {
  const int width = layer.first[0].width(), height = layer.first[0].height();
  Noise noise{Plane(width, height), {}, {}, {}, Plane(width, height)};
  for_rows(height, threads, [&](int y) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int x = 0; x < width; ++x)
        *noise.raw.at(x, y) += 0.5f * sqr(*layer.first[c].at(x, y) - *layer.second[c].at(x, y));
  });
  noise.variance = box_mean(noise.raw, 2, threads);
  noise.of_light = variance_by_light(layer, noise.raw, threads);
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

// The variance of what a filter has left of a layer: of its halves, which is not all.
Plane variance_left(const Layer& filtered, const Noise& noise, int threads) {
  Plane variance = noise_of(filtered, threads).variance;
  for_rows(variance.height(), threads, [&](int y) {
    for (int x = 0; x < variance.width(); ++x) *variance.at(x, y) += noise_left * *noise.variance.at(x, y);
  });
  variance.extend();
  return variance;
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

// What a filter reads: a layer, what patches are compared in and the variance of that, and which pixels a
// regression trusts.
struct Job {
  const Inputs& inputs;
  const Layer &layer, &guide;
  const Plane &guide_variance, &reliability, &total_variance;
  int threads = 0;
};

// One half of the layer, with weights from the other half of the guide.
Filtered filter(const Job& job, Colors Layer::*half, Colors Layer::*other) {
  const Inputs& inputs = job.inputs;
  const Colors &color = job.layer.*half, &guide = job.guide.*other;
  const int threads = job.threads;
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
  planes.variance = &job.guide_variance;
  planes.reliability = &job.reliability;
  for (const Feature& feature : inputs.features) {
    planes.features.push_back(&feature.value);
    planes.feature_variances.push_back(&feature.variance);
  }
  const auto is_noisy = [&](int x, int y) {
    return *job.guide_variance.at(x, y) > negligible * *job.total_variance.at(x, y);
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

// Squared errors of a filter's result and of the undenoised mean, in units of the noise around, and these.
struct Errors {
  Plane of_filter, of_noise, precision;
};

Errors errors_of(const Layer& layer, const Noise& noise, const Colors& first, const Colors& second,
                 int threads) {
  const int width = noise.raw.width(), height = noise.raw.height();
  Errors errors{Plane(width, height), Plane(width, height), Plane(width, height)};
  for_rows(height, threads, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float filter_error = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const float a = *layer.first[c].at(x, y), b = *layer.second[c].at(x, y), fa = *first[c].at(x, y),
                    fb = *second[c].at(x, y);
        filter_error += 0.5f * (sqr(fa - b) + sqr(fb - a)) - 0.5f * sqr(a - b) - 0.25f * sqr(fa - fb);
      }
      // Where there is hardly any noise, a window's noise is the measure: no pixel speaks for all.
      const float variance = *noise.of_light.at(x, y) + quiet * *noise.around.at(x, y),
                  scale = variance > 0 ? 1 / variance : 0;
      *errors.of_filter.at(x, y) = filter_error * scale;
      *errors.of_noise.at(x, y) = 0.5f * *noise.raw.at(x, y) * scale;
      *errors.precision.at(x, y) = scale;
    }
  });
  const Plane close = box_mean(errors.of_filter, close_radius, threads);
  for (Plane* plane : {&errors.of_filter, &errors.of_noise, &errors.precision})
    *plane = box_mean(*plane, error_radius, threads);
  for_rows(height, threads, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float& error = *errors.of_filter.at(x, y);
      error = std::max({error, *close.at(x, y) - margin * *errors.of_noise.at(x, y), 0.0f});
    }
  });
  return errors;
}

// The layer's halves, each mixed with what the filter makes of it so that the error is least.
Layer filtered(const Job& job, const Noise& noise) {
  const Filtered first = filter(job, &Layer::first, &Layer::second),
                 second = filter(job, &Layer::second, &Layer::first);
  const Errors errors = errors_of(job.layer, noise, first.color, second.color, job.threads);
  Layer mixed = job.layer;
  for_rows(noise.raw.height(), job.threads, [&](int y) {
    for (int x = 0; x < noise.raw.width(); ++x) {
      // A pixel that is noisier than those around it has more to win.
      const float own = std::max(*noise.raw.at(x, y), *noise.of_light.at(x, y)) * *errors.precision.at(x, y);
      const float noise_error = *errors.of_noise.at(x, y) * std::max(own, 1.0f);
      if (!(noise_error > 0)) continue;
      const float share = noise_error / (noise_error + *errors.of_filter.at(x, y));
      for (std::size_t c = 0; c < 3; ++c) {
        float &a = *mixed.first[c].at(x, y), &b = *mixed.second[c].at(x, y);
        a += share * (*first.color[c].at(x, y) - a);
        b += share * (*second.color[c].at(x, y) - b);
      }
    }
  });
  for (Colors* half : {&mixed.first, &mixed.second})
    for (Plane& plane : *half) plane.extend();
  return mixed;
}

// Adds to `change` what denoising changes of a layer. It is filtered twice: the second time, patches are
// compared in what the first filter has made of the halves, in which edges stand out that noise hid.
void add_change(const Inputs& inputs, const Layer& layer, const Noise& noise, const Plane& total_variance,
                int threads, Colors& change) {
  const Layer guide =
      filtered({inputs, layer, layer, noise.variance, noise.reliability, total_variance, threads}, noise);
  const Plane left = variance_left(guide, noise, threads);
  const Layer result =
      filtered({inputs, layer, guide, left, noise.reliability, total_variance, threads}, noise);
  for_rows(inputs.height, threads, [&](int y) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int x = 0; x < inputs.width; ++x)
        *change[c].at(x, y) += 0.5f * (*result.first[c].at(x, y) + *result.second[c].at(x, y) -
                                       (*layer.first[c].at(x, y) + *layer.second[c].at(x, y)));
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
