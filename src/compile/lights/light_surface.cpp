#include "compile/lights/light_surface.h"

#include <cmath>

#include "compile/geometry/hit_error.h"
#include "compile/lights/area_emitters.h"

namespace tyndall::compile {

std::optional<SurfaceSample> SphereSurface::sample(const Vec3d& x, const optics::Pivot&, float u0,
                                                   float u1) const {
  const Vec3d to = center_ - x;
  const double d = length(to), sin_squared = sqr(radius_ / d);
  if (!(d > radius_)) return std::nullopt;  // inside: it shines outwards
  const double m_max = optics::one_minus_cos_of(sin_squared);
  const Vec3d w = optics::sample_cone(to / d, m_max, u0, u1);
  // Nearest crossing, from the distance of closest approach (no cancellation for far spheres).
  const double along = dot(to, w), miss_squared = length_squared(to - w * along);
  const double distance = along - safe_sqrt(sqr(radius_) - miss_squared);
  const double solid_angle = optics::cone_solid_angle(m_max);
  return SurfaceSample{w, distance, solid_angle, 1 / solid_angle};
}

double SphereSurface::pdf(const Vec3d& x, const Vec3d&, const Vec3d&, const Vec3d&) const {
  const double sin_squared = sqr(radius_) / length_squared(center_ - x);
  return sin_squared < 1 ? 1 / optics::cone_solid_angle(optics::one_minus_cos_of(sin_squared)) : 0.0;
}

optics::ReachedParts SphereSurface::reached_parts(const optics::Pivot&, const Vec3d& origin,
                                                  const Vec3d& direction, double t_max) const {
  const double along = dot(center_ - origin, direction);
  const double half2 = sqr(radius_) - length_squared(origin + direction * along - center_);
  if (!(half2 > 0)) return optics::whole_ray(t_max);
  const double half = std::sqrt(half2);
  optics::ReachedParts reached;
  for (const Intervald part :
       {Intervald{0, std::min(along - half, t_max)}, Intervald{std::max(along + half, 0.0), t_max}})
    if (!part.empty()) reached.parts[reached.count++] = part;
  return reached;
}

QuadSurface::QuadSurface(const scene::Quad& q)
    : FlatSurface(q.center, cross(q.u, q.v), 4 * length(cross(q.u, q.v)), cross(q.u, q.v) * 4.0),
      u_(q.u),
      v_(q.v) {}

optics::LightBounds QuadSurface::bounds(double intensity) const {
  const Vec3d extent{std::abs(u_.x) + std::abs(v_.x), std::abs(u_.y) + std::abs(v_.y),
                     std::abs(u_.z) + std::abs(v_.z)};
  return optics::bounds_facing(center_, extent, intensity, normal_, pi / 2);
}

DiskSurface::DiskSurface(const scene::Disk& d)
    : FlatSurface(d.center, d.normal, pi * sqr(d.radius), normalize(d.normal) * (pi * sqr(d.radius))),
      radius_(d.radius),
      frame_(Frame<double>::around(normalize(d.normal))) {}

std::optional<optics::Pivot> DiskSurface::sample_pivot(float u0, float u1) const {
  const double r = radius_ * std::sqrt(double{u0}), phi = 2 * pi * u1;
  return optics::Pivot{center_ + frame_.x * (r * std::cos(phi)) + frame_.y * (r * std::sin(phi))};
}

std::optional<SurfaceSample> FlatSurface::sample(const Vec3d& x, const optics::Pivot& y, float, float) const {
  const Vec3d to = y.position - x;
  const double d2 = length_squared(to), distance = std::sqrt(d2);
  if (!(distance > 0)) return std::nullopt;
  const Vec3d w = to / distance;
  const double projected_area = -dot(area_vector_, w);  // area times cosine at the light
  if (!(projected_area > 0)) return std::nullopt;       // behind, or edge on
  return SurfaceSample{w, distance, projected_area / d2, d2 / projected_area};
}

double FlatSurface::pdf(const Vec3d& x, const Vec3d& direction, const Vec3d& y, const Vec3d& normal) const {
  const double projected_area = -dot(normal, direction) * area_;
  return projected_area > 0 ? length_squared(y - x) / projected_area : 0.0;
}

std::optional<optics::Pivot> AnySurface::sample_pivot(float u0, float u1) const {
  if (!(area() > 0)) return std::nullopt;
  const shapes::SurfacePoint y = emitter_->sample(u0, u1);
  return optics::Pivot{y.position, y.normal};
}

std::optional<SurfaceSample> AnySurface::sample(const Vec3d& x, const optics::Pivot& y, float, float) const {
  if (!(area() > 0)) return std::nullopt;
  const Vec3d to = y.position - x;
  const double d2 = length_squared(to), distance = std::sqrt(d2);
  if (!(distance > 0)) return std::nullopt;
  const Vec3d w = to / distance;
  const double facing = both_sides_ ? std::abs(dot(y.normal, w)) : -dot(y.normal, w);
  if (!(facing > 0)) return std::nullopt;
  const double pdf = emitter_->pdf_area(y.normal) * d2 / facing;
  return SurfaceSample{w, distance, 1 / pdf, pdf};
}

AnySurface any_surface(const scene::Scene& scene, const scene::Shape& shape,
                       const Transform& render_from_shape, const Vec3d& origin, bool both_sides) {
  auto emitter = emitter_of(scene, shape, render_from_shape);
  const double error =
      emitter ? largest_error(render_from_shape, emitter->center(), emitter->radius(), origin) : 0;
  return {std::move(emitter), error, both_sides};
}

double AnySurface::pdf(const Vec3d& x, const Vec3d& direction, const Vec3d& y, const Vec3d& normal) const {
  const double facing = both_sides_ ? std::abs(dot(normal, direction)) : -dot(normal, direction);
  return emitter_ && facing > 0 ? emitter_->pdf_area(normal) * length_squared(y - x) / facing : 0.0;
}

LightSurface surface_of(const scene::Scene& scene, const scene::AreaLight& light, const Vec3d& origin) {
  if (const auto* sphere = std::get_if<scene::Sphere>(&light.shape)) return SphereSurface(*sphere);
  if (const auto* quad = std::get_if<scene::Quad>(&light.shape)) return QuadSurface(*quad);
  if (const auto* disk = std::get_if<scene::Disk>(&light.shape)) return DiskSurface(*disk);
  const Transform render_from_shape = light.world_from_shape.value_or(Transform{});
  return any_surface(scene, light.shape, render_from_shape, origin);
}

}  // namespace tyndall::compile
