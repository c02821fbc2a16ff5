#include "optics/light_sampling.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "base/overloaded.h"
#include "optics/emitter.h"
#include "optics/sky.h"

namespace tyndall::optics {

namespace {

double mean(const Rgb& c) { return (double{c.x} + c.y + c.z) / 3; }

// 1 - cos of a cone's half angle from the squared sine: stable for narrow cones.
double one_minus_cos_of(double sin_squared) { return sin_squared / (1 + safe_sqrt(1 - sin_squared)); }

// A unit direction within the cone around `axis` whose 1 - cos is m_max, uniform in solid angle.
Vec3d sample_cone(const Vec3d& axis, double m_max, float u0, float u1) {
  const double m = u0 * m_max, sin_theta = safe_sqrt(m * (2 - m)), phi = 2 * pi * u1;
  return Frame<double>::around(axis).world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1 - m});
}

double cone_solid_angle(double m_max) { return 2 * pi * m_max; }

// 1 - cos of the half angle of a distant light's disc.
double disc_one_minus_cos(const DistantLight& light) { return 2 * sqr(std::sin(light.angle.radians / 4)); }

// Mean radiance of a distant light's disc: its irradiance on a facing surface is pi sin²(half angle) times
// that.
Rgb disc_radiance(const DistantLight& light) {
  return *light.irradiance * static_cast<float>(1 / (pi * sqr(std::sin(light.angle.radians / 2))));
}

std::optional<LightSample> sample(const PointLight& light, const Vec3d& x, const Pivot&, float, float) {
  const Vec3d to = light.position - x;
  const double distance = length(to);
  if (!(distance > 0)) return std::nullopt;
  return LightSample{to / distance, distance, intensity(light) * static_cast<float>(1 / sqr(distance)), 0};
}

std::optional<LightSample> sample(const SpotLight& light, const Vec3d& x, const Pivot&, float, float) {
  const Vec3d to = light.position - x;
  const double distance = length(to);
  if (!(distance > 0)) return std::nullopt;
  const Vec3d w = to / distance;
  const SpotCone spot = cone(light);
  const double share = spot.share(-w);
  if (!(share > 0)) return std::nullopt;
  return LightSample{w, distance, spot.intensity * static_cast<float>(share / sqr(distance)), 0};
}

std::optional<LightSample> sample(const SphereLight& light, const Vec3d& x, const Pivot&, float u0,
                                  float u1) {
  const Vec3d to = light.center - x;
  const double d = length(to), sin_squared = sqr(light.radius / d);
  if (!(d > light.radius)) return std::nullopt;  // inside: it shines outwards
  const double m_max = one_minus_cos_of(sin_squared);
  const Vec3d w = sample_cone(to / d, m_max, u0, u1);
  // Nearest crossing, from the distance of closest approach (no cancellation for far spheres).
  const double along = dot(to, w), miss_squared = length_squared(to - w * along);
  const double distance = along - safe_sqrt(sqr(light.radius) - miss_squared);
  const double solid_angle = cone_solid_angle(m_max);
  return LightSample{w, distance, radiance(light) * static_cast<float>(solid_angle), 1 / solid_angle};
}

// From x to a point of a flat light that shines along `area_vector`, whose length is its area.
std::optional<LightSample> sample_flat(const Vec3d& area_vector, const Rgb& radiance, const Vec3d& x,
                                       const Vec3d& pivot) {
  const Vec3d to = pivot - x;
  const double d2 = length_squared(to), distance = std::sqrt(d2);
  if (!(distance > 0)) return std::nullopt;
  const Vec3d w = to / distance;
  const double projected_area = -dot(area_vector, w);  // area times cosine at the light
  if (!(projected_area > 0)) return std::nullopt;      // behind, or edge on
  return LightSample{w, distance, radiance * static_cast<float>(projected_area / d2), d2 / projected_area};
}

Vec3d area_vector(const QuadLight& light) { return cross(light.u, light.v) * 4.0; }
Vec3d area_vector(const DiskLight& light) { return normalize(light.normal) * (pi * sqr(light.radius)); }

std::optional<LightSample> sample(const QuadLight& light, const Vec3d& x, const Pivot& pivot, float, float) {
  return sample_flat(area_vector(light), radiance(light), x, pivot.position);
}
std::optional<LightSample> sample(const DiskLight& light, const Vec3d& x, const Pivot& pivot, float, float) {
  return sample_flat(area_vector(light), radiance(light), x, pivot.position);
}

