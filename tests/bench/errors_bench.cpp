// What `--error` reaches against what it tells, on tame scenes and on those with rare bright paths.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <vector>

#include "bench.h"
#include "scene_file.h"
#include "support/error_scenes.h"

namespace tyndall {

namespace {

void print_row(const support::ErrorScene& row, const std::vector<support::ErrorRun>& runs) {
  std::vector<double> reached, ratios;
  double samples = 0;
  for (const support::ErrorRun& run : runs) {
    reached.push_back(run.reached);
    ratios.push_back(run.told / run.reached);
    samples += run.samples / static_cast<double>(runs.size());
  }
  std::sort(reached.begin(), reached.end());
  std::sort(ratios.begin(), ratios.end());
  const auto count = [&](auto&& is) { return std::count_if(runs.begin(), runs.end(), is); };
  fmt::print("{:<28} {:5.2f} {:>6}/{} {:>6} {:>12.2f} {:5.2f} {:5.2f} {:>10.2f} {:>8.0f}\n", row.name,
             row.target, count([](const support::ErrorRun& run) { return run.kept(); }), runs.size(),
             count([](const support::ErrorRun& run) { return run.told <= 1 && run.reached > 1.1; }),
             reached.front(), reached[reached.size() / 2], reached.back(), ratios[ratios.size() / 2],
             samples);
}

}  // namespace

bool bench_errors(std::string_view part) {
  constexpr int seeds = 20;
  fmt::print("{:<28} {:>5} {:>9} {:>6} {:>24} {:>10} {:>8}\n", "", "goal", "within", "false",
             "least, median, most/goal", "told/real", "samples");
  for (const support::ErrorScene& row : support::error_scenes) {
    if (std::string_view(row.name).find(part) == std::string_view::npos) continue;
    const auto scene = read_scene(row.name, support::error_scene_text(row));
    if (!scene) return false;
    const support::ErrorReference truth = support::error_reference(row, *scene);
    std::vector<support::ErrorRun> runs;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      runs.push_back(support::error_run(row, *scene, truth, seed));
      const support::ErrorRun& run = runs.back();
      if (!part.empty())
        fmt::print("  seed {:>2}: reached {:.3f} told {:.3f} outliers {:.2f} samples {:.0f}\n", seed,
                   run.reached, run.told, run.outlier_share, run.samples);
      std::fflush(stdout);
    }
    print_row(row, runs);
  }
  return true;
}

}  // namespace tyndall
