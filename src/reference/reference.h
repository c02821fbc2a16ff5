// The oracle of the tests: a slow, plain, unbiased path tracer by null collisions (Woodcock et al. 1965; with
// spectral weights as in Miller, Georgiev and Jarosz 2019).
//
// It shares nothing with the march: it has its own cameras, intersections, light sampling and random numbers,
// works in double, and evaluates a medium one point at a time with the scalar interpreter of the VM.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace tyndall::reference {

struct ReferenceSettings {
  double majorant = 0;  // [1/m], at least the sum of all volumes' extinction at any point, in every channel
  int samples = 64;     // per pixel
  int bounces = 1024;   // 0: light scattered once at most
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all
};

struct ReferenceResult {
  struct Pixel {
    Vec3d mean, standard_error;  // radiance; the error from the variance of the independent samples
  };
  int width = 0, height = 0;
  std::vector<Pixel> pixels;  // row by row from the top
  // Points where the extinction exceeded the majorant: unless it is 0 the result is wrong.
  std::uint64_t majorant_violations = 0;

  const Pixel& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
  // Mean over the pixels of [x0, x1) × [y0, y1), whose errors are independent.
  Pixel region(int x0, int y0, int x1, int y1) const;
  Pixel whole() const { return region(0, 0, width, height); }
};

// Renders the scene at its own resolution and time. Cameras are pinholes; pixels are box-filtered.
// Materials may not read uv.
ReferenceResult reference_render(const scene::Scene& scene, const ReferenceSettings& settings);

}  // namespace tyndall::reference
