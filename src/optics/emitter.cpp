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

// Of a ball that holds the surface, in its own space.
Box box_of(const shapes::Ball& ball, const Transform& t) {
  Box box;
  const double r = ball.radius;
  for (int corner = 0; corner < 8; ++corner)
    box.add(t.point(ball.center + Vec3d(corner & 1 ? r : -r, corner & 2 ? r : -r, corner & 4 ? r : -r)));
  return box;
}

double area_of(const EmitterTriangles& t) { return t.sums.back(); }
double area_of(const shapes::Shape& shape) {
  return std::visit(
      [](const auto& s) -> double {
        if constexpr (shapes::Sampled<std::decay_t<decltype(s)>>)
          return s.area();
        else
          return 0;
      },
      shape);
}

shapes::SurfacePoint draw(const EmitterTriangles& t, double u0, double u1) {
  const double target = u0 * t.sums.back();
  const auto above = std::upper_bound(t.sums.begin() + 1, t.sums.end() - 1, target);
  const auto i = static_cast<std::size_t>(above - t.sums.begin()) - 1;
  const double part = std::clamp((target - t.sums[i]) / (t.sums[i + 1] - t.sums[i]), 0.0, 1.0);
  const auto& [a, b, c] = t.corners[i];
  const double s = std::sqrt(part);  // Turk, Graphics Gems 1990
  return {a * (1 - s) + b * (s * (1 - u1)) + c * (s * u1), normalize(cross(b - a, c - a))};
}

shapes::SurfacePoint draw(const shapes::Shape& shape, double u0, double u1) {
  return std::visit(
      [&](const auto& s) -> shapes::SurfacePoint {
        if constexpr (shapes::Sampled<std::decay_t<decltype(s)>>)
          return s.sample(u0, u1);
        else
          CHECK(false);  // Emitter's constructor refused it
        return {};
      },
      shape);
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
                        [&](const shapes::Shape& shape) {
                          std::visit(
                              [&](const auto& s) {
                                if constexpr (shapes::Sampled<std::decay_t<decltype(s)>>)
                                  box = box_of(s.ball(), world_from_object_);
                                else
                                  CHECK(false);
                              },
                              shape);
                        }},
             surface_);
  object_area_ = std::visit([](const auto& s) { return area_of(s); }, surface_);
  determinant_ = std::abs(world_from_object_.determinant());
  area_ = object_area_ * std::cbrt(sqr(determinant_));
  if (!(area_ > 0)) return;
  center_ = (box.lo + box.hi) * 0.5;
  radius_ = length(box.hi - box.lo) / 2;
}

shapes::SurfacePoint Emitter::sample(float u0, float u1) const {
  CHECK(area_ > 0);
  const shapes::SurfacePoint p = std::visit([&](const auto& s) { return draw(s, u0, u1); }, surface_);
  return {world_from_object_.point(p.position), normalize(world_from_object_.normal(p.normal))};
}

// An area element with unit normal n in the world is det / |transpose(M) n| times as large as in the object.
double Emitter::pdf_area(const Vec3d& normal) const {
  if (!(area_ > 0)) return 0;
  const Transform& t = world_from_object_;
  const double interval = length(Vec3d(dot(t.x, normal), dot(t.y, normal), dot(t.z, normal)));
  return interval / (determinant_ * object_area_);
}

}  // namespace tyndall::optics
