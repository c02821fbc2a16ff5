// The numbers and pictures of docs/sampling.md: distance strategies, bounces, march against jackknife.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "bench.h"
#include "image/compare.h"
#include "scene_file.h"

namespace tyndall {

namespace {

using render::Distance, render::Transmittance;

// A small room of fog over a floor, with one lamp of three kinds and fog of two.
constexpr const char* room = R"(
let lamp = 0
let uneven = false
let bounces = 0
let width = 48
let height = 27
render { resolution: (width, height)  samples: 16  bounces: bounces  step: 0.1 }
camera perspective { from: (0, 1.1, 5)  to: (0, 1, 0)  fov: 36deg }
plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.4 } }
medium even() { density = 0.2  albedo = 0.95  phase = hg(0.3) }
medium lumps() { density = 0.6 * smoothstep(0, 0.4, noise(p * 1.2))  albedo = 0.95  phase = hg(0.3) }
volume { in: box { min: (-3, 0, -3)  max: (3, 3, 3) }  medium: if uneven then lumps else even }
if lamp == 0 { light point { position: (0.4, 1.3, 0)  power: 40 } }
if lamp == 1 { light sphere { center: (0.4, 1.3, 0)  radius: 0.15  power: 40 } }
if lamp == 2 { light quad { center: (0.4, 1.9, 0)  u: (0.4, 0, 0)  v: (0, 0, 0.4)  power: 40 } }
)";
constexpr std::array lamps{"point", "sphere", "quad"};
constexpr std::array distances{Distance::density, Distance::equiangular, Distance::mis, Distance::product};

using Overrides = std::vector<std::pair<std::string, std::string>>;
std::optional<compile::CompiledScene> compiled(const std::string& name, const char* text,
                                               Overrides overrides) {
  auto scene = read_scene(name, text, std::move(overrides));
  if (!scene) return std::nullopt;
  return compile::compile(std::move(*scene));
}
Overrides overrides(int lamp, bool uneven, int bounces) {
  return {{"lamp", std::to_string(lamp)},
          {"uneven", uneven ? "true" : "false"},
          {"bounces", std::to_string(bounces)}};
}

