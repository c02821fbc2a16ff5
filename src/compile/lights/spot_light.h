// `light spot`: a point that shines into a cone.
#pragma once

#include "compile/lights/light_roles.h"
#include "optics/spot_cone.h"

namespace tyndall::compile {

template <>
class Compiled<scene::SpotLight> : public WithoutExtent {
 public:
  Compiled(const scene::SpotLight& light, const LightSetting& in);
  Compiled moved(const scene::SpotLight& light, const LightSetting& in) const { return {light, in}; }

  std::optional<optics::Pivot> sample_pivot(float, float) const { return optics::Pivot{position_}; }
  std::optional<optics::LightSample> sample(const Vec3d& x, const optics::Pivot&, float, float) const;
  optics::ReachedParts reached_parts(const optics::Pivot&, const Vec3d& origin, const Vec3d& direction,
                                     double t_max) const {
    return in_cone(origin, direction, t_max);
  }
  double importance(const optics::RaySegment& segment) const;
  std::optional<optics::LightBounds> bounds() const {
    return optics::bounds_facing(position_, {}, optics::mean(intensity_), cone_.axis, angle_);
  }

 private:
  optics::ReachedParts in_cone(const Vec3d& origin, const Vec3d& direction, double t_max) const;

  Vec3d position_;
  double angle_;  // from the axis to the rim [rad]
  optics::SpotCone cone_;
  Rgb intensity_;  // on the axis
};

}  // namespace tyndall::compile
