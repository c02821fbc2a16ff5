// What sampling fire as light saves: noise at equal time with and without it.
#include <fmt/format.h>

#include <string>

#include "bench.h"
#include "scene_file.h"

namespace tyndall {

namespace {

// A small bright fire that alone lights a large room.
constexpr const char* hearth = R"(
let smoke = 0
render { resolution: (64, 36)  samples: 16  step: 0.05  bounces: 3 }
camera perspective { from: (0, 1.6, 5.5)  to: (0, 1, 0)  fov: 60deg }
plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.5 } }
plane { point: (0, 3, 0)  normal: (0, -1, 0)  material: { base_color = 0.7 } }
plane { point: (0, 0, -3)  normal: (0, 0, 1)  material: { base_color = (0.7, 0.4, 0.3) } }
plane { point: (-4, 0, 0)  normal: (1, 0, 0)  material: { base_color = 0.6 } }
plane { point: (4, 0, 0)  normal: (-1, 0, 0)  material: { base_color = 0.6 } }
volume {
  in: box { min: (-0.3, 0, -0.3)  max: (0.3, 0.6, 0.3) }
  medium: {
    let heat = smoothstep(0.25, 0, length(p * (1, 0.5, 1) - (0, 0.12, 0)) + 0.08 * fbm(p * 8))
    density = heat
    absorption = 3
    scattering = 1
    emission = 800 * heat * blackbody(1300K + 700 * heat)
  }
}
if smoke > 0 {
  volume {
    in: box { min: (-4, 0, -3)  max: (4, 3, 6) }
    medium: { density = smoke  albedo = 0.9  phase = hg(0.5) }
  }
}
)";

struct Sample {
  std::string name;
  std::optional<scene::Scene> scene;
};

std::optional<scene::Scene> small_picture(const std::string& name) {
  auto scene = load_scene(std::string(TYNDALL_SOURCE_DIR "/scenes/") + name);
  if (!scene) return scene;
  scene->settings.resolution.width = 64;
  scene->settings.resolution.height = 36;
  return scene;
}

}  // namespace

bool bench_fire() {
  Sample samples[] = {{"hearth", read_scene("hearth", hearth)},
                      {"hearth in smoke", read_scene("hearth", hearth, {{"smoke", "0.08"}})},
                      {"campfire.tyn", small_picture("campfire.tyn")},
                      {"fireball.tyn", small_picture("fireball.tyn")}};
  fmt::print("{:<16} {:>22} {:>22} {:>10}\n", "", "met: seconds, relMSE", "sampled: both", "gain");
  for (Sample& sample : samples) {
    if (!sample.scene) return false;
    const compile::CompiledScene world = compile::compile(std::move(*sample.scene));
    render::RenderOptions met, drawn;
    met.emission_sampling = false;
    const TwoCosts costs = alternated_costs(world, met, drawn, 16, 512);
    fmt::print("{:<16} {:10.3f} {:11.4f} {:10.3f} {:11.4f} {:10.1f}\n", sample.name, costs.first.seconds,
               costs.first.relmse, costs.second.seconds, costs.second.relmse, costs.gain());
  }
  return true;
}

}  // namespace tyndall
