// What many lights cost: the same lamps' power from ten and from a thousand, to the same error.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bench.h"
#include "scene_file.h"

namespace tyndall {

namespace {

// Lamps over a field in mist, as bright together whatever their number.
constexpr const char* field = R"(
let count = 10
render { resolution: (160, 90)  samples: 16  bounces: 2 }
camera perspective { from: (0, 3, 14)  to: (0, 1, 0)  fov: 55deg }
plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.3 } }
volume {
  in: box { min: (-30, 0, -40)  max: (30, 6, 20) }
  medium: { density = 1  scattering = 0.03  absorption = 0.002  phase = hg(0.4) }
}
for i in 0..<count {
  light point {
    position: (-20 + 40 * random(i, 1), 0.5 + 2.5 * random(i, 2), -30 + 38 * random(i, 3))
    power: (300, 180, 90) * 10 / count
  }
}
)";
constexpr double most_times_of_ten = 3;  // a thousand lights against ten, at equal error

}  // namespace

bool bench_lights() {
  constexpr std::array counts{10, 100, 1000};
  std::vector<compile::CompiledScene> worlds;
  std::vector<image::Image> references;
  for (const int count : counts) {
    auto scene = read_scene("field", field, {{"count", std::to_string(count)}});
    if (!scene) return false;
    worlds.push_back(compile::compile(std::move(*scene)));
    render::RenderOptions options;
    options.first_sample = 1 << 16;
    options.sample_count = 1024;
    references.push_back(render::render(worlds.back(), options).film.image());
  }
  std::array<std::vector<double>, counts.size()> products, seconds;
  for (int round = 0; round < 5; ++round)  // alternated
    for (std::size_t i = 0; i < counts.size(); ++i) {
      render::RenderOptions options;
      options.first_sample = 16 * round;
      options.sample_count = 16;
      const PictureCost cost = cost_of(worlds[i], options, references[i]);
      products[i].push_back(cost.product());
      seconds[i].push_back(cost.seconds);
    }
  fmt::print("lights   seconds   seconds x relMSE   against {} (medians of 5, 16 samples at 160x90)\n",
             counts[0]);
  bool good = true;
  double first = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto median = [](std::vector<double>& v) {
      std::sort(v.begin(), v.end());
      return v[v.size() / 2];
    };
    const double product = median(products[i]);
    if (i == 0) first = product;
    good &= product <= most_times_of_ten * first;
    fmt::print("{:<8} {:7.2f} {:18.4f} {:9.2f}\n", counts[i], median(seconds[i]), product, product / first);
  }
  return good;
}

}  // namespace tyndall
