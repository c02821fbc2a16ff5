// Scenes on which `--error` is held to what it promises.
#pragma once

#include <cmath>
#include <string>

#include "compile/compiled_scene.h"
#include "image/compare.h"
#include "render/render.h"

namespace tyndall::support {

struct ErrorScene {
  const char* name;
  double target;
  int reference_samples;
  bool law;  // cheap, and no path is both rare and bright: every goal is reached
  const char* scene;
};

inline const ErrorScene error_scenes[] = {
    {"a lit floor", 0.05, 4096, true,
     "camera perspective { from: (0, 2, 6)  to: (0, 0.5, 0)  fov: 40deg }\n"
     "light quad { center: (0, 3, 0)  u: (0.7, 0, 0)  v: (0, 0, 0.7)  power: 50 }\n"
     "plane { point: (0, 0, 0)  normal: (0, 1, 0) }  sphere { center: (0, 0.7, 0)  radius: 0.7 }\n"},
    {"fog under the sun", 0.02, 4096, true,
     "camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 40deg }\n"
     "light distant { direction: (-1, -1, -1)  irradiance: 2 }  light environment { radiance: 0.2 }\n"
     "volume { in: sphere { radius: 1.8 }  medium: { density = 1  albedo = 0.8 } }\n"},
    {"a cloud under the sky", 0.03, 4096, false,
     "camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 40deg }\n"
     "light environment { radiance: 1 }\n"
     "volume { in: sphere { radius: 1.8 }  medium: { density = 3 * max(0, 1.5 - length(p) + sin(4 * p.x))  "
     "albedo = (0.9, 0.7, 0.5) } }\n"},
    {"a room", 0.1, 4096, false,
     "camera perspective { from: (0, 0, 3.4)  to: (0, 0, 0)  fov: 60deg }\n"
     "light sphere { center: (0, 1.2, 0)  radius: 0.3  power: 40 }\n"
     "box { min: (-2, -1.5, -2)  max: (2, 1.5, 4)  material: { base_color = (0.7, 0.6, 0.5) } }\n"},
    {"a point lamp in fog", 0.1, 8192, false,
     "camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 40deg }\n"
     "light point { position: (0.5, 0.3, 0)  power: 30 }\n"
     "volume { in: sphere { radius: 2.5 }  medium: { density = 0.8  albedo = 0.9 } }\n"},
    {"a small fire", 0.1, 8192, false,
     "camera perspective { from: (0, 1, 6)  to: (0, 0.8, 0)  fov: 40deg }\n"
     "plane { point: (0, 0, 0)  normal: (0, 1, 0) }\n"
     "volume { in: sphere { center: (0, 0.4, 0)  radius: 0.3 }  medium: { density = 4 * max(0, 1 - length(p "
     "- (0, "
     "0.4, 0)) / 0.3)  albedo = 0.3  emission = 60 * (1, 0.5, 0.1) * max(0, 1 - length(p - (0, 0.4, 0)) / "
     "0.2) } }\n"},
    {"the caustic of a glass ball", 0.1, 8192, false,
     "camera perspective { from: (0, 3, 6)  to: (0, 0.3, 0)  fov: 40deg }\n"
     "light sphere { center: (2, 4, 1)  radius: 0.4  power: 100 }\n"
     "plane { point: (0, 0, 0)  normal: (0, 1, 0) }\n"
     "sphere { center: (0, 0.8, 0)  radius: 0.7  material: { transmission = 1  ior = 1.5  roughness = 0 } "
     "}\n"},
    {"a mirror with a lamp", 0.1, 8192, false,
     "camera perspective { from: (0, 1.5, 6)  to: (0, 0.8, 0)  fov: 40deg }\n"
     "light sphere { center: (1, 1, 1.5)  radius: 0.1  power: 40 }\n"
     "plane { point: (0, 0, 0)  normal: (0, 1, 0) }\n"
     "quad { center: (0, 1, -1)  u: (2, 0, 0)  v: (0, 1, 0)  material: { metallic = 1  roughness = 0.02 } "
     "}\n"},
};

inline std::string error_scene_text(const ErrorScene& row) {
  return std::string("render { resolution: (64, 36)  bounces: 24 }\n") + row.scene;
}

// The picture that errors are taken against, of a seed of its own.
inline image::Image error_reference(const ErrorScene& row, scene::Scene scene) {
  render::RenderOptions options;
  options.sample_count = row.reference_samples;
  scene.settings.seed = 1000;
  return render::render(compile::compile(std::move(scene)), options).film.image();
}

// One render with a goal: the error that it has and the one that it tells, in shares of the goal.
struct ErrorRun {
  double reached = 0, told = 0, samples = 0;  // samples a pixel
  bool claimed = false;  // it says that the goal was reached, and that nothing rare was met
  bool kept() const { return 0.5 <= reached && reached <= 1.1; }
};
inline ErrorRun error_run(const ErrorScene& row, scene::Scene scene, const image::Image& truth,
                          std::uint64_t seed) {
  scene.settings.seed = seed;
  render::RenderOptions options;
  options.error = row.target;
  options.sample_count = row.reference_samples / 4;
  const render::RenderResult result = render::render(compile::compile(std::move(scene)), options);
  ErrorRun run;
  run.reached = std::sqrt(image::compare(result.film.image(), truth).relative_mse) / row.target;
  run.told = result.statistics.estimated_error / row.target;
  run.samples = static_cast<double>(result.statistics.samples) / (64 * 36);
  run.claimed = run.told <= 1 && result.statistics.outlier_share < 0.5;
  return run;
}

}  // namespace tyndall::support
