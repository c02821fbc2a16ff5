// Rays against a torus: crossings of a quartic, found without its roots' closed form, which loses digits
// where a ray grazes.
//
// The quartic F goes up and down between the roots of its derivative, a cubic; that one between the roots of
// its own. So between two neighbours of these places there is one crossing where the signs differ, and none
// where they do not: none is missed, none is hit twice. The sign is not taken from F, whose terms cancel, but
// from the distance to the tube, which has it and is good to the last digits.
#include "shapes/torus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::shapes {

namespace {

// The root of f between two places where it has different signs: Newton's steps in a bracket. f gives value
// and slope.
template <class F>
double root_between(double low, double high, bool rises, F&& f) {
  double x = 0.5 * (low + high);
  for (int i = 0; i < 100; ++i) {
    const auto [value, slope] = f(x);
    if (value == 0) return x;
    ((value < 0) == rises ? low : high) = x;
    const double newton = x - value / slope;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == x || next == low || next == high) return next;
    const double moved = std::abs(next - x);
    x = next;
    if (moved <= 0x1p-54) break;  // lengths are in units of the torus' radius
  }
  return x;
}

// A line against the torus of radius 1 around z: p + d t with unit d, from its point nearest to the middle.
struct Line {
  Vec3d p, d;
  double tube;

  // Distance to the tube, negative inside, and its slope.
  Pair<double> distance(double t) const {
    const Vec3d q = p + d * t;
    const double rho = std::hypot(q.x, q.y), to_ring = std::hypot(rho - 1, q.z);
    const double rho_slope = rho > 0 ? (q.x * d.x + q.y * d.y) / rho : 0;
    return {to_ring - tube, ((rho - 1) * rho_slope + q.z * d.z) / to_ring};
  }

  // Where the line is within the box and ball around the torus.
  Intervald near() const {
    const double half2 = (1 + tube - length(p)) * (1 + tube + length(p));
    if (!(half2 > 0)) return {};
    const double half = std::sqrt(half2);
    return between_planes(p.z + tube, d.z, 2 * tube).clipped_to({-half, half});
  }

  // The places between the ends of `range` where the derivative of F, over 4, changes its sign:
  // t³ + (K - 2 a) t - 2 b with K = |p|² + 1 - tube², a = d² and b = p·d across the axis. p·d is 0.
  struct Turns {
    std::array<double, 5> at{};  // with both ends of the range
    std::size_t count = 0;
    void add(double t) { at[count++] = t; }
  };
  Turns turns(const Intervald& range) const {
    const double linear = length_squared(p) + (1 - tube) * (1 + tube) - 2 * (d.x * d.x + d.y * d.y);
    const double constant = -2 * (p.x * d.x + p.y * d.y);
    const auto cubic = [&](double t) {
      return Pair<double>{(t * t + linear) * t + constant, 3 * t * t + linear};
    };
    std::array<double, 4> ends{range.lo, range.lo, range.hi, range.hi};
    if (linear < 0) {
      const double s = std::sqrt(-linear / 3);
      ends[1] = std::clamp(-s, range.lo, range.hi);
      ends[2] = std::clamp(s, range.lo, range.hi);
    } else {
      ends[1] = ends[2] = range.hi;
    }
    Turns out;
    out.add(range.lo);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(ends[i] < ends[i + 1])) continue;
      const bool below = cubic(ends[i]).x < 0;
      if (below != (cubic(ends[i + 1]).x < 0)) out.add(root_between(ends[i], ends[i + 1], below, cubic));
    }
    out.add(range.hi);
    return out;
  }

  std::array<Intervald, 2> inside() const {
    std::array<Intervald, 2> out{};
    const Intervald range = near();
    if (range.empty()) return out;
    const Turns turns = this->turns(range);
    std::size_t stays = 0;
    bool was_inside = false;
    for (std::size_t i = 1; i < turns.count; ++i) {
      // The ends of the range are outside or on the tube, whatever rounding makes of them.
      const bool is_inside = i + 1 < turns.count && distance(turns.at[i]).x < 0;
      if (is_inside == was_inside) continue;
      const double t =
          root_between(turns.at[i - 1], turns.at[i], !is_inside, [&](double at) { return distance(at); });
      if (is_inside)
        out[stays].lo = t;
      else
        out[stays++].hi = t;
      was_inside = is_inside;
    }
    return out;
  }
};

}  // namespace

