#include "optics/sky.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::optics {

namespace {

// Tables have at most so many columns and rows.
constexpr int most_cells = 2048;

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

// The inverse of a map that keeps lengths.
Vec3d turned_back(const Transform& t, const Vec3d& v) { return {dot(t.x, v), dot(t.y, v), dot(t.z, v)}; }

// The mean radiance of the picture over its texels: that of the bilinear function, which weighs a texel and
// its neighbours 6/8, 1/8 and 1/8 each way. Kept for a few rows at a time.
class RowMeans {
 public:
  RowMeans(const SkyRadiance& radiance, int rows)
      : radiance_(radiance), width_(radiance_.picture[0]->width), rows_(rows) {
    sums_.resize(static_cast<std::size_t>(width_));
    across_.resize(static_cast<std::size_t>(rows_ + 2) * static_cast<std::size_t>(width_));
  }

  // Goes to the rows from `first` on.
  void go_to(int first) {
    first_ = first;
    const int last = radiance_.picture[0]->height - 1;
    for (int i = 0; i < rows_ + 2; ++i) read_row(std::clamp(first - 1 + i, 0, last), i);
  }

  // Of one of them.
  double at(int x, int y) const {
    const int i = y - first_ + 1;
    return 0.75 * across(x, i) + 0.125 * (across(x, i - 1) + across(x, i + 1));
  }

 private:
  double across(int x, int i) const { return across_[index(x, i)]; }
  std::size_t index(int x, int i) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  void read_row(int y, int i) {
    for (int x = 0; x < width_; ++x) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c)
        sum += double{radiance_.color[c]} * std::max(0.0f, radiance_.picture[c]->at(x, y));
      sums_[static_cast<std::size_t>(x)] = sum / 3;
    }
    for (int x = 0; x < width_; ++x) {
      const double left = sums_[static_cast<std::size_t>(x > 0 ? x - 1 : width_ - 1)],
                   right = sums_[static_cast<std::size_t>(x + 1 < width_ ? x + 1 : 0)];
      across_[index(x, i)] = 0.75 * sums_[static_cast<std::size_t>(x)] + 0.125 * (left + right);
    }
  }

  const SkyRadiance& radiance_;
  int width_, rows_, first_ = 0;
  std::vector<double> sums_, across_;
};

}  // namespace

Rgb sky_radiance(const SkyRadiance& radiance, const Transform& world_from_picture, const Vec3d& direction) {
  const ColorPlanes& picture = radiance.picture;
  if (!picture[0]) return radiance.color;
  const Pair<double> place = place_of(turned_back(world_from_picture, direction));
  Rgb result;
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = radiance.color[c] * std::max(0.0f, look_up(*picture[c], place.x, place.y));
  return result;
}

Sky::Sky(const SkyRadiance& radiance, const Transform& world_from_picture)
    : radiance_(radiance), world_from_picture_(world_from_picture) {
  const ColorPlanes& picture = radiance.picture;
  CHECK(picture[0] && picture[1] && picture[2]);
  width_ = picture[0]->width;
  height_ = picture[0]->height;
  block_ = (std::max(width_, height_) + most_cells - 1) / most_cells;
  columns_ = (width_ + block_ - 1) / block_;
  rows_ = (height_ + block_ - 1) / block_;
  sums_.assign(static_cast<std::size_t>(rows_) + 1, 0);
  sums_of_rows_.reserve(static_cast<std::size_t>(rows_) * (static_cast<std::size_t>(columns_) + 1));
  RowMeans means(radiance, block_);
  std::vector<double> heights(static_cast<std::size_t>(block_));  // of rows of texels, in sines of latitude
  for (int row = 0; row < rows_; ++row) {
    double sum = 0;
    sums_of_rows_.push_back(0);
    const int first = row * block_, end = std::min(first + block_, height_);
    means.go_to(first);
    for (int y = first; y < end; ++y)
      heights[static_cast<std::size_t>(y - first)] = sine_at(y + 1, height_) - sine_at(y, height_);
    for (int column = 0; column < columns_; ++column) {
      for (int y = first; y < end; ++y)
        for (int x = column * block_; x < std::min((column + 1) * block_, width_); ++x)
          sum += means.at(x, y) * 2 * pi / width_ * heights[static_cast<std::size_t>(y - first)];
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
  return {normalize(world_from_picture_.vector(sky)),
          cell_mass(column, row) / (total_ * cell_solid_angle(column, row))};
}

double Sky::pdf(const Vec3d& direction) const {
  if (!(total_ > 0)) return 0;
  const Pair<double> place = place_of(turned_back(world_from_picture_, direction));
  const int column = std::clamp(static_cast<int>(place.x * width_) / block_, 0, columns_ - 1),
            row = std::clamp(static_cast<int>(place.y * height_) / block_, 0, rows_ - 1);
  return cell_mass(column, row) / (total_ * cell_solid_angle(column, row));
}

}  // namespace tyndall::optics
