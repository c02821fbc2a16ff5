// `light environment`: radiance from everywhere. One colour is gathered where rays end and never drawn; a
// picture is drawn in proportion to it.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "compile/lights/light_roles.h"
#include "optics/sky.h"

namespace tyndall::compile {

template <>
class Compiled<scene::EnvironmentLight> : public AtInfinity {
 public:
  Compiled(const scene::EnvironmentLight& light, const LightSetting& in)
      : radiance_(light.radiance), world_from_picture_(light.world_from_picture()) {
    if (!radiance_.picture[0]) return;
    if (in.skies)
      for (const auto& sky : *in.skies)
        if (sky->is_of(radiance_, world_from_picture_)) sky_ = sky;
    if (sky_) return;
    sky_ = std::make_shared<const optics::Sky>(radiance_, world_from_picture_);
    if (in.skies) in.skies->push_back(sky_);
  }
  // Colours that come later are drawn by as well.
  void begins_to_move(const scene::Moving<scene::LightInstance>& motion) {
    if (!sky_) return;
    optics::SkyRadiance brightest = radiance_;
    for (const scene::LightInstance& key : motion.keys) {
      const Rgb& color = std::get<scene::EnvironmentLight>(key.light).radiance.color;
      for (std::size_t c = 0; c < 3; ++c) brightest.color[c] = std::max(brightest.color[c], color[c]);
    }
    if (brightest.color != radiance_.color)
      sky_ = std::make_shared<const optics::Sky>(brightest, world_from_picture_);
  }
  Compiled moved(const scene::EnvironmentLight& light, const LightSetting&) const {
    Compiled now = *this;
    now.radiance_ = light.radiance;
    now.world_from_picture_ = light.world_from_picture();
    if (sky_ && now.world_from_picture_ != world_from_picture_)
      now.world_from_sky_ = now.world_from_picture_ * inverse_of(world_from_picture_);
    return now;
  }

  LightKind kind() const { return LightKind::environment; }
  std::optional<optics::LightSample> sample(const Vec3d&, const optics::Pivot&, float u0, float u1) const {
    if (!(total() > 0)) return std::nullopt;
    const optics::Sky::Drawn drawn = sky_->sample(u0, u1);
    if (!(drawn.pdf_solid_angle > 0)) return std::nullopt;
    const Vec3d direction = world_from_sky_ ? world_from_sky_->vector(drawn.direction) : drawn.direction;
    return optics::LightSample{
        direction, infinity,
        radiance_from_infinity(direction) * static_cast<float>(1 / drawn.pdf_solid_angle),
        drawn.pdf_solid_angle};
  }
  double pdf(const Vec3d&, const Vec3d& direction, const Vec3d&, const Vec3d&) const {
    if (!sky_) return 0;
    return sky_->pdf(world_from_sky_ ? inverse_of(*world_from_sky_).vector(direction) : direction);
  }
  Rgb radiance_from_infinity(const Vec3d& direction) const {
    return optics::sky_radiance(radiance_, world_from_picture_, direction);
  }
  double importance(const optics::RaySegment&) const { return total(); }
  std::optional<Vec3d> toward() const { return std::nullopt; }

 private:
  double total() const { return sky_ ? sky_->total() : 0; }

  optics::SkyRadiance radiance_;
  Transform world_from_picture_;
  std::shared_ptr<const optics::Sky> sky_;   // densities of the picture as it is when the shutter opens
  std::optional<Transform> world_from_sky_;  // none: it is as it was then
};

}  // namespace tyndall::compile
