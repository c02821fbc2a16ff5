// The numbers and pictures of docs/sampling.md: distance strategies, bounces, march against jackknife.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "bench.h"
#include "image/compare.h"
#include "scene_file.h"

namespace tyndall {

namespace {

using render::Transmittance;

// A small room of fog over a floor, with one lamp of three kinds and fog of two.
constexpr const char* room = R"(
let lamp = 0
let heterogeneous = false
let bounces = 0
let width = 48
let height = 27
render { resolution: (width, height)  samples: 16  bounces: bounces  step: 0.1 }
camera perspective { from: (0, 1.1, 5)  to: (0, 1, 0)  fov: 36deg }
plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.4 } }
medium homogeneous() { density = 0.2  albedo = 0.95  phase = hg(0.3) }
medium lumps() { density = 0.6 * smoothstep(0, 0.4, noise(p * 1.2))  albedo = 0.95  phase = hg(0.3) }
volume { in: box { min: (-3, 0, -3)  max: (3, 3, 3) }  medium: if heterogeneous then lumps else homogeneous }
if lamp == 0 { light point { position: (0.4, 1.3, 0)  power: 40 } }
if lamp == 1 { light sphere { center: (0.4, 1.3, 0)  radius: 0.15  power: 40 } }
if lamp == 2 { light quad { center: (0.4, 1.9, 0)  u: (0.4, 0, 0)  v: (0, 0, 0.4)  power: 40 } }
)";
constexpr std::array lamps{"point", "sphere", "quad"};

using Overrides = std::vector<std::pair<std::string, std::string>>;
std::optional<compile::CompiledScene> compiled(const std::string& name, const char* text,
                                               Overrides overrides) {
  auto scene = read_scene(name, text, std::move(overrides));
  if (!scene) return std::nullopt;
  return compile::compile(std::move(*scene));
}
Overrides overrides(int lamp, bool heterogeneous, int bounces) {
  return {{"lamp", std::to_string(lamp)},
          {"heterogeneous", heterogeneous ? "true" : "false"},
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

constexpr std::array sample_counts{16, 64, 256};
constexpr std::size_t strategies = render::distance_infos.size();

// What a strategy costs in one round: CPU seconds, which other programs change less than time does.
PictureCost cpu_cost(const compile::CompiledScene& world, std::size_t strategy, int first, int count,
                     const image::Image& truth) {
  render::RenderOptions options;
  options.distance = render::distance_infos[strategy].distance;
  options.first_sample = first;
  options.sample_count = count;
  const std::clock_t before = std::clock();
  const render::RenderResult result = render::render(world, options);
  const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  return {seconds, image::compare(result.film.image(), truth).relative_mse};
}

void print_distance_row(const compile::CompiledScene& world, const image::Image& truth, int samples,
                        const std::string& name) {
  std::array<std::vector<double>, strategies> costs, errors, seconds;
  for (int round = 0; round < 5; ++round)  // alternated
    for (std::size_t i = 0; i < strategies; ++i) {
      const PictureCost cost = cpu_cost(world, i, samples * round, samples, truth);
      errors[i].push_back(cost.relmse);
      seconds[i].push_back(cost.seconds);
    }
  fmt::print("| {} | {} |", name, samples);
  for (std::size_t i = 0; i < strategies; ++i)
    fmt::print(" {:.3g} |", 1 / (median(errors[i]) * median(seconds[i])));
  const std::size_t last = strategies - 1;
  fmt::print(" {:.2g} | {:.2f} |\n", median(errors[last]) * samples,
             median(seconds[last]) / median(seconds[0]));
  std::fflush(stdout);
}

// Rows whose names have `part` in them.
bool print_distances(std::string_view part) {
  fmt::print(
      "Efficiency, 1/(relMSE x CPU seconds), medians of 5 at 48x27; of the last strategy, relMSE x samples "
      "and CPU seconds over those of the first\n\n| lamp, fog | bounces | samples |");
  for (const render::DistanceInfo& mixture : render::distance_infos) fmt::print(" {} |", mixture.name);
  fmt::print(" relMSE x samples | time |\n|");
  for (std::size_t i = 0; i < strategies + 5; ++i) fmt::print(" --- |");
  fmt::print("\n");
  for (const int bounces : {0, 1, 2, 12})
    for (int lamp = 0; lamp < 3; ++lamp)
      for (const bool heterogeneous : {false, true}) {
        const std::string name = fmt::format("{}, {} | {}", lamps[static_cast<std::size_t>(lamp)],
                                             heterogeneous ? "heterogeneous" : "homogeneous", bounces);
        if (name.find(part) == std::string::npos) continue;
        const auto world = compiled("room", room, overrides(lamp, heterogeneous, bounces));
        if (!world) return false;
        const image::Image truth = reference(*world, bounces == 0 ? 16384 : 4096);
        for (const int samples : sample_counts) print_distance_row(*world, truth, samples, name);
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

bool bench_sampling(std::string_view part) { return print_distances(part); }
bool bench_steps() { return print_transmittance(); }

// Each lamp in each fog by the four strategies, and one room at 0, 1, 2 and 12 bounces.
bool write_sampling_pictures() {
  const auto sized = [](Overrides overrides) {
    overrides.insert(overrides.end(), {{"width", "320"}, {"height", "180"}});
    return overrides;
  };
  for (int lamp = 0; lamp < 3; ++lamp)
    for (const bool heterogeneous : {false, true}) {
      const auto world = compiled("room", room, sized(overrides(lamp, heterogeneous, 0)));
      if (!world) return false;
      std::vector<image::Image> pictures;
      for (const render::DistanceInfo& mixture : render::distance_infos) {
        render::RenderOptions options;
        options.distance = mixture.distance;
        pictures.push_back(render::render(*world, options).film.image());
      }
      const std::string name = fmt::format("sampling-{}-{}", lamps[static_cast<std::size_t>(lamp)],
                                           heterogeneous ? "heterogeneous" : "homogeneous");
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
