#include "optics/sky.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::optics {

namespace {

// Tables have at most so many columns.
constexpr int most_columns = 2048;

// u and v, both in [0, 1], of a direction in the sky's own space.
Pair<double> place_of(const Vec3d& sky) {
  return {0.5 + std::atan2(sky.x, -sky.z) / (2 * pi), 0.5 + std::asin(std::clamp(sky.y, -1.0, 1.0)) / pi};
}

// Bilinear; repeats across and ends at the poles.
float look_up(const Plane& plane, double u, double v) {
  const double x = u * plane.width - 0.5, y = v * plane.height - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto column = [&](double c) {
    const int i = static_cast<int>(c);
    return i < 0 ? i + plane.width : i >= plane.width ? i - plane.width : i;
  };
  const auto row = [&](double r) { return std::clamp(static_cast<int>(r), 0, plane.height - 1); };
  const auto along = [&](int r) {
    const float left = plane.at(column(x0), r), right = plane.at(column(x0 + 1), r);
    return left + (right - left) * static_cast<float>(x - x0);
  };
  const float below = along(row(y0)), above = along(row(y0 + 1));
  return below + (above - below) * static_cast<float>(y - y0);
}

// The sine of the latitude at the lower end of a row of texels.
double sine_at(int row, int height) { return std::sin(pi * (double(row) / height - 0.5)); }

Transform world_from_picture(const EnvironmentLight& light) {
  return light.world_from_sky * Transform::rotate({0, 1, 0}, light.rotation.radians);
}

// The inverse of a map that keeps lengths.
Vec3d turned_back(const Transform& t, const Vec3d& v) { return {dot(t.x, v), dot(t.y, v), dot(t.z, v)}; }

}  // namespace

Rgb sky_radiance(const EnvironmentLight& light, const Vec3d& direction) {
  const ColorPlanes& picture = light.radiance.picture;
  if (!picture[0]) return light.radiance.color;
  const Pair<double> place = place_of(turned_back(world_from_picture(light), direction));
  Rgb result;
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = light.radiance.color[c] * std::max(0.0f, look_up(*picture[c], place.x, place.y));
  return result;
}

Sky::Sky(const EnvironmentLight& light) : world_from_sky_(world_from_picture(light)) {
  const ColorPlanes& picture = light.radiance.picture;
  CHECK(picture[0] && picture[1] && picture[2]);
  width_ = picture[0]->width;
  height_ = picture[0]->height;
  block_ = (width_ + most_columns - 1) / most_columns;
  columns_ = (width_ + block_ - 1) / block_;
  rows_ = (height_ + block_ - 1) / block_;
  const auto texel = [&](int x, int y) {
    x = x < 0 ? width_ - 1 : x >= width_ ? 0 : x;
    y = std::clamp(y, 0, height_ - 1);
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
      sum += double{light.radiance.color[c]} * std::max(0.0f, picture[c]->at(x, y));
    return sum / 3;
  };
  // The mean of the bilinear function over a texel weighs it and its neighbours 6/8, 1/8 and 1/8 each way.
  const auto across = [&](int x, int y) {
    return 0.75 * texel(x, y) + 0.125 * (texel(x - 1, y) + texel(x + 1, y));
  };
  const auto mean = [&](int x, int y) {
    return 0.75 * across(x, y) + 0.125 * (across(x, y - 1) + across(x, y + 1));
  };
  sums_.assign(static_cast<std::size_t>(rows_) + 1, 0);
  sums_of_rows_.reserve(static_cast<std::size_t>(rows_) * (static_cast<std::size_t>(columns_) + 1));
  for (int row = 0; row < rows_; ++row) {
    double sum = 0;
    sums_of_rows_.push_back(0);
    for (int column = 0; column < columns_; ++column) {
      for (int y = row * block_; y < std::min((row + 1) * block_, height_); ++y)
        for (int x = column * block_; x < std::min((column + 1) * block_, width_); ++x)
          sum += mean(x, y) * 2 * pi / width_ * (sine_at(y + 1, height_) - sine_at(y, height_));
      sums_of_rows_.push_back(static_cast<float>(sum));
    }
    total_ += sums_of_rows_.back();
    sums_[static_cast<std::size_t>(row) + 1] = total_;
  }
}

double Sky::longitude(int column) const {
  return 2 * pi * (double(std::min(column * block_, width_)) / width_ - 0.5);
}
double Sky::sine_latitude(int row) const { return sine_at(std::min(row * block_, height_), height_); }
double Sky::cell_solid_angle(int column, int row) const {
  return (longitude(column + 1) - longitude(column)) * (sine_latitude(row + 1) - sine_latitude(row));
}
double Sky::cell_mass(int column, int row) const {
  const std::size_t i = static_cast<std::size_t>(row) * (static_cast<std::size_t>(columns_) + 1) +
                        static_cast<std::size_t>(column);
  return double{sums_of_rows_[i + 1]} - double{sums_of_rows_[i]};
}

Sky::Drawn Sky::sample(float u0, float u1) const {
  // The last place whose running sum is not above u times the whole: never an empty cell.
  const auto find = [](const auto* sums, int count, double target) {
    const auto* above =
        std::upper_bound(sums + 1, sums + count, target, [](double t, auto sum) { return t < double{sum}; });
    return static_cast<int>(above - sums) - 1;
  };
  const double along_rows = u1 * total_;
  const int row = find(sums_.data(), rows_, along_rows);
  const auto r = static_cast<std::size_t>(row);
  const double part_v = (along_rows - sums_[r]) / (sums_[r + 1] - sums_[r]);
  const float* sums = sums_of_rows_.data() + r * (static_cast<std::size_t>(columns_) + 1);
  const double along_row = u0 * double{sums[columns_]};
  const int column = find(sums, columns_, along_row);
  const double part_u = std::clamp(
      (along_row - double{sums[column]}) / (double{sums[column + 1]} - double{sums[column]}), 0.0, 1.0);
  const double phi = longitude(column) + part_u * (longitude(column + 1) - longitude(column));
  const double low = sine_latitude(row), high = sine_latitude(row + 1);
  const double y = low + std::clamp(part_v, 0.0, 1.0) * (high - low), r_xz = safe_sqrt(1 - y * y);
  const Vec3d sky{r_xz * std::sin(phi), y, -r_xz * std::cos(phi)};
  return {normalize(world_from_sky_.vector(sky)),
          cell_mass(column, row) / (total_ * cell_solid_angle(column, row))};
}

double Sky::pdf(const Vec3d& direction) const {
  if (!(total_ > 0)) return 0;
  const Pair<double> place = place_of(turned_back(world_from_sky_, direction));
  const int column = std::clamp(static_cast<int>(place.x * width_) / block_, 0, columns_ - 1),
            row = std::clamp(static_cast<int>(place.y * height_) / block_, 0, rows_ - 1);
  return cell_mass(column, row) / (total_ * cell_solid_angle(column, row));
}

}  // namespace tyndall::optics
