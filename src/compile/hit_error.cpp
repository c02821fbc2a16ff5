#include "compile/hit_error.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace tyndall::compile {

namespace {

Vec3d absolute(const Vec3d& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

Vec3d larger(const Vec3d& a, const Vec3d& b) {
  return {std::max(std::abs(a.x), std::abs(b.x)), std::max(std::abs(a.y), std::abs(b.y)),
          std::max(std::abs(a.z), std::abs(b.z))};
}

// The longest of the image of a box of this half size, by axis.
Vec3d spread(const Transform& map, const Vec3d& v) {
  return absolute(map.x) * v.x + absolute(map.y) * v.y + absolute(map.z) * v.z;
}

}  // namespace

Vec3d reach(const scene::Sphere& s) { return absolute(s.center) + Vec3d(s.radius); }
Vec3d reach(const scene::Box& b) { return larger(b.min, b.max); }
Vec3d reach(const scene::Plane& p, const Vec3d& position) { return absolute(p.point) + absolute(position); }
Vec3d reach(const scene::Quad& q) {
  const double u = length(q.u), v = length(q.v);
  return absolute(q.center) + Vec3d((u + v) * (u * v / length(cross(q.u, q.v))));
}
Vec3d reach(const scene::Disk& k) { return absolute(k.center) + Vec3d(k.radius); }
Vec3d reach(const scene::Cylinder& c) { return rod_reach(c.from, c.to, c.radius); }

Vec3d rod_reach(const Vec3d& from, const Vec3d& to, double radius) {
  return larger(from, to) + Vec3d(length(to - from) + radius);
}

Vec3d triangle_reach(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d sides = larger(larger(b - a, c - b), a - c);
  return larger(larger(a, b), c) + Vec3d(max_component(sides));
}

Vec3d placed_error(const Transform& outer_from_inner, const Transform& inner_from_outer, const Vec3d& p_inner,
                   const Vec3d& p_outer, const Vec3d& error_inner) {
  const Vec3d way_back = spread(inner_from_outer, absolute(p_outer)) + absolute(inner_from_outer.t);
  const Vec3d off_inverse = absolute(inner_from_outer.point(p_outer) - p_inner);
  const Vec3d way_out = spread(outer_from_inner, absolute(p_inner)) + absolute(outer_from_inner.t);
  return spread(outer_from_inner, error_inner + off_inverse + way_back * rounding) + way_out * rounding;
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
