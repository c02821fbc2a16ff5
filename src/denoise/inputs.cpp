#include "denoise/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string_view>

#include "base/numerics.h"

namespace tyndall::denoise {

namespace {

using Channels = std::array<std::size_t, 3>;

std::optional<std::size_t> channel(const image::Image& image, const std::string& name) {
  const auto found = std::find(image.channels.begin(), image.channels.end(), name);
  if (found == image.channels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - image.channels.begin());
}

std::optional<Channels> three_channels(const image::Image& image, const std::string& prefix,
                                       std::string_view suffixes = "RGB") {
  Channels found{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto one = channel(image, prefix + suffixes[c]);
    if (!one) return std::nullopt;
    found[c] = *one;
  }
  return found;
}

float finite_or_zero(float value) { return std::isfinite(value) ? value : 0.0f; }

// Where the planes are of a mean over all samples, and of that over one half of them.
struct Both {
  std::size_t mean = 0, first = 0;
};

// All channels that are read of an image, each in a plane of its own: one way through interleaved pixels.
class Planes {
 public:
  // Where a channel's plane will be.
  std::size_t add(std::size_t channel) {
    channels_.push_back(channel);
    return channels_.size() - 1;
  }
  void read(const image::Image& image, int threads) {
    for (std::size_t i = 0; i < channels_.size(); ++i) planes_.emplace_back(image.width, image.height);
    // A few pixels at a time, all of whose channels the cache holds.
    constexpr int block = 32;
    for_rows(image.height, threads, [&](int y) {
      for (int x0 = 0; x0 < image.width; x0 += block) {
        const int x1 = std::min(x0 + block, image.width);
        for (std::size_t i = 0; i < channels_.size(); ++i) {
          const float* from = image.pixels.data() + image.index(x0, y, channels_[i]);
          float* to = planes_[i].at(0, y);
          for (int x = x0; x < x1; ++x, from += image.channels.size()) to[x] = *from;
        }
      }
    });
  }
  Plane& operator[](std::size_t i) { return planes_[i]; }

