// One render that is measured, in a process of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

struct RunCost {
  double seconds = 0, cpu_seconds = 0;  // of all, the latter on all threads
  double preparation_cpu_seconds = 0;   // of it before the first sample: bounds, trees, steps
  double peak_bytes = 0;
};

struct RenderRun {
  std::vector<float> pixels;  // R, G, B of each, row by row from the top
  RunCost cost;
  std::string problem;  // why there are no pixels; "" otherwise
  bool stopped = false;
};

// Renders the scene with the settings of the arguments, and this seed.
RenderRun render_run(const scene::Scene& scene, const RenderArguments& arguments, std::uint64_t seed,
                     const std::atomic<bool>& stop);

// What the scene uses of what the renderer can do (scene_features.h); nothing where it cannot be asked.
std::vector<std::pair<std::string, bool>> features_of(const scene::Scene& scene);

}  // namespace tyndall::tools
