#include "render/film.h"

#include <string>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::render {

namespace {

bool is_recorded(Aov aov) { return aov != Aov::samples && aov != Aov::variance; }

std::size_t recorded_channels(const AovSet& aovs) {
  std::size_t channels = aovs.has(Aov::depth);  // its count
  for (const AovInfo& info : aov_infos())
    if (aovs.has(info.aov) && is_recorded(info.aov)) channels += static_cast<std::size_t>(info.channels);
  return channels;
}

Vec3d mean_of(const Vec3d& sum, std::uint32_t samples) {
  return samples > 0 ? sum * (1.0 / samples) : Vec3d{};
}

}  // namespace

Film::Film(int width, int height, int groups, AovSet aovs, std::optional<PixelWindow> window)
    : width_(width),
      height_(height),
      groups_(groups),
      aovs_(aovs),
      window_(window.value_or(PixelWindow{0, 0, width, height})) {
  CHECK_LE(0, window_.x0);
  CHECK_LE(0, window_.y0);
  CHECK_LT(window_.x0, window_.x1);
  CHECK_LT(window_.y0, window_.y1);
  CHECK_LE(window_.x1, width);
  CHECK_LE(window_.y1, height);
  CHECK(groups == 1 || groups == error_groups);
  sums_.resize(pixel_count() * static_cast<std::size_t>(groups));
  planes_.resize(pixel_count() * recorded_channels(aovs));
}

void Film::add(int x, int y, const Rgb& radiance, int group) {
  Sums& sums = sums_[index(x, y) * groups_ + group];
  sums.r.add(radiance.x);
  sums.g.add(radiance.y);
  sums.b.add(radiance.z);
  ++sums.samples;
}

void Film::add(int x, int y, const AovSample& sample) {
  const std::size_t pixels = pixel_count();
  FixedSum* to = planes_.data() + index(x, y);
  for (const AovInfo& info : aov_infos()) {
    if (!aovs_.has(info.aov) || !is_recorded(info.aov)) continue;
    const Vec3d value = sample.value(info.aov);
    for (int c = 0; c < info.channels; ++c, to += pixels) to->add(std::isfinite(value[c]) ? value[c] : 0.0);
  }
  if (aovs_.has(Aov::depth)) to->add(sample.met_surface ? 1 : 0);
}

std::uint32_t Film::samples(int x, int y) const {
  std::uint32_t count = 0;
  for (int g = 0; g < groups_; ++g) count += sums(x, y, g).samples;
  return count;
}

Vec3d Film::group_mean(int x, int y, int group) const {
  const Sums& s = sums(x, y, group);
  return mean_of({s.r.value(), s.g.value(), s.b.value()}, s.samples);
}

Rgb Film::mean(int x, int y) const {
  if (groups_ == 1) return Rgb(group_mean(x, y, 0));
  Vec3d sum;
  int halves = 0;
  for (int half = 0; half < 2; ++half) {
    const Sums &a = sums(x, y, 2 * half), &b = sums(x, y, 2 * half + 1);
    if (a.samples + b.samples == 0) continue;
    FixedSum r = a.r, g = a.g, blue = a.b;
    r.add(b.r);
    g.add(b.g);
    blue.add(b.b);
    sum += mean_of({r.value(), g.value(), blue.value()}, a.samples + b.samples);
    ++halves;
  }
  return halves > 0 ? Rgb(sum * (1.0 / halves)) : Rgb{};
}

// Var(a half's mean) is estimated by ((A - B) / 2)² of its two groups, and that of the mean of both halves
// is a quarter of their sum.
Vec3d Film::variance(int x, int y) const {
  Vec3d sum;
  if (groups_ == 1) return sum;
  for (int half = 0; half < 2; ++half) {
    const Vec3d d = (group_mean(x, y, 2 * half) - group_mean(x, y, 2 * half + 1)) * 0.5;
    sum += d * d;
  }
  return sum * 0.25;
}

// The mean over the pixel's samples of the channels that begin at `plane`.
Vec3d Film::aov_value(const AovInfo& info, std::size_t plane, int x, int y) const {
  const std::size_t pixels = pixel_count();
  const std::uint32_t count = samples(x, y);
  switch (info.aov) {
    case Aov::samples:
      return Vec3d{static_cast<double>(count), 0, 0};
    case Aov::variance:
      return variance(x, y);
    case Aov::depth: {
      const double met = planes_[planes_.size() - pixels + index(x, y)].value();
      return {met > 0 ? planes_[plane * pixels + index(x, y)].value() / met : infinity, 0, 0};
    }
    case Aov::normal:
    case Aov::albedo:
    case Aov::volume_direct:
    case Aov::volume_indirect:
    case Aov::volume_emission:
    case Aov::transmittance:
    case Aov::optical_depth:
    case Aov::cost:
      break;
  }
  Vec3d sum;
  for (int c = 0; c < info.channels; ++c)
    sum[c] = planes_[(plane + static_cast<std::size_t>(c)) * pixels + index(x, y)].value();
  return mean_of(sum, count);
}

std::uint64_t Film::pixels_without_samples() const {
  std::uint64_t count = 0;
  for (int y = window_.y0; y < window_.y1; ++y)
    for (int x = window_.x0; x < window_.x1; ++x) count += samples(x, y) == 0;
  return count;
}

image::Image Film::image() const {
  const auto [x0, y0, x1, y1] = window_;
  image::Image out{x1 - x0, y1 - y0, {"R", "G", "B"}, {}, {x0, y0, width_, height_}};
  for (const AovInfo& info : aov_infos()) {
    if (!aovs_.has(info.aov)) continue;
    const std::string name(info.name);
    const std::string_view suffixes = info.aov == Aov::normal ? "XYZ" : "RGB";
    for (int c = 0; c < info.channels; ++c)
      out.channels.push_back(info.channels == 1 ? name : name + '.' + suffixes[c]);
  }
  out.pixels.reserve(pixel_count() * out.channels.size());
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const Rgb c = mean(x, y);
      out.pixels.insert(out.pixels.end(), {c.x, c.y, c.z});
      std::size_t plane = 0;
      for (const AovInfo& info : aov_infos()) {
        if (!aovs_.has(info.aov)) continue;
        const Vec3d value = aov_value(info, plane, x, y);
        for (int k = 0; k < info.channels; ++k) out.pixels.push_back(static_cast<float>(value[k]));
        if (is_recorded(info.aov)) plane += static_cast<std::size_t>(info.channels);
      }
    }
  return out;
}

}  // namespace tyndall::render
