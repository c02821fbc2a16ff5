// `light point`: the same intensity in all directions.
#pragma once

#include "compile/lights/light_roles.h"

namespace tyndall::compile {

template <>
class Compiled<scene::PointLight> : public WithoutExtent {
 public:
  Compiled(const scene::PointLight& light, const LightSetting& in)
      : position_(light.position - in.origin), intensity_(light.emitted_intensity()) {}
  Compiled moved(const scene::PointLight& light, const LightSetting& in) const { return {light, in}; }

  std::optional<optics::Pivot> sample_pivot(float, float) const { return optics::Pivot{position_}; }
  std::optional<optics::LightSample> sample(const Vec3d& x, const optics::Pivot&, float, float) const {
    const Vec3d to = position_ - x;
    const double distance = length(to);
    if (!(distance > 0)) return std::nullopt;
    return optics::LightSample{to / distance, distance, intensity_ * static_cast<float>(1 / sqr(distance)),
                               0};
  }
  optics::ReachedParts reached_parts(const optics::Pivot&, const Vec3d&, const Vec3d&, double t_max) const {
    return optics::whole_ray(t_max);
  }
  double importance(const optics::RaySegment& segment) const {
    return optics::nearest_irradiance(optics::mean(intensity_), 0, position_, segment);
  }
  std::optional<optics::LightBounds> bounds() const {
    return optics::bounds_around(position_, {}, optics::mean(intensity_));
  }

 private:
  Vec3d position_;
  Rgb intensity_;
};

}  // namespace tyndall::compile
