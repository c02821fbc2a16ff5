#include "compile/geometry/hit_error.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace tyndall::compile {

using shapes::absolute;
using shapes::larger;
using shapes::spread;

Vec3d triangle_reach(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d sides = larger(larger(b - a, c - b), a - c);
  return larger(larger(a, b), c) + Vec3d(max_component(sides));
}

double offset_along(const Vec3d& normal, const Vec3d& position, const Vec3d& origin, const Vec3d& error) {
  return dot(absolute(normal), error + (absolute(position) + absolute(origin)) * rounding);
}

double largest_error(const Transform& render_from_object, const Vec3d& center, double radius,
                     const Vec3d& origin) {
  const auto object_from_render = render_from_object.inverse();
  CHECK(object_from_render.has_value());  // resolve refuses transforms that flatten space
  const Vec3d p = absolute(center) + Vec3d(radius);
  const Vec3d p_object = spread(*object_from_render, p) + absolute(object_from_render->t);
  // Coordinates, and sides of at most twice as much.
  const Vec3d error = placed_error(render_from_object, *object_from_render, p_object,
                                   render_from_object.point(p_object), p_object * (3 * rounding));
  return length(error + (p + absolute(origin)) * rounding);
}

double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

}  // namespace tyndall::compile
