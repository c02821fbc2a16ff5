// Camera rays, in render space.
#pragma once

#include <cstdint>

#include "compile/compiled_scene.h"

namespace tyndall::render {

// One path through a pixel, to be traced.
struct CameraSample {
  int x = 0, y = 0;
  std::uint64_t sample = 0;
};

class CameraRays {
 public:
  // Keeps a reference to the scene.
  explicit CameraRays(const compile::CompiledScene& world);

  // The ray through pixel (x, y), counted from the top left, at (u, v) in [0, 1)² of the pixel (box filter)
  // and (lens_u, lens_v) in [0, 1)² of the lens. Unit direction, t_max infinite.
  // `time` is the ray's, a fraction of the time that the shutter is open.
  compile::Ray ray(int x, int y, float u, float v, float lens_u, float lens_v, double time = 0) const;

 private:
  // As it stands at one moment.
  CameraRays(const compile::CompiledScene& world, const scene::Camera& camera);

  const compile::CompiledScene* world_;
  Vec3d origin_;             // [m]
  Vec3d right_, up_, back_;  // unit
  double half_height_ = 0;   // of the picture at distance 1 (perspective) or in the world (orthographic) [m]
  double aperture_ = 0, focus_ = 0;
  enum class Kind : unsigned char { perspective, orthographic, spherical };
  Kind kind_ = Kind::perspective;
  int width_, height_;
};

}  // namespace tyndall::render
