#include "optics/emitter.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "base/overloaded.h"

namespace tyndall::optics {

namespace {

struct Box {
  Vec3d lo{infinity, infinity, infinity}, hi{-infinity, -infinity, -infinity};
  void add(const Vec3d& p) {
    for (std::size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
};

// A ball that holds the surface, in its own space: where it stands and how large it is.
Box ball(const Vec3d& center, double radius, const Transform& t) {
  Box box;
  for (int corner = 0; corner < 8; ++corner)
    box.add(t.point(center + Vec3d(corner & 1 ? radius : -radius, corner & 2 ? radius : -radius,
                                   corner & 4 ? radius : -radius)));
  return box;
}

double area_of(const EmitterTriangles& t) { return t.sums.back(); }
double area_of(const EmitterSphere& s) { return 4 * pi * sqr(s.radius); }
double area_of(const EmitterDisk& d) { return pi * sqr(d.radius); }
double area_of(const EmitterCylinder& c) { return 2 * pi * c.radius * (length(c.to - c.from) + c.radius); }

// Even over a disc of radius 1.
Pair<double> disc_point(double u0, double u1) {
  const double r = std::sqrt(u0), phi = 2 * pi * u1;
  return {r * std::cos(phi), r * std::sin(phi)};
}

Emitter::Point draw(const EmitterTriangles& t, double u0, double u1) {
  const double target = u0 * t.sums.back();
  const auto above = std::upper_bound(t.sums.begin() + 1, t.sums.end() - 1, target);
  const auto i = static_cast<std::size_t>(above - t.sums.begin()) - 1;
  const double part = std::clamp((target - t.sums[i]) / (t.sums[i + 1] - t.sums[i]), 0.0, 1.0);
  const auto& [a, b, c] = t.corners[i];
  const double s = std::sqrt(part);  // Turk, Graphics Gems 1990
  return {a * (1 - s) + b * (s * (1 - u1)) + c * (s * u1), normalize(cross(b - a, c - a))};
}

Emitter::Point draw(const EmitterSphere& s, double u0, double u1) {
  const double z = 1 - 2 * u0, r = safe_sqrt(1 - z * z), phi = 2 * pi * u1;
  const Vec3d n{r * std::cos(phi), r * std::sin(phi), z};
  return {s.center + n * s.radius, n};
}

Emitter::Point draw(const EmitterDisk& d, double u0, double u1) {
  const auto frame = Frame<double>::around(d.normal);
  const auto [x, y] = disc_point(u0, u1);
  return {d.center + frame.x * (x * d.radius) + frame.y * (y * d.radius), d.normal};
}

Emitter::Point draw(const EmitterCylinder& c, double u0, double u1) {
  const double height = length(c.to - c.from);
  const Vec3d axis = (c.to - c.from) / height;
  const auto frame = Frame<double>::around(axis);
  const double side = height / (height + c.radius), end = (1 - side) / 2;  // shares of the area
  if (u0 < side) {
    const double phi = 2 * pi * u1;
    const Vec3d n = frame.x * std::cos(phi) + frame.y * std::sin(phi);
    return {c.from + axis * (height * (u0 / side)) + n * c.radius, n};
  }
  const bool at_to = u0 >= side + end;
  const double part = std::clamp((u0 - side - (at_to ? end : 0)) / end, 0.0, 1.0);
  const auto [x, y] = disc_point(part, u1);
  return {(at_to ? c.to : c.from) + frame.x * (x * c.radius) + frame.y * (y * c.radius),
          at_to ? axis : -axis};
}

// Moves the corners to the world, keeps those with an area, and sums them.
void place(EmitterTriangles& t, const Transform& world_from_object) {
  const bool mirrors = world_from_object.determinant() < 0;
  std::vector<std::array<Vec3d, 3>> kept;
  kept.reserve(t.corners.size());
  t.sums = {0};
  for (auto triangle : t.corners) {
    for (Vec3d& corner : triangle) corner = world_from_object.point(corner);
    if (mirrors) std::swap(triangle[1], triangle[2]);
    const double area = length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / 2;
    if (!(area > 0)) continue;
    kept.push_back(triangle);
    t.sums.push_back(t.sums.back() + area);
  }
  t.corners = std::move(kept);
}

}  // namespace

Emitter::Emitter(EmitterSurface surface, const Transform& world_from_object)
    : surface_(std::move(surface)), world_from_object_(world_from_object) {
  Box box;
  std::visit(Overloaded{[&](EmitterTriangles& t) {
                          place(t, world_from_object_);
                          world_from_object_ = {};
                          for (const auto& triangle : t.corners)
                            for (const Vec3d& corner : triangle) box.add(corner);
                        },
                        [&](const EmitterSphere& s) { box = ball(s.center, s.radius, world_from_object_); },
                        [&](const EmitterDisk& d) { box = ball(d.center, d.radius, world_from_object_); },
                        [&](const EmitterCylinder& c) {
                          box = ball((c.from + c.to) * 0.5, std::hypot(length(c.to - c.from) / 2, c.radius),
                                     world_from_object_);
                        }},
             surface_);
  object_area_ = std::visit([](const auto& s) { return area_of(s); }, surface_);
  determinant_ = std::abs(world_from_object_.determinant());
  area_ = object_area_ * std::cbrt(sqr(determinant_));
  if (!(area_ > 0)) return;
  center_ = (box.lo + box.hi) * 0.5;
  radius_ = length(box.hi - box.lo) / 2;
}

Emitter::Point Emitter::sample(float u0, float u1) const {
  CHECK(area_ > 0);
  const Point p = std::visit([&](const auto& s) { return draw(s, u0, u1); }, surface_);
  return {world_from_object_.point(p.position), normalize(world_from_object_.normal(p.normal))};
}

// An area element with unit normal n in the world is det / |transpose(M) n| times as large as in the object.
double Emitter::pdf_area(const Vec3d& normal) const {
  if (!(area_ > 0)) return 0;
  const Transform& t = world_from_object_;
  const double stretch = length(Vec3d(dot(t.x, normal), dot(t.y, normal), dot(t.z, normal)));
  return stretch / (determinant_ * object_area_);
}

}  // namespace tyndall::optics
