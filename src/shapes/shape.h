// The shapes: what a scene says of them, and what they are asked. A member of the family is a struct of its
// own, with
//
//   keyword, documentation
//   closed                    whether it has an inside
//   fields(f), validate()     its parameters, and what is wrong with them
//   hit(origin, direction, t_min, t_max)   the first crossing in (t_min, t_max)
//   inside(origin, direction) of closed ones: the interval of a line within, or a list of them
//   depth(p)                  of closed ones: negative outside; inside no more than the way to the surface
//   bounds()                  of those that end somewhere
//   turned_bounds()           optional: whichever way the shape faces, where its numbers alone turn it. The
//   box
//                             around those of two moments holds what goes from one to the other
//   ball()
//   triangles(), or area() and sample(u0, u1), even over the area: of those that can be lights
//
// Meshes and curves are numbers of the scene's: `compile` answers for them.
#pragma once

#include <type_traits>
#include <variant>

#include "shapes/box.h"
#include "shapes/combination.h"
#include "shapes/cone.h"
#include "shapes/curves.h"
#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "shapes/mesh.h"
#include "shapes/plane.h"
#include "shapes/quad.h"
#include "shapes/sphere.h"
#include "shapes/torus.h"

namespace tyndall::shapes {

using Shape = std::variant<Sphere, Box, Plane, Quad, Disk, Cylinder, Cone, Torus, Difference, Intersection,
                           Union, Mesh, Curves>;

// Those that answer by themselves.
template <class S>
concept Analytic = !std::is_same_v<S, Mesh> && !std::is_same_v<S, Curves>;
template <class S>
concept Closed = Analytic<S> && S::closed;
// Those that end somewhere.
template <class S>
concept Bounded = requires(const S& s) {
  s.bounds();
};
// Of flat faces, or drawn over a curved area.
template <class S>
concept Faceted = requires(const S& s) {
  s.triangles();
};
template <class S>
concept Sampled = requires(const S& s) {
  s.sample(0.0, 0.0);
};

// Calls visit(interval) for one interval or for those of an array that are not empty, clipped to [0, t_max).
template <class Visit>
void for_each_interval(const Intervald& interval, double t_max, Visit&& visit) {
  if (const Intervald clipped = interval.clipped_to({0, t_max}); !clipped.empty()) visit(clipped);
}
template <std::size_t N, class Visit>
void for_each_interval(const std::array<Intervald, N>& intervals, double t_max, Visit&& visit) {
  for (const Intervald& interval : intervals) for_each_interval(interval, t_max, visit);
}
template <class Visit>
void for_each_interval(const Stays& stays, double t_max, Visit&& visit) {
  for (const Intervald& interval : stays) for_each_interval(interval, t_max, visit);
}

}  // namespace tyndall::shapes