Problems Torus::validate() const {
  Problems problems;
  want_direction(problems, "normal", normal);
  want_positive(problems, "radius", radius);
  want_positive(problems, "tube", tube);
  if (tube >= radius && radius > 0)
    problems.push_back({"tube", fmt::format("'tube' must be below 'radius', found {} and {}", tube, radius),
                        "a tube as wide as its circle has no hole"});
  return problems;
}

std::array<Intervald, 2> Torus::inside(const Vec3d& origin, const Vec3d& direction) const {
  const Frame<double> frame = Frame<double>::around(normalize(normal));
  const double speed = length(direction), nearest = dot(center - origin, direction) / sqr(speed);
  const Line line{frame.local(origin + direction * nearest - center) / radius, frame.local(direction / speed),
                  tube / radius};
  std::array<Intervald, 2> stays = line.inside();
  for (Intervald& stay : stays) {
    if (stay.empty()) continue;
    stay.lo = nearest + stay.lo * (radius / speed);
    stay.hi = nearest + stay.hi * (radius / speed);
  }
  return stays;
}

// uv is (angle about the axis, angle about the tube), each in [0, 1]: v 0.5 on the outside, 0.75 where the
// tube is highest along the normal.
std::optional<ShapeHit> Torus::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                   double t_max) const {
  double t = -1;
  for (const Intervald& stay : inside(origin, direction))
    if (t < 0) t = first_crossing(stay, t_min, t_max);
  if (t < 0) return std::nullopt;
  const Vec3d axis = normalize(normal), off = origin + direction * t - center;
  const double along = dot(off, axis);
  const Vec3d across = off - axis * along;
  const double distance = length(across);
  const Vec3d outward = across / distance;
  const double to_ring = std::hypot(distance - radius, along);
  const double cosine = (distance - radius) / to_ring, sine = along / to_ring;
  const Vec3d n = outward * cosine + axis * sine;
  const Frame<double> frame = Frame<double>::around(axis);
  const Pair<double> uv{turn_about(frame.x, frame.y, outward), 0.5 + std::atan2(sine, cosine) / (2 * pi)};
  return ShapeHit{t, center + outward * radius + n * tube, n, uv, absolute(center) + Vec3d(radius + tube)};
}

double Torus::depth(const Vec3d& p) const {
  const Vec3d axis = normalize(normal), off = p - center;
  const double along = dot(off, axis);
  return tube - std::hypot(length(off - axis * along) - radius, along);
}

Bounds Torus::bounds() const { return around(center, center, disk_extent(normal, radius) + Vec3d(tube)); }
Bounds Torus::turned_bounds() const { return around(center, center, Vec3d(radius + tube)); }
Ball Torus::ball() const { return {center, radius + tube}; }
double Torus::area() const { return 4 * sqr(pi) * radius * tube; }

// The angle about the tube has a density like the distance from the axis, 1 + e cos: its cumulative function
// is Kepler's equation.
SurfacePoint Torus::sample(double u0, double u1) const {
  const double e = tube / radius, share = 2 * pi * u0;
  const double angle = root_between(share - e, share + e, true, [&](double x) {
    return Pair<double>{x + e * std::sin(x) - share, 1 + e * std::cos(x)};
  });
  const Vec3d axis = normalize(normal);
  const auto frame = Frame<double>::around(axis);
  const double phi = 2 * pi * u1;
  const Vec3d outward = frame.x * std::cos(phi) + frame.y * std::sin(phi);
  const Vec3d n = outward * std::cos(angle) + axis * std::sin(angle);
  return {center + outward * radius + n * tube, n};
}

}  // namespace tyndall::shapes
