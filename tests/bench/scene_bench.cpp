// Samples per second of the first scenes, small and single-threaded: what one core does.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "bench.h"
#include "compile/compiled_scene.h"
#include "render/render.h"
#include "scene_file.h"

namespace tyndall {

bool bench_scenes(double seconds) {
  constexpr std::array names{"first-light", "point-light-in-fog", "smoky-room"};
  std::vector<compile::CompiledScene> worlds;
  for (const char* name : names) {
    std::optional<scene::Scene> scene = load_scene(fmt::format("{}/scenes/{}.tyn", TYNDALL_SOURCE_DIR, name));
    if (!scene) return false;
    scene->settings.resolution.width = 160;
    scene->settings.resolution.height = 90;
    worlds.push_back(compile::compile(std::move(*scene)));
  }
  std::array<std::vector<double>, names.size()> rates, lanes;
  for (int round = 0; round < 3; ++round)  // alternated, so that what else the machine does hits all alike
    for (std::size_t i = 0; i < names.size(); ++i) {
      render::RenderOptions options;
      options.threads = 1;
      options.sample_count = 1;
      double spent = 0, samples = 0, used = 0, issued = 0;
      while (spent < seconds) {
        const render::Statistics s = render::render(worlds[i], options).statistics;
        ++options.first_sample;
        spent += s.seconds;
        samples += static_cast<double>(s.samples);
        used += static_cast<double>(s.lanes_used);
        issued += static_cast<double>(s.lanes_issued);
      }
      rates[i].push_back(samples / spent);
      lanes[i].push_back(issued > 0 ? used / issued : 1);
    }
  fmt::print("scene at 160x90, one thread   samples/s (median of 3)   lanes used / issued\n");
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::sort(rates[i].begin(), rates[i].end());
    fmt::print("{:<30}{:>10.0f}{:>28.2f}\n", names[i], rates[i][1], lanes[i][1]);
  }
  return true;
}

}  // namespace tyndall
