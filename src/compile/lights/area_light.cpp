#include "compile/lights/area_light.h"

namespace tyndall::compile {

namespace {

LightSurface surface_in_render_space(scene::AreaLight light, const LightSetting& in) {
  light.translate(-in.origin);
  return surface_of(in.scene, light, in.origin);
}

Rgb radiance_of(const scene::AreaLight& light, double area) {
  return area > 0 ? light.radiance_over(area) : Rgb{};
}

}  // namespace

Compiled<scene::AreaLight>::Compiled(const scene::AreaLight& light, const LightSetting& in)
    : surface_(surface_in_render_space(light, in)), radiance_(radiance_of(light, area())) {}

Compiled<scene::AreaLight> Compiled<scene::AreaLight>::moved(const scene::AreaLight& light,
                                                             const LightSetting& in) const {
  if (!by_area()) return {light, in};
  Compiled now = *this;
  now.radiance_ = radiance_of(light, area());
  return now;
}

double Compiled<scene::AreaLight>::importance(const optics::RaySegment& segment) const {
  if (!sampled_ || !(area() > 0)) return 0;
  return visit([&](const auto& s) {
    return optics::nearest_irradiance(s.brightest(optics::mean(radiance_)), s.radius(), s.center(), segment);
  });
}

std::optional<optics::LightBounds> Compiled<scene::AreaLight>::bounds() const {
  if (!(area() > 0)) return std::nullopt;
  return visit([&](const auto& s) -> std::optional<optics::LightBounds> {
    return s.bounds(s.brightest(optics::mean(radiance_)));
  });
}

}  // namespace tyndall::compile
