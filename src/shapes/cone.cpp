#include "shapes/cone.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numerics.h"

namespace tyndall::shapes {

namespace {

// About its axis: z from `from` to `to`, with the slanted side's outward normal (cosine across, sine along).
struct Profile {
  double height, narrowing;  // narrowing: how much the radius falls per height
  Vec3d axis;
  double cosine, sine;

  explicit Profile(const Cone& c) : height(length(c.to - c.from)) {
    axis = (c.to - c.from) / height;
    const double fall = c.radius - c.tip_radius, slant = std::hypot(height, fall);
    narrowing = fall / height;
    cosine = height / slant;
    sine = fall / slant;
  }
};

// Where the line o + d t is within the endless cone |(x, y)| < r - k z, on the side where that is positive.
//
// With u, v across the axis and R, s of the radius along the line, ask for |u + v t|² < (R + s t)²:
// a t² + 2 b t + c with a = v² - s², b = u·v - R s, c = u² - R². Its discriminant is |R v - s u|² - (u × v)²,
// a difference of squares, which b² - a c is not to the last digits.
Intervald within_side(double r, double k, const Vec3d& o, const Vec3d& d) {
  const double R = r - k * o.z, s = -k * d.z;
  const double u = std::hypot(o.x, o.y), v = std::hypot(d.x, d.y);
  const double a = (v - s) * (v + s), b = o.x * d.x + o.y * d.y - R * s, c = (u - R) * (u + R);
  if (a == 0 && b == 0) return c < 0 && R > 0 ? Intervald{-infinity, infinity} : Intervald{};
  const double turn = std::abs(o.x * d.y - o.y * d.x);
  const double far = std::hypot(R * d.x - s * o.x, R * d.y - s * o.y);
  const double discriminant = (far - turn) * (far + turn);
  if (a > 0 && !(discriminant > 0)) return {};
  const double q = -(b + std::copysign(safe_sqrt(discriminant), b));
  if (a == 0) return b > 0 ? Intervald{-infinity, c / q} : Intervald{c / q, infinity};
  double lo = q / a, hi = q == 0 ? lo : c / q;
  if (hi < lo) std::swap(lo, hi);
  if (a > 0) return {lo, hi};
  // Steeper than the side: in one half of the double cone before the one root, in the other after the other.
  return s < 0 ? Intervald{-infinity, lo} : Intervald{hi, infinity};
}

struct ConeCrossings {
  Intervald inside;
  bool entry_end = false, exit_end = false;  // whether they are on a flat end
};

ConeCrossings crossings(const Cone& c, const Profile& p, const Vec3d& origin, const Vec3d& direction) {
  // Asked from the point of the line that is nearest to the middle: far origins cost no digits of the side.
  const double nearest = dot((c.from + c.to) * 0.5 - origin, direction) / length_squared(direction);
  const Frame<double> frame = Frame<double>::around(p.axis);
  const Vec3d o = frame.local(origin + direction * nearest - c.from), d = frame.local(direction);
  ConeCrossings out{between_planes(o.z, d.z, p.height)};
  if (out.inside.empty()) return out;
  out.entry_end = out.exit_end = d.z != 0;
  const Intervald side = within_side(c.radius, p.narrowing, o, d);
  if (side.empty()) return {};
  if (side.lo > out.inside.lo) out.inside.lo = side.lo, out.entry_end = false;
  if (side.hi < out.inside.hi) out.inside.hi = side.hi, out.exit_end = false;
  out.inside.lo += nearest;
  out.inside.hi += nearest;
  return out;
}

}  // namespace

Intervald Cone::inside(const Vec3d& origin, const Vec3d& direction) const {
  return crossings(*this, Profile(*this), origin, direction).inside;
}

// uv of the side is (angle, height), each in [0, 1]; of the ends as on a disk.
std::optional<ShapeHit> Cone::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                  double t_max) const {
  const Profile p(*this);
  const ConeCrossings i = crossings(*this, p, origin, direction);
  const double t = first_crossing(i.inside, t_min, t_max);
  if (t < 0) return std::nullopt;
  const bool entering = t == i.inside.lo;
  const Vec3d off = origin + direction * t - from;
  const Vec3d reach = rod_reach(from, to, std::max(radius, tip_radius));
  const double along = dot(off, p.axis);
  const Vec3d across = off - p.axis * along;
  if (entering ? i.entry_end : i.exit_end) {
    const bool at_to = (dot(direction, p.axis) > 0) != entering;
    const Vec3d normal = at_to ? p.axis : -p.axis;
    const double end = at_to ? tip_radius : radius;
    return ShapeHit{t, (at_to ? to : from) + across, normal, disk_uv(normal, across, end), reach};
  }
  const Frame<double> frame = Frame<double>::around(p.axis);
  const double distance = length(across);
  const Vec3d outward = distance > 0 ? across / distance : frame.x;
  // Onto the side along its normal.
  const double off_side = (distance - (radius - p.narrowing * along)) * p.cosine;
  const double z = along - p.sine * off_side, r = std::max(0.0, distance - p.cosine * off_side);
  return ShapeHit{t,
                  from + p.axis * z + outward * r,
                  outward * p.cosine + p.axis * p.sine,
                  {turn_about(frame.x, frame.y, outward), std::clamp(z / p.height, 0.0, 1.0)},
                  reach};
}

double Cone::depth(const Vec3d& q) const {
  const Profile p(*this);
  const double along = dot(q - from, p.axis), distance = length(q - from - p.axis * along);
  return std::min({along, p.height - along, (radius - p.narrowing * along - distance) * p.cosine});
}

Bounds Cone::bounds() const {
  const Bounds base = around(from, from, disk_extent(to - from, radius)),
               tip = around(to, to, disk_extent(to - from, tip_radius));
  return {around(base.lo, tip.lo, {}).lo, around(base.hi, tip.hi, {}).hi};
}
Bounds Cone::turned_bounds() const { return around(from, to, Vec3d(std::max(radius, tip_radius))); }
Ball Cone::ball() const {
  return {(from + to) * 0.5, std::hypot(length(to - from) / 2, std::max(radius, tip_radius))};
}

double Cone::area() const {
  const double slant = std::hypot(length(to - from), radius - tip_radius);
  return pi * ((radius + tip_radius) * slant + sqr(radius) + sqr(tip_radius));
}

SurfacePoint Cone::sample(double u0, double u1) const {
  const Profile p(*this);
  const auto frame = Frame<double>::around(p.axis);
  const double at = u0 * area() / pi;
  const double side = (radius + tip_radius) * std::hypot(p.height, radius - tip_radius);
  if (at < side) {
    // The square of the radius is even between those of the ends.
    const double v = at / side, phi = 2 * pi * u1;
    const double r = std::sqrt(lerp(sqr(radius), sqr(tip_radius), v));
    const double z = p.height * v * (radius + tip_radius) / (radius + r);
    const Vec3d outward = frame.x * std::cos(phi) + frame.y * std::sin(phi);
    return {from + p.axis * z + outward * r, outward * p.cosine + p.axis * p.sine};
  }
  const bool at_to = at >= side + sqr(radius);
  const double r = at_to ? tip_radius : radius;
  const double part = (at - side - (at_to ? sqr(radius) : 0)) / sqr(r);
  const auto [x, y] = disk_point(std::clamp(part, 0.0, 1.0), u1);
  return {(at_to ? to : from) + frame.x * (x * r) + frame.y * (y * r), at_to ? p.axis : -p.axis};
}

}  // namespace tyndall::shapes