 private:
  std::vector<std::size_t> channels_;
  std::vector<Plane> planes_;
};

// What is read of an image, by where its planes are.
struct Found {
  std::array<Both, 3> picture{};
  std::vector<std::array<Both, 3>> lights;
  std::vector<Both> features;  // without noise where both are one
  std::optional<Both> depth;
};

std::array<Both, 3> add(Planes& planes, const Channels& mean, const Channels& first) {
  std::array<Both, 3> added{};
  for (std::size_t c = 0; c < 3; ++c) added[c] = {planes.add(mean[c]), planes.add(first[c])};
  return added;
}

Found find(const image::Image& image, Planes& planes, const Channels& picture, const Channels& first) {
  Found found;
  found.picture = add(planes, picture, first);
  for (const std::string name : {"volume_direct", "volume_indirect", "volume_emission"}) {
    const auto mean = three_channels(image, name + '.'), half = three_channels(image, "half." + name + '.');
    if (mean && half) found.lights.push_back(add(planes, *mean, *half));
  }
  const auto add_one = [&](const std::string& name) -> std::optional<Both> {
    const auto mean = channel(image, name), half = channel(image, "half." + name);
    if (!mean) return std::nullopt;
    return Both{planes.add(*mean), planes.add(half.value_or(*mean))};
  };
  for (const char* name :
       {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "transmittance.G"})
    if (const auto both = add_one(name)) found.features.push_back(*both);
  found.depth = add_one("depth");
  return found;
}

// What is left is 0 where it is the rounding of numbers that are alike.
float left_of(float whole, float taken) {
  constexpr float rounding = 1e-6f;
  const float left = whole - taken;
  return std::abs(left) > rounding * std::abs(taken) ? left : 0.0f;
}

// Makes finite the light of a layer, and takes it out of the rest of the picture, if there is one.
void take_light(Planes& planes, const Both& light, const Both* rest, int threads) {
  for (const auto member : {&Both::mean, &Both::first}) {
    Plane& plane = planes[light.*member];
    Plane* of_rest = rest ? &planes[rest->*member] : nullptr;
    for_rows(plane.height(), threads, [&](int y) {
      for (int x = 0; x < plane.width(); ++x) {
        float& value = *plane.at(x, y);
        value = finite_or_zero(value);
        if (of_rest) *of_rest->at(x, y) = left_of(*of_rest->at(x, y), value);
      }
    });
  }
}

// Adds the two halves of a layer, unless they are the same.
void add_layer(Inputs& to, Planes& planes, const std::array<Both, 3>& light, int threads) {
  Layer layer;
  std::atomic<bool> differ{false};
  for (std::size_t c = 0; c < 3; ++c) {
    Plane &first = planes[light[c].first], &second = planes[light[c].mean];
    for_rows(to.height, threads, [&](int y) {
      bool here = false;
      for (int x = 0; x < to.width; ++x) {
        float& of_both = *second.at(x, y);
        of_both = finite_or_zero(2 * of_both - *first.at(x, y));
        here |= of_both != *first.at(x, y);
      }
      if (here) differ = true;
    });
    first.extend();
    second.extend();
    layer.first[c] = std::move(first);
    layer.second[c] = std::move(second);
  }
  if (differ) to.layers.push_back(std::move(layer));
}

// A feature mapped to about [0, 1], unless it is the same everywhere.
template <class Map>
void add_feature(Inputs& to, Planes& planes, const Both& both, int threads, Map&& map) {
  Feature feature{std::move(planes[both.mean]), {}};
  const bool is_noisy = both.first != both.mean;
  feature.variance = is_noisy ? std::move(planes[both.first]) : Plane(to.width, to.height);
  const float some = finite_or_zero(map(*feature.value.at(0, 0)));
  std::atomic<bool> varies{false};
  for_rows(to.height, threads, [&](int y) {
    bool here = false;
    for (int x = 0; x < to.width; ++x) {
      float &value = *feature.value.at(x, y), &first = *feature.variance.at(x, y);
      value = finite_or_zero(map(value));
      here |= value != some;
      if (is_noisy) first = sqr(finite_or_zero(map(first)) - value);
    }
    if (here) varies = true;
  });
  if (!varies) return;
  feature.value.extend();
  feature.variance.extend();
  to.features.push_back(std::move(feature));
}

// Depths are seen in proportion to their (harmonic) mean, from 1 at the camera to 0 far away.
float usual_depth(const Plane& depth) {
  double sum = 0, count = 0;
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x)
      if (const float value = *depth.at(x, y); std::isfinite(value) && value > 0) {
        sum += 1.0 / double(value);
        ++count;
      }
  return sum > 0 ? static_cast<float>(count / sum) : 1.0f;
}

}  // namespace

std::optional<Channels> undenoised_channels(const image::Image& image) {
  const auto kept = three_channels(image, "noisy.");
  return kept ? kept : three_channels(image, "");
}

InputsResult inputs_of(const image::Image& image, int threads) {
  const auto picture = undenoised_channels(image), first = three_channels(image, "half.");
  if (!picture) return {.error = "it has no channels R, G and B"};
  if (!first)
    return {
        .error =
            "it has no channels half.R, half.G and half.B, which `render --denoise` or `--aov half` write"};
  Inputs inputs{image.width, image.height, {}, {}};
  Planes planes;
  const Found found = find(image, planes, *picture, *first);
  planes.read(image, threads);
  for (std::size_t c = 0; c < 3; ++c) {
    take_light(planes, found.picture[c], nullptr, threads);
    for (const std::array<Both, 3>& light : found.lights)
      take_light(planes, light[c], &found.picture[c], threads);
  }
  for (const std::array<Both, 3>& light : found.lights) add_layer(inputs, planes, light, threads);
  add_layer(inputs, planes, found.picture, threads);
  for (const Both& feature : found.features)
    add_feature(inputs, planes, feature, threads, [](float value) { return value; });
  if (found.depth) {
    const float scale = usual_depth(planes[found.depth->mean]);
    add_feature(inputs, planes, *found.depth, threads,
                [scale](float value) { return scale / (scale + value); });
  }
  return {std::move(inputs), {}};
}

}  // namespace tyndall::denoise
