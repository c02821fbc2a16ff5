// docs/quality.md: the pictures that the gallery's scenes give without any thought, with a clamp, and
// denoised.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bench.h"
#include "denoise/denoise.h"
#include "image/compare.h"
#include "image/outliers.h"
#include "measured_child.h"
#include "scene_file.h"

namespace tyndall {

namespace {

constexpr int width = 96, height = 54;
constexpr int reference_samples = 256;
constexpr double clamp_factor = 10;

constexpr std::string_view introduction = R"(# Quality

This page shows what the scenes of `scenes/`, and four that are prone to outlying pixels (`tests/bench/pepper`), give with the settings that they state and the defaults elsewhere, at {}x{} pixels, and what
a clamp and denoising make of it. `scripts/bench quality > docs/quality.md` makes it.

| column | is |
| --- | --- |
| samples | per pixel, as the scene states them |
| time | CPU seconds, and the factor by which the clamp or denoising (with the outputs that it reads) changes them |
| relMSE | mean squared relative error against {} other samples per pixel, as `tyndall compare` tells it. It holds the noise of that reference too: samples/{} of the noise |
| step bias | the estimate that the last line of a render tells, in % of the picture's mean; – where nothing is marched through |
| outliers | share of pixels whose displayed luminance is more than 50/255 above the median of the eight around them [%] |
| taken | light that the clamp removed [%] |

The clamp is {:.0f} times the mean of the picture, for direct and indirect light each. The error of a clamped picture has the light that is
missing in it; it can therefore be greater than without.

| scene | samples | time | relMSE | step bias | outliers | clamp: time | relMSE | outliers | taken | denoised: time | relMSE | outliers |
| --- | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: |
)";

// A picture and what it cost.
struct Made {
  image::Image picture;
  render::Statistics statistics;
  double cpu = 0;
};

Made made(const compile::CompiledScene& world, const render::RenderOptions& options, bool denoised) {
  const double before = cpu_seconds();
  const render::RenderResult result = render::render(world, options);
  const image::Image image = result.film.image();
  Made out{denoised ? denoise::denoise(image).picture : picture_of(image), result.statistics};
  out.cpu = cpu_seconds() - before;
  return out;
}

double outlier_percent(const image::Image& picture) { return 100 * image::share_of_outliers(picture); }

bool print_scene_row(const std::filesystem::path& path) {
  auto scene = load_scene(path.string());
  if (!scene) return false;
  scene->settings.resolution = {width, height};
  const compile::CompiledScene world = compile::compile(*scene);
  render::RenderOptions far;
  far.first_sample = 1 << 16;
  far.sample_count = reference_samples;
  const image::Image reference = picture_of(render::render(world, far).film.image());

  const Made usual = made(world, {}, false);
  const image::Comparison error = image::compare(usual.picture, reference);
  const std::string bias = usual.statistics.segments > 0
                               ? fmt::format("{:.2g}", 100 * usual.statistics.step_bias.share)
                               : std::string("–");
  fmt::print("| {} | {} | {:.3g} | {:.2g} | {} | {:.2f} |", path.stem().string(), scene->settings.samples,
             usual.cpu, error.relative_mse, bias, outlier_percent(usual.picture));

  const double limit = clamp_factor * error.reference_mean;
  scene->settings.clamp = {limit, limit};
  const Made clamped = made(compile::compile(std::move(*scene)), {}, false);
  fmt::print(" × {:.2f} | {:.2g} | {:.2f} | {:.2g} |", clamped.cpu / usual.cpu,
             image::compare(clamped.picture, reference).relative_mse, outlier_percent(clamped.picture),
             100 * clamped.statistics.clamped_light.share());

  render::RenderOptions with_outputs;
  for (const std::string_view name : denoise::outputs)
    with_outputs.aovs.add(render::aov_of_name(name).value());
  const Made denoised = made(world, with_outputs, true);
  fmt::print(" × {:.2f} | {:.2g} | {:.2f} |\n", denoised.cpu / usual.cpu,
             image::compare(denoised.picture, reference).relative_mse, outlier_percent(denoised.picture));
  std::fflush(stdout);
  return true;
}

}  // namespace

bool bench_quality(std::string_view part) {
  std::vector<std::filesystem::path> paths;
  for (const char* folder : {"scenes", "tests/bench/pepper"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(TYNDALL_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".tyn" && entry.path().stem().string().find(part) != std::string::npos)
        paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  if (part.empty())
    fmt::print(introduction, width, height, reference_samples, reference_samples, clamp_factor);
  bool good = true;
  for (const std::filesystem::path& path : paths) good &= print_scene_row(path);
  return good;
}

}  // namespace tyndall
