#include "render/film/camera.h"

#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "base/overloaded.h"

namespace tyndall::render {

CameraRays::CameraRays(const compile::CompiledScene& world) : CameraRays(world, world.scene.camera) {}

CameraRays::CameraRays(const compile::CompiledScene& world, const scene::Camera& camera)
    : world_(&world),
      width_(world.scene.settings.resolution.width),
      height_(world.scene.settings.resolution.height) {
  std::visit(Overloaded{[&](const scene::PerspectiveCamera& c) {
                          half_height_ = std::tan(c.fov.radians / 2);
                          aperture_ = c.aperture;
                          focus_ = c.focus > 0 ? c.focus : length(c.to - c.from);
                        },
                        [&](const scene::OrthographicCamera& c) {
                          half_height_ = c.height / 2;
                          kind_ = Kind::orthographic;
                        },
                        [&](const scene::SphericalCamera&) { kind_ = Kind::spherical; }},
             camera);
  std::visit(
      [&](const auto& c) {
        const auto axes = Transform::look_at(c.from, c.to, c.up);
        CHECK(axes.has_value());  // resolve refuses cameras without a direction
        right_ = axes->x;
        up_ = axes->y;
        back_ = axes->z;
        origin_ = c.from - world.origin;
      },
      camera);
}

compile::Ray CameraRays::ray(int x, int y, float u, float v, float lens_u, float lens_v, double time) const {
  const scene::Moving<scene::Camera>& motion = world_->scene.motion.camera;
  if (!motion.empty() && time > 0) {
    compile::Ray ray = CameraRays(*world_, scene::at(motion, time)).ray(x, y, u, v, lens_u, lens_v, 0);
    ray.time = time;
    return ray;
  }
  // Render space has its origin at the camera when the shutter opens.
  if (kind_ == Kind::spherical) {
    const double longitude = ((x + double{u}) / width_ - 0.5) * 2 * pi,
                 latitude = (0.5 - (y + double{v}) / height_) * pi;
    return {origin_,
            normalize((right_ * std::sin(longitude) - back_ * std::cos(longitude)) * std::cos(latitude) +
                      up_ * std::sin(latitude)),
            infinity, time};
  }
  const double pixel = 2 * half_height_ / height_;
  const double sx = (x + double{u} - 0.5 * width_) * pixel, sy = (0.5 * height_ - (y + double{v})) * pixel;
  if (kind_ == Kind::orthographic) return {origin_ + right_ * sx + up_ * sy, -back_, infinity, time};
  if (aperture_ == 0) return {origin_, normalize(right_ * sx + up_ * sy - back_), infinity, time};
  const double r = aperture_ * std::sqrt(double{lens_u}), phi = 2 * pi * lens_v;
  const Vec3d lens = right_ * (r * std::cos(phi)) + up_ * (r * std::sin(phi));
  return {origin_ + lens, normalize((right_ * sx + up_ * sy - back_) * focus_ - lens), infinity, time};
}

}  // namespace tyndall::render
