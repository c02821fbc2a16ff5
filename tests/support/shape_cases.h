// Shapes of every kind, and how deep points are in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shapes/combined_parts.h"
#include "shapes/shape.h"

namespace tyndall::support {

template <class Combination>
shapes::Shape combined(std::vector<shapes::CombinedPart> parts) {
  Combination shape;
  shape.parts = std::make_shared<const shapes::CombinedParts>(Combination::combining, std::move(parts));
  return shape;
}

inline std::vector<shapes::Shape> combined_shape_cases() {
  using namespace shapes;
  const Box box{{-0.5, -0.6, -0.7}, {0.6, 0.5, 0.4}};
  const Sphere ball{{0.2, 0.1, 0}, 0.62};
  const Transform turned = Transform::translate({0.1, -0.2, 0.3}) * Transform::rotate({1, 2, -1}, 0.7);
  const Shape die = combined<Difference>({{box, {}}, {ball, turned}});
  return {
      combined<Difference>({{box, {}}, {ball, {}}}),
      combined<Difference>({{Sphere{{0, 0, 0}, 0.9}, {}}, {Sphere{{0, 0, 0}, 0.7}, {}}}),
      combined<Difference>({{Torus{{0, 0, 0}, {0, 1, 0}, 0.7, 0.25}, turned}, {box, {}}, {ball, turned}}),
      combined<Intersection>({{box, {}}, {ball, turned}, {Cylinder{{0, -1, 0}, {0, 1, 0}, 0.5}, {}}}),
      combined<Union>({{box, turned}, {ball, {}}}),
      combined<Union>({{Sphere{{-0.6, 0, 0}, 0.3}, {}}, {Sphere{{0.5, 0, 0}, 0.4}, {}}}),
      combined<Union>({{die, turned}, {Cone{{0.1, -0.6, 0.2}, {0.4, 0.7, -0.5}, 0.5}, {}}}),
      combined<Difference>({{box, {}}, {die, Transform::scale({0.7, 0.8, 1.3})}}),
  };
}

// Of about a metre, about the origin. tests/shapes sees that no kind lacks.
inline std::vector<shapes::Shape> shape_cases() {
  using namespace shapes;
  std::vector<Shape> cases{
      Sphere{{0.3, -0.2, 0.1}, 0.8},
      Box{{-0.5, -1, 0.2}, {0.7, 0.4, 0.9}},
      shapes::Plane{{0.1, 0.2, 0}, {0.3, 1, -0.2}},
      Quad{{0.1, 0, 0.2}, {0.6, 0.1, 0}, {0.2, 0.3, 0.8}},
      Disk{{0.1, -0.2, 0.3}, {1, 2, -1}, 0.8},
      Cylinder{{0.1, -0.6, 0.2}, {0.4, 0.7, -0.5}, 0.5},
      Cylinder{{0, 0, 0}, {0, 0, -1}, 0.7},
      Cylinder{{-1, 0, 0}, {1, 0, 0}, 0.01},
      Cone{{0.1, -0.6, 0.2}, {0.4, 0.7, -0.5}, 0.5},
      Cone{{0, 0, 0}, {0, 0, -1}, 0.7, 0.3},
      Cone{{0, -0.4, 0}, {0, 0.8, 0.1}, 0.2, 0.9},
      Cone{{-0.1, 0.2, 0}, {-0.1, 0.25, 0}, 1},
      Cone{{-1, 0, 0}, {1, 0, 0}, 0.02},
      Cone{{0, -0.5, 0}, {0, 0.5, 0}, 0.4, 0.4},
      Torus{{0.1, 0, 0.2}, {0, 1, 0}, 0.7, 0.2},
      Torus{{0, 0, 0}, {1, 2, -1}, 0.6, 0.55},
      Torus{{-0.1, 0.1, 0}, {0, 0, -2}, 1, 0.01},
  };
  for (const Shape& shape : combined_shape_cases()) cases.push_back(shape);
  return cases;
}

// About the way to the surface, above 0 inside. From the definitions, apart from the shapes' own answers.
inline double depth_in(const shapes::Sphere& s, const Vec3d& p) { return s.radius - length(p - s.center); }
inline double depth_in(const shapes::Box& b, const Vec3d& p) {
  return std::min(min_component(p - b.min), min_component(b.max - p));
}
inline double depth_in(const shapes::Cylinder& c, const Vec3d& p) {
  const Vec3d axis = normalize(c.to - c.from);
  const double along = dot(p - c.from, axis);
  return std::min({along, length(c.to - c.from) - along, c.radius - length(p - c.from - axis * along)});
}
inline double depth_in(const shapes::Cone& c, const Vec3d& p) {
  const double height = length(c.to - c.from);
  const Vec3d axis = (c.to - c.from) / height;
  const double along = dot(p - c.from, axis), across = length(cross(p - c.from, axis));
  const double slant = std::hypot(height, c.radius - c.tip_radius);
  // The side as a line through (radius, 0) and (tip_radius, height).
  const double side = ((c.radius - across) * height - (c.radius - c.tip_radius) * along) / slant;
  return std::min({along, height - along, side});
}
inline double depth_in(const shapes::Torus& t, const Vec3d& p) {
  const Vec3d axis = normalize(t.normal), off = p - t.center;
  const Vec3d across = off - axis * dot(off, axis);
  return t.tube - length(off - across * (t.radius / length(across)));
}
inline double depth_in(const shapes::CombinedShape& s, const Vec3d& p) {
  double all = 0;
  for (std::size_t i = 0; i < s.parts->list.size(); ++i) {
    const shapes::CombinedPart& part = s.parts->list[i];
    const Vec3d there = part.placed ? part.placed->part_from_outer.point(p) : p;
    const double depth = std::visit(
        [&](const auto& shape) {
          if constexpr (shapes::Closed<std::decay_t<decltype(shape)>>)
            return depth_in(shape, there);
          else
            return 0.0;
        },
        part.shape);
    if (i == 0)
      all = depth;
    else if (s.parts->how == shapes::Combining::union_)
      all = std::max(all, depth);
    else
      all = std::min(all, s.parts->how == shapes::Combining::difference ? -depth : depth);
  }
  return all;
}

// Calls visit(shape) for those that are closed, as what they are.
template <class Visit>
void for_closed_shapes(Visit&& visit) {
  for (const shapes::Shape& shape : shape_cases())
    std::visit(
        [&](const auto& s) {
          if constexpr (shapes::Closed<std::decay_t<decltype(s)>>) visit(s);
        },
        shape);
}

inline std::string describe(const shapes::Shape& shape) {
  return std::visit([](const auto& s) { return std::string(s.keyword); }, shape);
}

}  // namespace tyndall::support
