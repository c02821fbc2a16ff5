// What denoising makes of the gallery: error before and after, at few samples and at many.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench.h"
#include "denoise/denoise.h"
#include "image/compare.h"
#include "scene_file.h"

namespace tyndall {

namespace {

constexpr std::array samples_of_columns{16, 64, 256};
constexpr int reference_samples = 1024;
using Gains = std::array<double, samples_of_columns.size()>;

// By how much denoising divides the error of each column, printed with the errors.
Gains print_row(const compile::CompiledScene& world) {
  render::RenderOptions options;
  for (const std::string_view name : denoise::outputs) options.aovs.add(render::aov_of_name(name).value());
  render::RenderOptions far = options;
  far.first_sample = 1 << 16;
  far.sample_count = reference_samples;
  const image::Image reference = picture_of(render::render(world, far).film.image());
  Gains gains{};
  for (std::size_t i = 0; i < samples_of_columns.size(); ++i) {
    options.sample_count = samples_of_columns[i];
    const image::Image image = render::render(world, options).film.image();
    const double before = image::compare(picture_of(image), reference).relative_mse,
                 after = image::compare(denoise::denoise(image).picture, reference).relative_mse;
    gains[i] = before / after;
    fmt::print(" {:>10.3g} {:>9.3g} {:>5.1f}", before, after, gains[i]);
    std::fflush(stdout);
  }
  fmt::print("\n");
  return gains;
}

}  // namespace

bool bench_denoise(std::string_view part) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(TYNDALL_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".tyn" && entry.path().stem().string().find(part) != std::string::npos)
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  fmt::print("relmse before and after, against {} samples, and their ratio\n{:<20}", reference_samples, "");
  for (const int samples : samples_of_columns) fmt::print(" {:>18} samples", samples);
  fmt::print("\n");
  std::vector<Gains> rows;
  for (const std::filesystem::path& path : paths) {
    auto scene = load_scene(path.string());
    if (!scene) return false;
    scene->settings.resolution.width = 160;
    scene->settings.resolution.height = 90;
    fmt::print("{:<20}", path.stem().string());
    rows.push_back(print_row(compile::compile(std::move(*scene))));
  }
  if (rows.empty()) return true;
  fmt::print("{:<20}", "median");
  for (std::size_t i = 0; i < samples_of_columns.size(); ++i) {
    std::sort(rows.begin(), rows.end(), [i](const Gains& a, const Gains& b) { return a[i] < b[i]; });
    fmt::print(" {:>26.1f}", rows[rows.size() / 2][i]);
  }
  fmt::print("\n");
  return true;
}

}  // namespace tyndall