double median(std::vector<double>& v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

// Far from the samples that are measured.
image::Image reference(const compile::CompiledScene& world, int samples,
                       const render::RenderOptions& how = {}) {
  render::RenderOptions options = how;
  options.first_sample = 1 << 16;
  options.sample_count = samples;
  return render::render(world, options).film.image();
}

bool print_distances() {
  fmt::print(
      "Efficiency, 1/(relMSE x seconds), medians of 5 at 48x27 with 16 samples\n\n"
      "| lamp, fog | bounces | density | equi-angular | mis | product |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (const int bounces : {0, 1, 2, 12})
    for (int lamp = 0; lamp < 3; ++lamp)
      for (const bool uneven : {false, true}) {
        const auto world = compiled("room", room, overrides(lamp, uneven, bounces));
        if (!world) return false;
        const image::Image truth = reference(*world, bounces == 0 ? 1024 : 4096);
        std::array<std::vector<double>, distances.size()> efficiencies;
        for (int round = 0; round < 5; ++round)  // alternated
          for (std::size_t i = 0; i < distances.size(); ++i) {
            render::RenderOptions options;
            options.distance = distances[i];
            options.first_sample = 16 * round;
            options.sample_count = 16;
            efficiencies[i].push_back(1 / cost_of(*world, options, truth).product());
          }
        fmt::print("| {}, {} | {} |", lamps[static_cast<std::size_t>(lamp)], uneven ? "uneven" : "even",
                   bounces);
        for (auto& row : efficiencies) fmt::print(" {:.3g} |", median(row));
        fmt::print("\n");
        std::fflush(stdout);
      }
  return true;
}

// A cloud under a sun and a sky, scattered once: all that the step and the way to the sun change.
constexpr const char* cloud = R"(
render { resolution: (96, 54)  samples: 64  bounces: 0 }
let length_of_step = 0.1
camera perspective { from: (0, 0.3, 5)  to: (0, 0, 0)  fov: 32deg }
volume {
  in: box { min: (-2, -1.2, -1.2)  max: (2, 1.2, 1.2) }
  step: length_of_step
  medium: {
    density = 8 * smoothstep(0.2, 0.6, 1 - length(p * (0.6, 1, 1)) + 0.5 * fbm(p * 2, octaves: 5))
    albedo  = 0.9
    phase   = hg(0.4)
  }
}
light distant { direction: (-0.6, -1, -0.4)  irradiance: 4 }
light environment { radiance: 0.1 }
)";

bool print_transmittance() {
  fmt::print(
      "\nMarch against jackknife on a cloud, medians of 5 at 96x54 with 64 samples against 1024 of `series` "
      "at a "
      "step of 0.01\n\n"
      "| step | way | seconds | relMSE | bias of the mean |\n| --- | --- | --- | --- | --- |\n");
  const auto fine = compiled("cloud", cloud, {{"length_of_step", "0.01"}});
  if (!fine) return false;
  render::RenderOptions unbiased;
  unbiased.transmittance = Transmittance::series;
  const image::Image truth = reference(*fine, 1024, unbiased);
  constexpr std::array ways{std::pair{"march", Transmittance::march},
                            std::pair{"jackknife", Transmittance::jackknife}};
  for (const char* step : {"0.4", "0.2", "0.1", "0.05", "0.025", "0.01"}) {
    const auto world = compiled("cloud", cloud, {{"length_of_step", step}});
    if (!world) return false;
    reference(*world, 1);  // makes the bounds, which both use
    std::array<std::vector<double>, ways.size()> seconds, errors, brightness;
    for (int round = 0; round < 5; ++round)  // alternated
      for (std::size_t i = 0; i < ways.size(); ++i) {
        render::RenderOptions options;
        options.transmittance = ways[i].second;
        options.first_sample = 64 * round;
        options.sample_count = 64;
        const render::RenderResult result = render::render(*world, options);
        const image::Comparison c = image::compare(result.film.image(), truth);
        seconds[i].push_back(result.statistics.seconds);
        errors[i].push_back(c.relative_mse);
        brightness[i].push_back(c.mean / c.reference_mean);
      }
    for (std::size_t i = 0; i < ways.size(); ++i)
      fmt::print("| {} | {} | {:.2f} | {:.2g} | {:+.2f} % |\n", step, ways[i].first, median(seconds[i]),
                 median(errors[i]), 100 * (median(brightness[i]) - 1));
    std::fflush(stdout);
  }
  return true;
}

// Pictures of one size, in rows.
image::Image mosaic(const std::vector<image::Image>& pictures, int columns) {
  constexpr int gap = 4;
  const int width = pictures[0].width, height = pictures[0].height;
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  image::Image out{columns * (width + gap) - gap, rows * (height + gap) - gap, {"R", "G", "B"}, {}};
  out.pixels.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) * 3, 1.0f);
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          out.at(i % columns * (width + gap) + x, i / columns * (height + gap) + y, c) =
              pictures[static_cast<std::size_t>(i)].at(x, y, c);
  return out;
}

bool write_picture(const std::string& name, const std::vector<image::Image>& pictures, int columns) {
  const std::string path = fmt::format("{}/docs/images/{}.png", TYNDALL_SOURCE_DIR, name);
  const std::string problem = image::write(path, mosaic(pictures, columns), {});
  if (!problem.empty()) fmt::print(stderr, "{}\n", problem);
  return problem.empty();
}

}  // namespace

bool bench_sampling() { return print_distances(); }
bool bench_steps() { return print_transmittance(); }

// Each lamp in each fog by the four strategies, and one room at 0, 1, 2 and 12 bounces.
bool write_sampling_pictures() {
  const auto sized = [](Overrides overrides) {
    overrides.insert(overrides.end(), {{"width", "320"}, {"height", "180"}});
    return overrides;
  };
  for (int lamp = 0; lamp < 3; ++lamp)
    for (const bool uneven : {false, true}) {
      const auto world = compiled("room", room, sized(overrides(lamp, uneven, 0)));
      if (!world) return false;
      std::vector<image::Image> pictures;
      for (const Distance distance : distances) {
        render::RenderOptions options;
        options.distance = distance;
        pictures.push_back(render::render(*world, options).film.image());
      }
      const std::string name =
          fmt::format("sampling-{}-{}", lamps[static_cast<std::size_t>(lamp)], uneven ? "uneven" : "even");
      if (!write_picture(name, pictures, 2)) return false;
    }
  std::vector<image::Image> pictures;
  for (const int bounces : {0, 1, 2, 12}) {
    const auto world = compiled("room", room, sized(overrides(1, true, bounces)));
    if (!world) return false;
    render::RenderOptions options;
    options.sample_count = 64;
    pictures.push_back(render::render(*world, options).film.image());
  }
  return write_picture("sampling-bounces", pictures, 2);
}

}  // namespace tyndall
