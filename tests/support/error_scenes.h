// Scenes on which `--error` is held to what it promises.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "compile/compiled_scene.h"
#include "image/image.h"
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
     R"(
camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 40deg }
light environment { radiance: 1 }
volume {
  in: sphere { radius: 1.8 }
  medium: { density = 3 * max(0, 1.5 - length(p) + sin(4 * p.x))  albedo = (0.9, 0.7, 0.5) }
}
)"},
    {"a room", 0.1, 4096, false,
     "camera perspective { from: (0, 0, 3.4)  to: (0, 0, 0)  fov: 60deg }\n"
     "light sphere { center: (0, 1.2, 0)  radius: 0.3  power: 40 }\n"
     "box { min: (-2, -1.5, -2)  max: (2, 1.5, 4)  material: { base_color = (0.7, 0.6, 0.5) } }\n"},
    {"a point lamp in fog", 0.2, 4096, false,
     "camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 40deg }\n"
     "light point { position: (0.5, 0.3, 0)  power: 30 }\n"
     "volume { in: sphere { radius: 2.5 }  medium: { density = 0.8  albedo = 0.9 } }\n"},
    {"a small fire", 0.15, 4096, false,
     R"(
camera perspective { from: (0, 1, 6)  to: (0, 0.8, 0)  fov: 40deg }
plane { point: (0, 0, 0)  normal: (0, 1, 0) }
volume {
  in: sphere { center: (0, 0.4, 0)  radius: 0.3 }
  medium: {
    density = 4 * max(0, 1 - length(p - (0, 0.4, 0)) / 0.3)
    albedo = 0.3
    emission = 60 * (1, 0.5, 0.1) * max(0, 1 - length(p - (0, 0.4, 0)) / 0.2)
  }
}
)"},
    {"the caustic of a glass ball", 0.4, 4096, false,
     R"(
camera perspective { from: (0, 3, 6)  to: (0, 0.3, 0)  fov: 40deg }
light sphere { center: (2, 4, 1)  radius: 0.4  power: 100 }
plane { point: (0, 0, 0)  normal: (0, 1, 0) }
sphere { center: (0, 0.8, 0)  radius: 0.7  material: { transmission = 1  ior = 1.5  roughness = 0 } }
)"},
    {"a mirror with a lamp", 0.4, 4096, false,
     R"(
camera perspective { from: (0, 1.5, 6)  to: (0, 0.8, 0)  fov: 40deg }
light sphere { center: (1, 1, 1.5)  radius: 0.1  power: 40 }
plane { point: (0, 0, 0)  normal: (0, 1, 0) }
quad { center: (0, 1, -1)  u: (2, 0, 0)  v: (0, 1, 0)  material: { metallic = 1  roughness = 0.02 } }
)"},
};

inline std::string error_scene_text(const ErrorScene& row) {
  return std::string("render { resolution: (64, 36)  bounces: 24 }\n") + row.scene;
}

// What errors are taken against: two independent pictures, of seeds of their own. A product of the
// differences from one and from the other has the squared error as its mean, without what the reference
// itself is off by.
struct ErrorReference {
  std::array<image::Image, 2> pictures;
};
inline ErrorReference error_reference(const ErrorScene& row, scene::Scene scene) {
  render::RenderOptions options;
  options.sample_count = row.reference_samples / 2;
  scene.settings.seed = 1000;
  image::Image first = render::render(compile::compile(scene), options).film.image();
  scene.settings.seed = 1001;
  return {{std::move(first), render::render(compile::compile(std::move(scene)), options).film.image()}};
}

// The mean squared relative error of a picture.
inline double relative_mse(const image::Image& picture, const ErrorReference& reference) {
  const std::vector<float>&a = reference.pictures[0].pixels, &b = reference.pictures[1].pixels;
  const auto count = static_cast<double>(a.size());
  double mean = 0, sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) mean += (double{a[i]} + b[i]) / 2 / count;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = picture.pixels[i], truth = (double{a[i]} + b[i]) / 2;
    sum += (x - a[i]) * (x - b[i]) / (truth * truth + 0.01 * mean * mean);
  }
  return std::max(sum / count, 0.0);
}

// One render with a goal: the error that it has and the one that it tells, in shares of the goal.
struct ErrorRun {
  double reached = 0, told = 0, samples = 0;  // samples per pixel
  double outlier_share = 0;
  bool claimed = false;  // it says that the goal was reached, and that nothing rare was met
  bool kept() const { return 0.5 <= reached && reached <= 1.1; }
};
inline ErrorRun error_run(const ErrorScene& row, scene::Scene scene, const ErrorReference& truth,
                          std::uint64_t seed) {
  scene.settings.seed = seed;
  render::RenderOptions options;
  options.error = row.target;
  options.sample_count = row.reference_samples / 2;
  const render::RenderResult result = render::render(compile::compile(std::move(scene)), options);
  ErrorRun run;
  run.reached = std::sqrt(relative_mse(result.film.image(), truth)) / row.target;
  run.told = result.statistics.estimated_error / row.target;
  run.samples = static_cast<double>(result.statistics.samples) / (64 * 36);
  run.outlier_share = result.statistics.outlier_share;
  run.claimed = run.told <= 1 && result.statistics.outlier_share < 0.5;
  return run;
}

}  // namespace tyndall::support
