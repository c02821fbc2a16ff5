// Hair that lets light through, in smoke: one march with all crossings in its distance pdf against stopping
// or going on at each hair by chance.
#include <fmt/format.h>

#include <string>

#include "bench.h"
#include "scene_file.h"

namespace tyndall {

namespace {

// 100,000 hairs: 100 placements of a tuft of 1,000.
constexpr const char* hairs_in_smoke = R"(
let cover = 1
render { resolution: (64, 36)  samples: 4  bounces: 4 }
camera perspective { from: (0, 1.3, 3.4)  to: (0, 0.55, 0)  fov: 40deg }
object tuft {
  for i in 0..<1000 {
    let turn = 360deg * random(i, 1)
    let out = 0.05 + 0.3 * random(i, 2)
    let side = (cos(turn), 0, sin(turn))
    curves {
      points: [0.03 * side, (0, 0.5 * random(i, 3), 0) + 0.4 * out * side, (0, 0.2 + 0.5 * random(i, 4), 0) + out * side]
      radius: [1.5mm, 0.5mm]
    }
  }
}
material hair() { base_color = (0.6, 0.4, 0.2)  opacity = cover }
for i in 0..<100 {
  place tuft { transform: translate((mod(i, 10) * 0.25 - 1.1, 0, floor(i / 10) * 0.25 - 1.5))  material: hair }
}
volume { in: box { min: (-2, 0, -2)  max: (2, 1.6, 2.5) }  medium: { density = 0.35  albedo = 0.95  phase = hg(0.5) } }
light sphere { center: (1.5, 2.4, 0.5)  radius: 0.1  power: 300 }
light environment { radiance: 0.1 }
)";

}  // namespace

bool bench_hair() {
  fmt::print("100,000 hairs in smoke, 64x36\n{:<10} {:>26} {:>26} {:>10}\n", "opacity",
             "by chance: seconds, relMSE", "in the pdf: both", "gain");
  for (const char* cover : {"1", "0.6", "0.2"}) {
    std::optional<scene::Scene> scene = read_scene("hairs", hairs_in_smoke, {{"cover", cover}});
    if (!scene) return false;
    const compile::CompiledScene world = compile::compile(std::move(*scene));
    render::RenderOptions by_chance, in_pdf;
    by_chance.method = render::Method::tracking;
    const TwoCosts costs = alternated_costs(world, by_chance, in_pdf, 4, 128);
    fmt::print("{:<10} {:14.3f} {:11.4f} {:14.3f} {:11.4f} {:10.2f}\n", cover, costs.first.seconds,
               costs.first.relmse, costs.second.seconds, costs.second.relmse, costs.gain());
  }
  return true;
}

}  // namespace tyndall
