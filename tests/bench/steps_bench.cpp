// The step that a scene has when it says nothing: how far off its picture is, what is told of that, and what
// it costs against steps that are given.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/numerics.h"
#include "bench.h"
#include "scene_file.h"

namespace tyndall {

namespace {

constexpr std::array stepped_scenes{"smoke-of-a-candle", "layered-fog", "sheet-in-haze", "cloud",
                                    "cumulus",           "speck",       "soot",          "fire",
                                    "atmosphere",        "lamp",        "placed-puffs",  "passing-cloud"};

// The mean of a picture, and what is known of it.
struct MeasuredMean {
  double mean = 0, error = 0;  // standard
  double segments = 0;         // a sample
  double told = 0;
};

// Of independent groups of samples, so that their spread tells the error.
MeasuredMean measured_mean(const compile::CompiledScene& world, int samples,
                           const render::RenderOptions& how = {}) {
  constexpr int groups = 16;
  MeasuredMean out;
  double squares = 0;
  for (int g = 0; g < groups; ++g) {
    render::RenderOptions options = how;
    options.first_sample = g * samples;
    options.sample_count = samples / groups;
    const render::RenderResult result = render::render(world, options);
    const auto [width, height] = world.scene.settings.resolution;
    double mean = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Rgb light = result.film.mean(x, y);
        mean += (double{light.x} + double{light.y} + double{light.z}) / 3;
      }
    mean /= static_cast<double>(width) * height;
    out.mean += mean / groups;
    squares += mean * mean / groups;
    out.segments += static_cast<double>(result.statistics.segments) /
                    static_cast<double>(result.statistics.samples) / groups;
    out.told = result.statistics.step_bias.share;
  }
  out.error = safe_sqrt((squares - out.mean * out.mean) / (groups - 1));
  return out;
}

MeasuredMean measured_at(scene::Scene scene, const scene::Step& step, int samples) {
  scene.settings.step = step;
  return measured_mean(compile::compile(std::move(scene)), samples);
}

// Without the bias of any step: where steps change from cell to cell, by tracking; else at a sixteenth of the
// step, which has less noise.
MeasuredMean measured_truth(const scene::Scene& scene, const compile::CompiledScene& world, double metres) {
  const int samples = scene.settings.samples;
  const bool graded = std::any_of(world.volumes.begin(), world.volumes.end(),
                                  [](const compile::CompiledVolume& v) { return v.most_spread > 0; });
  if (!graded) return measured_at(scene, metres / 16, samples);
  render::RenderOptions tracking;
  tracking.method = render::Method::tracking;
  tracking.transmittance = render::Transmittance::ratio;
  return measured_mean(world, samples, tracking);
}

double default_metres(const compile::CompiledScene& world) {
  double least = infinity;
  for (const compile::CompiledVolume& volume : world.volumes)
    if (volume.grid != compile::no_index) least = std::min(least, volume.step.metres);
  return least;
}

bool print_row(const std::string& name) {
  const auto scene = load_scene(fmt::format("{}/tests/bench/steps/{}.tyn", TYNDALL_SOURCE_DIR, name));
  if (!scene) return false;
  const int samples = scene->settings.samples;
  const compile::CompiledScene world = compile::compile(*scene);
  const double metres = default_metres(world);
  const MeasuredMean truth = measured_truth(*scene, world, metres), usual = measured_mean(world, samples);
  fmt::print("| {} | {:.3g} | {:+.2f} ± {:.2f} | {:.2f} | {:.3g} |", name, metres,
             100 * (usual.mean / truth.mean - 1), 100 * std::hypot(usual.error, truth.error) / truth.mean,
             100 * usual.told, usual.segments);
  // Given steps, coarser and coarser.
  for (const double factor : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    const MeasuredMean given = measured_at(*scene, metres * factor, samples);
    fmt::print(" {:+.2f} ({:.2f}), {:.2g} |", 100 * (given.mean / truth.mean - 1), 100 * given.told,
               usual.segments / given.segments);
    std::fflush(stdout);
  }
  const MeasuredMean proven = measured_at(*scene, scene::Step::proven_within(0.01), samples / 4);
  fmt::print(" {:.2g} |\n", proven.segments / usual.segments);
  return true;
}

}  // namespace

bool bench_default_steps(std::string_view part) {
  fmt::print(
      "| scene | default [m] | bias % | told | segments a sample | ½ of it: bias (told), default's cost | "
      "the same | × 2 | × 4 | × 8 | `auto(1%)`: × the segments |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  bool good = true;
  for (const std::string name : stepped_scenes)
    if (name.find(part) != std::string::npos) good &= print_row(name);
  return good;
}

}  // namespace tyndall
