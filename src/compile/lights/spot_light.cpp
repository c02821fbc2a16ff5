#include "compile/lights/spot_light.h"

#include <algorithm>
#include <cmath>

namespace tyndall::compile {

Compiled<scene::SpotLight>::Compiled(const scene::SpotLight& light, const LightSetting& in)
    : position_(light.position - in.origin),
      angle_(light.angle.radians),
      cone_(optics::SpotCone::around(normalize((light.to - in.origin) - position_), angle_, light.blend)),
      intensity_(light.emitted_intensity()) {}

std::optional<optics::LightSample> Compiled<scene::SpotLight>::sample(const Vec3d& x, const optics::Pivot&,
                                                                      float, float) const {
  const Vec3d to = position_ - x;
  const double distance = length(to);
  if (!(distance > 0)) return std::nullopt;
  const Vec3d w = to / distance;
  const double share = cone_.share(-w);
  if (!(share > 0)) return std::nullopt;
  return optics::LightSample{w, distance, intensity_ * static_cast<float>(share / sqr(distance)), 0};
}

double Compiled<scene::SpotLight>::importance(const optics::RaySegment& s) const {
  const optics::ReachedParts reached = in_cone(s.origin, s.direction, s.t1);
  if (s.t0 < s.t1 && (reached.count == 0 || reached.parts[reached.count - 1].hi <= s.t0)) return 0;
  return optics::nearest_irradiance(optics::mean(intensity_), 0, position_, s);
}

// The parts of the ray in the cone. Seen from the apex the points of a line at distance D lie on a half
// circle, t = nearest + D tan(phi) with phi in (-90deg, 90deg), on which the cosine to the axis is a shifted
// cosine.
optics::ReachedParts Compiled<scene::SpotLight>::in_cone(const Vec3d& origin, const Vec3d& direction,
                                                         double t_max) const {
  const Vec3d from_apex = origin - position_;
  const double nearest = -dot(from_apex, direction);
  const Vec3d across = from_apex + direction * nearest;
  const double distance = length(across), cos_rim = std::cos(angle_);
  optics::ReachedParts reached;
  const auto add = [&](double t0, double t1) {
    // Both ends of a narrow shadow may come in the wrong order by rounding.
    const double from = reached.count > 0 ? reached.parts[reached.count - 1].hi : 0;
    const Intervald part = Intervald{t0, t1}.clipped_to({from, t_max});
    if (!part.empty()) reached.parts[reached.count++] = part;
  };
  const double along_axis = dot(direction, cone_.axis);
  if (!(distance > 0)) {  // through the apex: each side is in the cone or not
    if (-along_axis > cos_rim) add(-infinity, nearest);
    if (along_axis > cos_rim) add(nearest, infinity);
    return reached;
  }
  const double across_axis = dot(across, cone_.axis) / distance,
               largest = std::hypot(across_axis, along_axis);
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

}  // namespace tyndall::compile
