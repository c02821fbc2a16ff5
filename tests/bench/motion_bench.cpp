// What motion blur costs at equal samples: a cloud that moves against the one that stands, a scene in which
// nothing moves with the shutter open against closed.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "bench.h"
#include "compile/compiled_scene.h"
#include "render/render.h"
#include "scene_file.h"

namespace tyndall {

namespace {

// Named by `shutter` and `way`, the cloud's transform.
constexpr const char* cloud = R"(
render { resolution: (96, 54)  samples: 4  step: 0.05  light_samples: 1  bounces: 8 }
camera perspective { from: (0, 0.6, 5)  to: (0, 0.4, 0)  fov: 40deg }
medium heap() {
  let dome = length(p * (1, if p.y < 0 then 2.2 else 1.35, 1))
  density = 14 * smoothstep(0, 0.15, 0.72 - dome + 0.42 * fbm(p * 2.4, octaves: 5))
  albedo = 0.99
  phase = hg(0.6)
}
volume { in: box { min: (-1.5, -0.5, -1.5)  max: (1.5, 1.5, 1.5) }  medium: heap  transform: way }
plane { point: (0, -0.6, 0)  normal: (0, 1, 0) }
light distant { direction: (-1, -1, -0.5)  irradiance: 3  angle: 0.53deg }
light environment { radiance: 0.2 }
)";

struct Row {
  const char *name, *way, *still_shutter, *moving_way;
  double target;  // the ratio of times, at most
};
constexpr Row rows[] = {
    {"cloud that goes straight", "translate((0, 0, 0))", "0deg", "translate((0.6, 0.1, 0) * time)", 1.15},
    {"cloud that turns", "translate((0, 0, 0))", "0deg", "rotate_y(20deg * time)", 1.15},
    {"still cloud, shutter open", "translate((0, 0, 0))", "0deg", "translate((0, 0, 0))", 1.02},
};

std::optional<compile::CompiledScene> world_of(const char* shutter, const char* way) {
  const std::string head =
      fmt::format("animation {{ fps: 1  frames: 0..0  shutter: {} }}\nlet way = {}\n", shutter, way);
  std::optional<scene::Scene> scene = read_scene("cloud", head + cloud);
  if (!scene) return std::nullopt;
  return compile::compile(std::move(*scene));
}

// Of the processor: what other programs do then disturbs less.
double seconds_of(const compile::CompiledScene& world, int first_sample, int samples) {
  render::RenderOptions options;
  options.threads = 1;
  options.first_sample = first_sample;
  options.sample_count = samples;
  const std::clock_t begin = std::clock();
  render::render(world, options);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace

bool bench_motion() {
  constexpr int rounds = 15, samples = 4;
  bool good = true;
  fmt::print("{:<28} {:>10} {:>10} {:>22} {:>8}\n", "96x54, one thread", "still [s]", "moving [s]",
             "ratio, median of 15", "target");
  for (const Row& row : rows) {
    const auto still = world_of(row.still_shutter, row.way), moving = world_of("360deg", row.moving_way);
    if (!still || !moving) return false;
    std::vector<double> ratios, of_still, of_moving;
    for (int round = 0; round < rounds; ++round) {  // alternated, and the first of two by turns
      const int first = round * samples;
      double a = 0, b = 0;
      if (round % 2 == 0) a = seconds_of(*still, first, samples);
      b = seconds_of(*moving, first, samples);
      if (round % 2 != 0) a = seconds_of(*still, first, samples);
      of_still.push_back(a);
      of_moving.push_back(b);
      ratios.push_back(b / a);
    }
    for (auto* list : {&ratios, &of_still, &of_moving}) std::sort(list->begin(), list->end());
    const double ratio = ratios[rounds / 2];
    fmt::print("{:<28} {:10.3f} {:10.3f} {:22.3f} {:8.2f}\n", row.name, of_still[rounds / 2],
               of_moving[rounds / 2], ratio, row.target);
    good &= ratio <= row.target;
  }
  return good;
}

}  // namespace tyndall
