// What rays towards the sun save: noise at equal time with and without them.
#include <fmt/format.h>

#include <string>

#include "bench.h"
#include "scene_file.h"

namespace tyndall {

namespace {

constexpr const char* slab = R"(
let forward = 0.75
render { resolution: (64, 48)  samples: 16  bounces: 128 }
camera perspective { from: (0, -6, 7)  to: (0, 0, 1)  up: (0, 0, 1)  fov: 30deg }
volume { in: box { min: (-12, -12, 0)  max: (12, 12, 2) }  medium: { density = 2  albedo = 0.99  phase = hg(forward) } }
light distant { direction: (-0.5, 0, -0.8)  irradiance: 1 }
)";

constexpr const char* cloud = R"(
let forward = 0.85
render { resolution: (64, 48)  samples: 16  bounces: 32  step: 0.06 }
camera perspective { from: (0, 0.3, 5)  to: (0, 0, 0)  fov: 36deg }
volume {
  in: sphere { radius: 1.5 }
  medium: {
    density = 14 * smoothstep(1.1, 0.5, length(p * (0.8, 1.2, 1)) - 0.45 * fbm(p * 2.1, octaves: 5, seed: 3))
    albedo  = 0.99
    phase   = hg(forward)
  }
}
light distant { direction: (-1, -0.8, -0.5)  irradiance: 3  angle: 0.53deg }
light environment { radiance: (0.12, 0.18, 0.3) }
)";

}  // namespace

bool bench_distant_guiding() {
  fmt::print("{:<16} {:>24} {:>24} {:>8}\n", "", "without: seconds, relMSE", "with: seconds, relMSE", "gain");
  for (const auto& [name, text] : {std::pair{"slab", slab}, std::pair{"cloud", cloud}})
    for (const char* forward : {"0.5", "0.6", "0.75", "0.85", "0.95"}) {
      auto scene = read_scene(name, text, {{"forward", forward}});
      if (!scene) return false;
      const compile::CompiledScene world = compile::compile(std::move(*scene));
      render::RenderOptions without;
      without.distant_guiding = false;
      const TwoCosts costs = alternated_costs(world, without, {}, 16, 1024);
      fmt::print("{:<16} {:12.3f} {:11.4f} {:12.3f} {:11.4f} {:8.2f}\n",
                 fmt::format("{}, hg({})", name, forward), costs.first.seconds, costs.first.relmse,
                 costs.second.seconds, costs.second.relmse, costs.gain());
    }
  return true;
}

}  // namespace tyndall
