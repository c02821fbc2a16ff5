#include "base/problem.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace tyndall {

std::string text_of(const Vec3d& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

void want_positive(Problems& problems, std::string_view field, double value, std::string help) {
  if (!(value > 0))
    problems.push_back({field, fmt::format("'{}' must be above 0, found {}", field, value), std::move(help)});
}

void want_not_negative(Problems& problems, std::string_view field, double value) {
  if (!(value >= 0))
    problems.push_back({field, fmt::format("'{}' must not be negative, found {}", field, value)});
}

void want_direction(Problems& problems, std::string_view field, const Vec3d& v) {
  const double length2 = length_squared(v);
  if (length2 > 0 && std::isfinite(length2)) return;
  problems.push_back({field, fmt::format("'{}' has no direction, found {}", field, text_of(v))});
}

void want_area(Problems& problems, const Vec3d& u, const Vec3d& v) {
  const double area2 = length_squared(cross(u, v));
  // 1e-24: sin² of the smallest angle between u and v that leaves the normal half of its digits.
  if (area2 > 1e-24 * length_squared(u) * length_squared(v)) return;
  problems.push_back({"v", fmt::format("u and v span no area, found u {} and v {}", text_of(u), text_of(v)),
                      "u and v are half of two edges that are not parallel: u: (1, 0, 0) v: (0, 0, 1)"});
}

void want_height(Problems& problems, const Vec3d& from, const Vec3d& to, std::string help) {
  const double length2 = length_squared(to - from);
  if (length2 > 0 && std::isfinite(length2)) return;
  problems.push_back(
      {"to", fmt::format("'to' must be away from 'from', found {} and {}", text_of(to), text_of(from)),
       std::move(help)});
}

void want_color(Problems& problems, std::string_view field, const std::optional<Rgb>& color) {
  if (!color) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const float value = (*color)[i];
    if (value >= 0 && std::isfinite(value)) continue;
    problems.push_back({field, std::isfinite(value)
                                   ? fmt::format("'{}' must not be negative, found {}", field, value)
                                   : fmt::format("'{}' is too large to be stored", field)});
    return;
  }
}

}  // namespace tyndall