std::optional<LightSample> sample(const MeshLight& light, const Vec3d& x, const Pivot& y, float, float) {
  if (!light.emitter || !(light.emitter->area() > 0)) return std::nullopt;
  const Vec3d to = y.position - x;
  const double d2 = length_squared(to), distance = std::sqrt(d2);
  if (!(distance > 0)) return std::nullopt;
  const Vec3d w = to / distance;
  const double facing = light.both_sides ? std::abs(dot(y.normal, w)) : -dot(y.normal, w);
  if (!(facing > 0)) return std::nullopt;
  const double pdf = light.emitter->pdf_area(y.normal) * d2 / facing;
  return LightSample{w, distance, radiance(light) * static_cast<float>(1 / pdf), pdf};
}

double pdf_mesh(const MeshLight& light, const Vec3d& normal, const Vec3d& x, const Vec3d& direction,
                const Vec3d& y) {
  const double facing = light.both_sides ? std::abs(dot(normal, direction)) : -dot(normal, direction);
  return light.emitter && facing > 0 ? light.emitter->pdf_area(normal) * length_squared(y - x) / facing : 0.0;
}

double pdf_flat(double area, const Vec3d& normal, const Vec3d& x, const Vec3d& direction, const Vec3d& y) {
  const double projected_area = -dot(normal, direction) * area;
  return projected_area > 0 ? length_squared(y - x) / projected_area : 0.0;
}

std::optional<LightSample> sample(const DistantLight& light, const Vec3d&, const Pivot&, float u0, float u1) {
  const Vec3d axis = -normalize(light.direction);
  if (light.angle.radians == 0) return LightSample{axis, infinity, *light.irradiance, 0};
  const double m_max = disc_one_minus_cos(light), solid_angle = cone_solid_angle(m_max);
  return LightSample{sample_cone(axis, m_max, u0, u1), infinity,
                     disc_radiance(light) * static_cast<float>(solid_angle), 1 / solid_angle};
}

std::optional<LightSample> sample(const EnvironmentLight& light, const Vec3d&, const Pivot&, float u0,
                                  float u1) {
  if (!light.sky || !(light.sky->total() > 0)) return std::nullopt;
  const Sky::Drawn drawn = light.sky->sample(u0, u1);
  if (!(drawn.pdf_solid_angle > 0)) return std::nullopt;
  return LightSample{drawn.direction, infinity,
                     sky_radiance(light, drawn.direction) * static_cast<float>(1 / drawn.pdf_solid_angle),
                     drawn.pdf_solid_angle};
}

// Irradiance at the ray's nearest approach to a light of mean intensity I at y.
double nearest_irradiance(double intensity_mean, double radius, const Vec3d& y, const Vec3d& origin,
                          const Vec3d& direction, double t0, double t1) {
  const double t = std::clamp(dot(y - origin, direction), t0, std::max(t0, t1));
  const double d2 = length_squared(y - (origin + direction * t));
  // Light from a nearby point arrives along a stretch of the ray: its integral grows like 1/D, not 1/D².
  const double d = std::sqrt(std::max(d2, sqr(radius)));
  const double stretch = std::max(t1 - t0, 0.0);
  return d > 0 ? intensity_mean / (d * (d + stretch)) : intensity_mean;
}

// The part of the ray in front of a flat light.
ReachedParts in_front(const Vec3d& center, const Vec3d& normal, const Vec3d& origin, const Vec3d& direction,
                      double t_max) {
  ReachedParts reached{{Intervald{0, t_max}, {}}, 1};
  const double at_origin = dot(normal, origin - center), slope = dot(normal, direction);
  if (slope == 0) {
    reached.count = at_origin > 0 ? 1 : 0;
    return reached;
  }
  const double crossing = -at_origin / slope;
  Intervald& part = reached.parts[0];
  part = part.clipped_to(slope > 0 ? Intervald{crossing, t_max} : Intervald{0, crossing});
  reached.count = part.empty() ? 0 : 1;
  return reached;
}

