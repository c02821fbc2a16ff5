#include "optics/lights.h"

#include <cmath>

#include "base/numerics.h"
#include "optics/emitter.h"

namespace tyndall::optics {

namespace {

// Radiance of a surface of area `area` [m²] that radiates `power` evenly over the hemisphere.
Rgb radiance_of(const std::optional<Rgb>& radiance, const std::optional<Rgb>& power, double area) {
  if (radiance) return *radiance;
  return power.value_or(Rgb{}) * static_cast<float>(1.0 / (pi * area));
}

}  // namespace

Rgb radiance(const SphereLight& light) {
  return radiance_of(light.radiance, light.power, 4 * pi * sqr(light.radius));
}

Rgb radiance(const QuadLight& light) {
  return radiance_of(light.radiance, light.power, 4 * length(cross(light.u, light.v)));
}

Rgb radiance(const DiskLight& light) {
  return radiance_of(light.radiance, light.power, pi * sqr(light.radius));
}

Rgb radiance(const MeshLight& light) {
  if (!light.emitter || !(light.emitter->area() > 0)) return {};
  return radiance_of(light.radiance, light.power, light.emitter->area());
}

Rgb intensity(const PointLight& light) {
  if (light.intensity) return *light.intensity;
  return light.power.value_or(Rgb{}) * static_cast<float>(inv_4pi);
}

double SpotCone::share(const Vec3d& direction) const {
  const double m = length_squared(direction - axis) / 2;
  if (m >= rim) return 0;
  if (m <= full) return 1;
  const double x = (rim - m) / (rim - full);
  return x * x * (3 - 2 * x);
}

SpotCone cone(const SpotLight& light) {
  const auto one_minus_cos = [](double angle) { return 2 * sqr(std::sin(angle / 2)); };
  SpotCone out;
  out.axis = normalize(light.to - light.position);
  out.full = one_minus_cos(light.angle.radians * (1 - light.blend));
  out.rim = one_minus_cos(light.angle.radians);
  // The smooth step's mean is a half, so the cone's weighted solid angle is 2 pi times the mean of both ends.
  out.intensity = light.intensity
                      ? *light.intensity
                      : light.power.value_or(Rgb{}) * static_cast<float>(1 / (pi * (out.full + out.rim)));
  return out;
}

}  // namespace tyndall::optics
