#include "render/film/film.h"

#include <string>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::render {

namespace {

bool is_recorded(Aov aov) { return aov != Aov::samples && aov != Aov::variance && aov != Aov::halves; }

std::size_t recorded_channels(const AovSet& aovs) {
  std::size_t channels = aovs.has(Aov::depth);  // its count
  for (const AovInfo& info : aov_infos())
    if (aovs.has(info.aov) && is_recorded(info.aov)) channels += static_cast<std::size_t>(info.channels);
  return channels * (aovs.has(Aov::halves) ? 2 : 1);
}

Vec3d mean_of(const Vec3d& sum, std::uint32_t samples) {
  return samples > 0 ? sum * (1.0 / samples) : Vec3d{};
}

}  // namespace

bool Film::can_be(int width, int height, int groups, const AovSet& aovs, const PixelWindow& window) {
  const auto [x0, y0, x1, y1] = window;
  return 0 <= x0 && x0 < x1 && x1 <= width && 0 <= y0 && y0 < y1 && y1 <= height &&
         (groups == error_groups || (groups == 1 && !aovs.has(Aov::halves)));
}

Film::Film(int width, int height, int groups, AovSet aovs, std::optional<PixelWindow> window)
    : width_(width),
      height_(height),
      groups_(groups),
      aovs_(aovs),
      window_(window.value_or(PixelWindow{0, 0, width, height})) {
  CHECK(can_be(width, height, groups, aovs, window_));
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

void Film::add(int x, int y, const AovSample& sample, int group) {
  const std::size_t pixels = pixel_count();
  FixedSum* to = planes_.data() + index(x, y);
  if (plane_sets() == 2 && group >= 2) to += set_size();
  for (const AovInfo& info : aov_infos()) {
    if (!aovs_.has(info.aov) || !is_recorded(info.aov)) continue;
    const Vec3d value = sample.value(info.aov);
    for (int c = 0; c < info.channels; ++c, to += pixels) to->add(std::isfinite(value[c]) ? value[c] : 0.0);
  }
  if (aovs_.has(Aov::depth)) to->add(sample.hit_surface ? 1 : 0);
}

bool Film::takes(const Film& part) const {
  const PixelWindow &w = window_, &p = part.window_;
  return part.width_ == width_ && part.height_ == height_ && part.groups_ == groups_ &&
         part.aovs_.bits() == aovs_.bits() && p.x0 >= w.x0 && p.y0 >= w.y0 && p.x1 <= w.x1 && p.y1 <= w.y1;
}

void Film::add(const Film& part) {
  CHECK(takes(part));
  const std::size_t planes = planes_.size() / pixel_count();
  for (int y = part.window_.y0; y < part.window_.y1; ++y)
    for (int x = part.window_.x0; x < part.window_.x1; ++x) {
      for (int g = 0; g < groups_; ++g) {
        Sums& to = sums_[index(x, y) * groups_ + g];
        const Sums& from = part.sums(x, y, g);
        to.r.add(from.r);
        to.g.add(from.g);
        to.b.add(from.b);
        to.samples += from.samples;
      }
      for (std::size_t plane = 0; plane < planes; ++plane)
        planes_[plane * pixel_count() + index(x, y)].add(
            part.planes_[plane * part.pixel_count() + part.index(x, y)]);
    }
}

std::uint64_t Film::bytes_of(const PixelWindow& window, int groups, const AovSet& aovs) {
  return window.pixels() *
         (static_cast<std::uint64_t>(groups) * sizeof(Sums) + recorded_channels(aovs) * sizeof(FixedSum));
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

Vec3d Film::half_sum_mean(int x, int y, int half) const {
  const Sums &a = sums(x, y, 2 * half), &b = sums(x, y, 2 * half + 1);
  FixedSum r = a.r, g = a.g, blue = a.b;
  r.add(b.r);
  g.add(b.g);
  blue.add(b.b);
  return mean_of({r.value(), g.value(), blue.value()}, a.samples + b.samples);
}

Rgb Film::mean(int x, int y) const {
  if (groups_ == 1) return Rgb(group_mean(x, y, 0));
  Vec3d sum;
  int halves = 0;
  for (int half = 0; half < 2; ++half) {
    if (half_samples(x, y, half) == 0) continue;
    sum += half_sum_mean(x, y, half);
    ++halves;
  }
  return halves > 0 ? Rgb(sum * (1.0 / halves)) : Rgb{};
}

Rgb Film::half_mean(int x, int y, int half) const {
  return Rgb(half_sum_mean(x, y, half_samples(x, y, half) > 0 ? half : 1 - half));
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

// The mean over the samples of one half of the channels that begin at `plane`; of the other half where it has
// none.
Vec3d Film::half_value(const AovInfo& info, std::size_t plane, int x, int y, int half) const {
  if (half_samples(x, y, half) == 0) half = 1 - half;
  const std::size_t pixels = pixel_count(), begin = static_cast<std::size_t>(half) * set_size();
  const FixedSum* of_pixel = planes_.data() + begin + index(x, y);
  if (info.aov == Aov::depth) {
    const double hits = of_pixel[set_size() - pixels].value();
    return {hits > 0 ? of_pixel[plane * pixels].value() / hits : infinity, 0, 0};
  }
  Vec3d sum;
  for (int c = 0; c < info.channels; ++c)
    sum[c] = of_pixel[(plane + static_cast<std::size_t>(c)) * pixels].value();
  return mean_of(sum, half_samples(x, y, half));
}

// The mean over the pixel's samples of the channels that begin at `plane`; with halves that of their means,
// as the picture's.
Vec3d Film::recorded_value(const AovInfo& info, std::size_t plane, int x, int y) const {
  const std::size_t pixels = pixel_count(), set = set_size();
  const FixedSum* of_pixel = planes_.data() + index(x, y);
  const auto sum = [&](std::size_t of_plane) {
    double value = 0;
    for (int k = 0; k < plane_sets(); ++k)
      value += of_pixel[static_cast<std::size_t>(k) * set + of_plane * pixels].value();
    return value;
  };
  if (info.aov == Aov::depth) {
    const double hits = sum(set / pixels - 1);
    return {hits > 0 ? sum(plane) / hits : infinity, 0, 0};
  }
  if (plane_sets() == 2) return (half_value(info, plane, x, y, 0) + half_value(info, plane, x, y, 1)) * 0.5;
  Vec3d sums;
  for (int c = 0; c < info.channels; ++c) sums[c] = sum(plane + static_cast<std::size_t>(c));
  return mean_of(sums, samples(x, y));
}

Vec3d Film::aov_value(const AovInfo& info, std::size_t plane, int x, int y) const {
  if (info.aov == Aov::samples) return Vec3d{static_cast<double>(samples(x, y)), 0, 0};
  if (info.aov == Aov::variance) return variance(x, y);
  return recorded_value(info, plane, x, y);
}

std::uint64_t Film::pixels_without_samples() const {
  std::uint64_t count = 0;
  for (int y = window_.y0; y < window_.y1; ++y)
    for (int x = window_.x0; x < window_.x1; ++x) count += samples(x, y) == 0;
  return count;
}

void Film::put_pixel(int x, int y, std::vector<float>& to) const {
  const auto put = [&](const Vec3d& value, int channels) {
    for (int k = 0; k < channels; ++k) to.push_back(static_cast<float>(value[k]));
  };
  const Rgb c = mean(x, y);
  to.insert(to.end(), {c.x, c.y, c.z});
  const auto put_outputs = [&](auto&& value_of) {
    std::size_t plane = 0;
    for (const AovInfo& info : aov_infos()) {
      if (!aovs_.has(info.aov)) continue;
      value_of(info, plane);
      if (is_recorded(info.aov)) plane += static_cast<std::size_t>(info.channels);
    }
  };
  put_outputs([&](const AovInfo& info, std::size_t plane) {
    if (info.aov != Aov::halves) put(aov_value(info, plane, x, y), info.channels);
  });
  if (!aovs_.has(Aov::halves)) return;
  put(Vec3d(half_mean(x, y, 0)), 3);
  put_outputs([&](const AovInfo& info, std::size_t plane) {
    if (is_recorded(info.aov)) put(half_value(info, plane, x, y, 0), info.channels);
  });
}

image::Image Film::image() const {
  const auto [x0, y0, x1, y1] = window_;
  image::Image out{x1 - x0, y1 - y0, {"R", "G", "B"}, {}, {x0, y0, width_, height_}};
  const auto name_channels = [&](const std::string& name, const AovInfo& info) {
    const std::string_view suffixes = info.aov == Aov::normal ? "XYZ" : "RGB";
    for (int c = 0; c < info.channels; ++c)
      out.channels.push_back(info.channels == 1 ? name : name + '.' + suffixes[c]);
  };
  for (const AovInfo& info : aov_infos())
    if (aovs_.has(info.aov) && info.aov != Aov::halves) name_channels(std::string(info.name), info);
  if (aovs_.has(Aov::halves)) {
    out.channels.insert(out.channels.end(), {"half.R", "half.G", "half.B"});
    for (const AovInfo& info : aov_infos())
      if (aovs_.has(info.aov) && is_recorded(info.aov)) name_channels("half." + std::string(info.name), info);
  }
  out.pixels.reserve(pixel_count() * out.channels.size());
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) put_pixel(x, y, out.pixels);
  return out;
}

}  // namespace tyndall::render