// The parts of the ray in the cone. Seen from the apex the points of a line at distance D lie on a half
// circle, t = nearest + D tan(phi) with phi in (-90deg, 90deg), on which the cosine to the axis is a shifted
// cosine.
ReachedParts in_cone(const SpotLight& light, const Vec3d& origin, const Vec3d& direction, double t_max) {
  const Vec3d axis = normalize(light.to - light.position), from_apex = origin - light.position;
  const double nearest = -dot(from_apex, direction);
  const Vec3d across = from_apex + direction * nearest;
  const double distance = length(across), cos_rim = std::cos(light.angle.radians);
  ReachedParts reached;
  const auto add = [&](double t0, double t1) {
    // Both ends of a narrow shadow may come in the wrong order by rounding.
    const double from = reached.count > 0 ? reached.parts[reached.count - 1].hi : 0;
    const Intervald part = Intervald{t0, t1}.clipped_to({from, t_max});
    if (!part.empty()) reached.parts[reached.count++] = part;
  };
  const double along_axis = dot(direction, axis);
  if (!(distance > 0)) {  // through the apex: each side is in the cone or not
    if (-along_axis > cos_rim) add(-infinity, nearest);
    if (along_axis > cos_rim) add(nearest, infinity);
    return reached;
  }
  const double across_axis = dot(across, axis) / distance, largest = std::hypot(across_axis, along_axis);
  if (cos_rim >= largest) return reached;
  const double middle = std::atan2(along_axis, across_axis),
               half = cos_rim <= -largest ? pi : std::acos(cos_rim / largest);
  const auto t_of = [&](double phi) {
    if (phi >= pi / 2) return infinity;
    if (phi <= -pi / 2) return -infinity;
    return nearest + distance * std::tan(phi);
  };
  for (const double turn : {-2 * pi, 0.0, 2 * pi})
    add(t_of(middle - half + turn), t_of(middle + half + turn));
  return reached;
}

}  // namespace

bool is_delta(const Light& light) {
  return std::visit(Overloaded{[](const PointLight&) { return true; }, [](const SpotLight&) { return true; },
                               [](const DistantLight& l) { return l.angle.radians == 0; },
                               [](const auto&) { return false; }},
                    light);
}

std::optional<Pivot> sample_pivot(const Light& light, float u0, float u1) {
  using Result = std::optional<Pivot>;
  return std::visit(
      Overloaded{[](const PointLight& l) -> Result { return Pivot{l.position}; },
                 [](const SpotLight& l) -> Result { return Pivot{l.position}; },
                 [](const SphereLight& l) -> Result { return Pivot{l.center}; },
                 [&](const QuadLight& l) -> Result {
                   return Pivot{l.center + l.u * (2.0 * u0 - 1) + l.v * (2.0 * u1 - 1)};
                 },
                 [&](const DiskLight& l) -> Result {
                   const double r = l.radius * std::sqrt(double{u0}), phi = 2 * pi * u1;
                   const auto frame = Frame<double>::around(normalize(l.normal));
                   return Pivot{l.center + frame.x * (r * std::cos(phi)) + frame.y * (r * std::sin(phi))};
                 },
                 [&](const MeshLight& l) -> Result {
                   if (!l.emitter || !(l.emitter->area() > 0)) return std::nullopt;
                   const Emitter::Point y = l.emitter->sample(u0, u1);
                   return Pivot{y.position, y.normal};
                 },
                 [](const DistantLight&) -> Result { return std::nullopt; },
                 [](const EnvironmentLight&) -> Result { return std::nullopt; }},
      light);
}

bool pivot_on_surface(const Light& light) {
  return std::holds_alternative<QuadLight>(light) || std::holds_alternative<DiskLight>(light) ||
         std::holds_alternative<MeshLight>(light);
}

std::optional<LightSample> sample_light(const Light& light, const Vec3d& x, const Pivot& pivot, float u0,
                                        float u1) {
  return std::visit([&](const auto& l) { return sample(l, x, pivot, u0, u1); }, light);
}

double pdf_light(const Light& light, const Vec3d& x, const Vec3d& direction, const Vec3d& y,
                 const Vec3d& normal) {
  return std::visit(
      Overloaded{
          [](const PointLight&) { return 0.0; }, [](const SpotLight&) { return 0.0; },
          [&](const SphereLight& l) {
            const double sin_squared = sqr(l.radius) / length_squared(l.center - x);
            return sin_squared < 1 ? 1 / cone_solid_angle(one_minus_cos_of(sin_squared)) : 0.0;
          },
          [&](const QuadLight& l) { return pdf_flat(4 * length(cross(l.u, l.v)), normal, x, direction, y); },
          [&](const DiskLight& l) { return pdf_flat(pi * sqr(l.radius), normal, x, direction, y); },
          [&](const MeshLight& l) { return pdf_mesh(l, normal, x, direction, y); },
          [&](const DistantLight& l) {
            return l.angle.radians > 0 ? 1 / cone_solid_angle(disc_one_minus_cos(l)) : 0.0;
          },
          [&](const EnvironmentLight& l) { return l.sky ? l.sky->pdf(direction) : 0.0; }},
      light);
}

