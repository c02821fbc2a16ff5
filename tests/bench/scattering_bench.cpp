// What `multiple_scattering: approximate` costs and how far off it is, on media from thin smoke to a bright
// cloud.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "bench.h"
#include "image/compare.h"
#include "scene_file.h"

namespace tyndall {

namespace {

// A heap of cloud or smoke under sun and sky.
constexpr const char* heap = R"(
let thickness = 14
let whiteness = 0.999
let forward = 0.8
render { resolution: (48, 27)  samples: 16  step: 0.06  bounces: 1024 }
camera perspective { from: (0, 0.3, 5)  to: (0, 0, 0)  fov: 36deg }
volume {
  in: sphere { radius: 1.5 }
  medium: {
    let billow = fbm(p * 2.1, octaves: 5, seed: 3)
    density = thickness * smoothstep(1.1, 0.5, length(p * (0.8, 1.2, 1)) - 0.45 * billow)
    albedo  = whiteness
    phase   = hg(forward)
  }
}
light distant { direction: (-1, -0.8, -0.5)  irradiance: 3  angle: 0.53deg }
light environment { radiance: (0.12, 0.18, 0.3) }
)";

struct Heap {
  std::string name, thickness, whiteness, forward;
};

struct Variant {
  std::string name;
  int bounces;
  scene::MultipleScattering scattering;
};

std::vector<Variant> variants() {
  std::vector<Variant> list{{"full", 1024, {}}, {"bounces: 1", 1, {}}, {"bounces: 4", 4, {}}};
  for (const int real : {0, 1, 2, 4, 8}) {
    scene::ApproximateScattering a;
    a.real = real;
    list.push_back({fmt::format("approximate(real: {})", real), 1024, {a}});
  }
  return list;
}

}  // namespace

bool bench_scattering() {
  const std::vector<Heap> heaps{
      {"cloud", "14", "0.999", "0.8"}, {"white fog", "5", "0.98", "0.3"}, {"smoke", "8", "0.7", "0.3"}};
  fmt::print("{:<10} {:<22} {:>8} {:>12} {:>10} {:>16}\n", "medium", "multiple scattering", "seconds",
             "brightness", "off by", "noise² x seconds");
  for (const Heap& one : heaps) {
    auto scene = read_scene(
        "heap", heap, {{"thickness", one.thickness}, {"whiteness", one.whiteness}, {"forward", one.forward}});
    if (!scene) return false;
    image::Image truth;
    double full_cost = 0;
    for (const Variant& variant : variants()) {
      scene->settings.bounces = variant.bounces;
      scene->settings.multiple_scattering = variant.scattering;
      const compile::CompiledScene world = compile::compile(*scene);
      render::RenderOptions options;
      options.first_sample = 1 << 16;
      options.sample_count = 512;
      const image::Image converged = render::render(world, options).film.image();
      const bool full = truth.pixels.empty();
      if (full) truth = converged;
      options.first_sample = 0;
      options.sample_count = 16;
      const PictureCost cost = cost_of(world, options, converged);
      if (full) full_cost = cost.product();
      const image::Comparison against = image::compare(converged, truth);
      fmt::print("{:<10} {:<22} {:8.2f} {:11.1f}% {:9.1f}% {:8.4f} ({:.2f})\n", one.name, variant.name,
                 cost.seconds, 100 * against.mean / against.reference_mean,
                 100 * std::sqrt(against.relative_mse), cost.product(), cost.product() / full_cost);
    }
  }
  return true;
}

}  // namespace tyndall
