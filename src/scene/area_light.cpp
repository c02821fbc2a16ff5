#include "scene/area_light.h"

#include "base/numerics.h"
#include "scene/scene.h"

namespace tyndall::scene {

namespace {

// Each of LightShapes, moved by any map (false when it does not survive that), and along.

bool to_world(Sphere& sphere, const Transform& t) {
  const std::optional<double> scale = similarity_scale(t);
  if (!scale) return false;
  sphere.center = t.point(sphere.center);
  sphere.radius *= *scale;
  return true;
}
void translate(Sphere& sphere, const Vec3d& by) { sphere.center += by; }

bool to_world(Quad& quad, const Transform& t) {
  quad.center = t.point(quad.center);
  quad.u = t.vector(quad.u);
  quad.v = t.vector(quad.v);
  // A mirroring map turns u × v around; swapped, the light still shines where its statement says.
  if (t.determinant() < 0) std::swap(quad.u, quad.v);
  return true;
}
void translate(Quad& quad, const Vec3d& by) { quad.center += by; }

bool to_world(Disk& disk, const Transform& t) {
  const std::optional<double> scale = similarity_scale(t);
  if (!scale) return false;
  disk.center = t.point(disk.center);
  disk.normal = normalize(t.vector(disk.normal));
  disk.radius *= *scale;
  return true;
}
void translate(Disk& disk, const Vec3d& by) { disk.center += by; }

bool to_world(Cylinder& cylinder, const Transform& t) {
  const std::optional<double> scale = similarity_scale(t);
  if (!scale) return false;
  cylinder.from = t.point(cylinder.from);
  cylinder.to = t.point(cylinder.to);
  cylinder.radius *= *scale;
  return true;
}
void translate(Cylinder& cylinder, const Vec3d& by) { cylinder.from += by, cylinder.to += by; }

}  // namespace

std::string_view AreaLight::keyword() const {
  return std::visit(
      []<class S>(const S&) {
        if constexpr (is_one_of<S, LightShapes>)
          return light_keyword<S>;
        else
          return mesh_keyword;
      },
      shape);
}

Problems AreaLight::validate() const {
  Problems problems = std::visit(
      []<class S>(const S& s) {
        if constexpr (is_one_of<S, LightShapes>)
          return s.validate();
        else
          return Problems{};  // checked where it was made
      },
      shape);
  for (Problem& problem : problems)
    if (problem.field == "radius") problem.help = "a light without extent is a `light point`";
  want_color(problems, "power", power);
  want_color(problems, "radiance", radiance);
  return problems;
}

bool AreaLight::to_world(const Transform& world_from_local) {
  return std::visit(
      [&]<class S>(S& s) {
        if constexpr (is_one_of<S, LightShapes>) {
          return scene::to_world(s, world_from_local);
        } else {
          world_from_shape = world_from_local * world_from_shape.value_or(Transform{});
          // The area of a stretched curved shape, and so its power, has no plain form.
          return shapes::Sampled<S> ? similarity_scale(*world_from_shape).has_value()
                                    : world_from_shape->inverse().has_value();
        }
      },
      shape);
}

void AreaLight::translate(const Vec3d& by) {
  std::visit(
      [&]<class S>(S& s) {
        if constexpr (is_one_of<S, LightShapes>) {
          scene::translate(s, by);
        } else {
          if (!world_from_shape) world_from_shape.emplace();
          world_from_shape->t += by;
        }
      },
      shape);
}

Rgb AreaLight::radiance_over(double area) const {
  if (radiance) return *radiance;
  return power.value_or(Rgb{}) * static_cast<float>(1.0 / (pi * area));
}

}  // namespace tyndall::scene