Rgb emitted(const Light& light, const Vec3d& direction, const Vec3d& normal) {
  const auto* mesh = std::get_if<MeshLight>(&light);
  if (dot(direction, normal) >= 0 && !(mesh && mesh->both_sides)) return {};
  return std::visit(
      Overloaded{[](const SphereLight& l) { return radiance(l); },
                 [](const QuadLight& l) { return radiance(l); },
                 [](const DiskLight& l) { return radiance(l); },
                 [](const MeshLight& l) { return radiance(l); }, [](const auto&) { return Rgb{}; }},
      light);
}

Rgb radiance_from_infinity(const Light& light, const Vec3d& direction) {
  return std::visit(Overloaded{[&](const EnvironmentLight& l) { return sky_radiance(l, direction); },
                               [&](const DistantLight& l) {
                                 if (l.angle.radians == 0) return Rgb{};
                                 const double m = length_squared(direction + normalize(l.direction)) / 2;
                                 return m < disc_one_minus_cos(l) ? disc_radiance(l) : Rgb{};
                               },
                               [](const auto&) { return Rgb{}; }},
                    light);
}

ReachedParts reached_parts(const Light& light, const Pivot& pivot, const Vec3d& origin,
                           const Vec3d& direction, double t_max) {
  ReachedParts all{{Intervald{0, t_max}, {}}, 1};
  return std::visit(
      Overloaded{
          [&](const QuadLight& l) { return in_front(l.center, cross(l.u, l.v), origin, direction, t_max); },
          [&](const DiskLight& l) { return in_front(l.center, l.normal, origin, direction, t_max); },
          [&](const SpotLight& l) { return in_cone(l, origin, direction, t_max); },
          [&](const MeshLight& l) {
            return l.both_sides ? all : in_front(pivot.position, pivot.normal, origin, direction, t_max);
          },
          [&](const SphereLight& l) {
            const double along = dot(l.center - origin, direction);
            const double half2 = sqr(l.radius) - length_squared(origin + direction * along - l.center);
            if (!(half2 > 0)) return all;
            const double half = std::sqrt(half2);
            ReachedParts reached;
            for (const Intervald part :
                 {Intervald{0, std::min(along - half, t_max)}, Intervald{std::max(along + half, 0.0), t_max}})
              if (!part.empty()) reached.parts[reached.count++] = part;
            return reached;
          },
          [&](const auto&) { return all; }},
      light);
}

double importance(const Light& light, const Vec3d& origin, const Vec3d& direction, double t0, double t1) {
  return std::visit(
      Overloaded{
          [&](const PointLight& l) {
            return nearest_irradiance(mean(intensity(l)), 0, l.position, origin, direction, t0, t1);
          },
          [&](const SpotLight& l) {
            const ReachedParts reached = in_cone(l, origin, direction, t1);
            if (t0 < t1 && (reached.count == 0 || reached.parts[reached.count - 1].hi <= t0)) return 0.0;
            return nearest_irradiance(mean(cone(l).intensity), 0, l.position, origin, direction, t0, t1);
          },
          [&](const SphereLight& l) {
            const double i = mean(radiance(l)) * pi * sqr(l.radius);
            return nearest_irradiance(i, l.radius, l.center, origin, direction, t0, t1);
          },
          [&](const QuadLight& l) {
            const double i = mean(radiance(l)) * 4 * length(cross(l.u, l.v));
            const double radius = std::sqrt(length_squared(l.u) + length_squared(l.v));
            return nearest_irradiance(i, radius, l.center, origin, direction, t0, t1);
          },
          [&](const DiskLight& l) {
            const double i = mean(radiance(l)) * pi * sqr(l.radius);
            return nearest_irradiance(i, l.radius, l.center, origin, direction, t0, t1);
          },
          [&](const MeshLight& l) {
            if (!l.drawn || !l.emitter || !(l.emitter->area() > 0)) return 0.0;
            // A convex shape shows about a quarter of its area to any side.
            const double i = mean(radiance(l)) * l.emitter->area() / 2;
            return nearest_irradiance(i, l.emitter->radius(), l.emitter->center(), origin, direction, t0, t1);
          },
          [&](const DistantLight& l) { return mean(*l.irradiance); },
          [](const EnvironmentLight& l) { return l.sky ? l.sky->total() : 0.0; }},
      light);
}

}  // namespace tyndall::optics
