// What `--error` reaches against what it tells, on tame scenes and on those with rare bright paths.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench.h"
#include "scene_file.h"
#include "support/error_scenes.h"

namespace tyndall {

bool bench_errors() {
  constexpr int seeds = 20;
  fmt::print("{:<28} {:>6} {:>8} {:>8} {:>24} {:>8}\n", "", "goal", "claimed", "kept",
             "error/goal: least..most", "samples");
  for (const support::ErrorScene& row : support::error_scenes) {
    const auto scene = read_scene(row.name, support::error_scene_text(row));
    if (!scene) return false;
    const image::Image truth = support::error_reference(row, *scene);
    int claimed = 0, kept = 0;
    double samples = 0, least = 1e9, most = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const support::ErrorRun run = support::error_run(row, *scene, truth, seed);
      claimed += run.claimed;
      kept += run.claimed && run.kept();
      samples += run.samples / seeds;
      least = std::min(least, run.reached);
      most = std::max(most, run.reached);
    }
    fmt::print("{:<28} {:6.2f} {:>5}/{} {:>5}/{} {:>13.2f}..{:<9.2f} {:8.0f}\n", row.name, row.target,
               claimed, seeds, kept, claimed, least, most, samples);
  }
  return true;
}

}  // namespace tyndall
