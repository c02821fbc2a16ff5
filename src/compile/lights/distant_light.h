// `light distant`: a disc at infinity, or a point there.
#pragma once

#include <cmath>

#include "compile/lights/light_roles.h"

namespace tyndall::compile {

template <>
class Compiled<scene::DistantLight> : public AtInfinity {
 public:
  Compiled(const scene::DistantLight& light, const LightSetting&)
      : travel_(normalize(light.direction)), irradiance_(*light.irradiance) {
    const double angle = light.angle.radians;
    if (angle == 0) return;
    m_max_ = 2 * sqr(std::sin(angle / 4));
    // Irradiance on a surface that faces it is pi sin² of the half angle times radiance.
    disc_radiance_ = irradiance_ * static_cast<float>(1 / (pi * sqr(std::sin(angle / 2))));
  }
  Compiled moved(const scene::DistantLight& light, const LightSetting& in) const { return {light, in}; }

  LightKind kind() const { return m_max_ == 0 ? LightKind::delta : LightKind::distant_disc; }
  std::optional<optics::LightSample> sample(const Vec3d&, const optics::Pivot&, float u0, float u1) const {
    if (m_max_ == 0) return optics::LightSample{-travel_, infinity, irradiance_, 0};
    const double solid_angle = optics::cone_solid_angle(m_max_);
    return optics::LightSample{optics::sample_cone(-travel_, m_max_, u0, u1), infinity,
                               disc_radiance_ * static_cast<float>(solid_angle), 1 / solid_angle};
  }
  double pdf(const Vec3d&, const Vec3d&, const Vec3d&, const Vec3d&) const {
    return m_max_ > 0 ? 1 / optics::cone_solid_angle(m_max_) : 0;
  }
  Rgb radiance_from_infinity(const Vec3d& direction) const {
    return length_squared(direction + travel_) / 2 < m_max_ ? disc_radiance_ : Rgb{};
  }
  double importance(const optics::RaySegment&) const { return optics::mean(irradiance_); }
  std::optional<Vec3d> toward() const { return -travel_; }

 private:
  Vec3d travel_;  // unit
  Rgb irradiance_, disc_radiance_;
  double m_max_ = 0;  // 1 - cos of the half angle of its disc
};

}  // namespace tyndall::compile
