#include "tools/render_checks.h"

#include <fmt/format.h>

#include <utility>

#include "image/files.h"
#include "image/image.h"
#include "tools/choices.h"
#include "tools/denoising.h"
#include "tools/part_facts.h"
#include "tools/picture_output.h"
#include "tools/report.h"

namespace tyndall::tools {

namespace {

// Statistics go into a file of their own kind, so that a slip of the pen cannot replace another; a device or
// pipe has whatever name it has.
std::string statistics_problem(const std::string& path) {
  if (!path.ends_with(".json") && image::appears_whole(path))
    return fmt::format("--stats wants a name that ends in .json, not '{}'", path);
  return image::check_file_writable(path);
}

}  // namespace

std::string usage_problem(const RenderArguments& arguments) {
  const std::string& output = arguments.output;
  if (!arguments.aovs.empty() && !arguments.pixel && !output.ends_with(".exr") && !is_part(output))
    return "--aov wants an .exr to write: other formats have no further channels";
  if (is_part(output) && (arguments.error || arguments.time_limit))
    return fmt::format("{} does not go with a part: '{}' has the same samples of all of its pixels",
                       arguments.error ? "--error" : "--time-limit", output);
  if (!arguments.movie.empty() && is_part(output))
    return fmt::format("--movie wants pictures, and '{}' is a part of one", output);
  if (!arguments.part_of.empty() && !is_part(output))
    return fmt::format("--part-of wants a part to write (-o OUT.tynpart), not '{}'", output);
  return {};
}

std::string output_problem(const RenderArguments& arguments, FilesInUse& files) {
  std::string problem = files.read(arguments.scene.path, "the scene");
  const auto check = [&problem](auto&& next) {
    if (problem.empty()) problem = next();
  };
  if (!arguments.output.empty()) {
    check([&] { return output_path_problem(arguments.output); });
    check([&] { return files.write(arguments.output, "-o"); });
    check([&] { return files.write(checkpoint_path(arguments.output), "the checkpoint of -o,"); });
  }
  if (!arguments.statistics_file.empty()) {
    check([&] { return statistics_problem(arguments.statistics_file); });
    check([&] { return files.write(arguments.statistics_file, "--stats"); });
  }
  return problem;
}

std::string picture_problem(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  const std::string size =
      fmt::format("a picture of {}x{}", settings.resolution.width, settings.resolution.height);
  if (const auto& crop = arguments.crop)
    if (crop->x1 > settings.resolution.width || crop->y1 > settings.resolution.height)
      return fmt::format("--crop {},{},{},{} reaches outside {}", crop->x0, crop->y0, crop->x1, crop->y1,
                         size);
  if (const auto& range = arguments.sample_range)
    if (const auto samples = arguments.settings.get(&scene::RenderSettings::samples);
        samples && range->last >= *samples)
      return fmt::format("--sample-range {}..{} reaches beyond the last sample of --samples {}, which is {}",
                         range->first, range->last, *samples, *samples - 1);
  if (const auto& pixel = arguments.pixel)
    if (pixel->x >= settings.resolution.width || pixel->y >= settings.resolution.height)
      return fmt::format("--pixel {},{} is outside {}", pixel->x, pixel->y, size);
  if (arguments.pixel && arguments.crop) {
    const auto& [pixel, crop] = std::pair(*arguments.pixel, *arguments.crop);
    if (pixel.x < crop.x0 || pixel.x >= crop.x1 || pixel.y < crop.y0 || pixel.y >= crop.y1)
      return fmt::format("--pixel {},{} is outside --crop {},{},{},{}", pixel.x, pixel.y, crop.x0, crop.y0,
                         crop.x1, crop.y1);
  }
  return {};
}

std::string scattering_problem(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  if (!settings.multiple_scattering.approximate || !render::by_ratio(arguments.transmittance)) return {};
  return fmt::format(
      "--transmittance {} does not go with `multiple_scattering: approximate`, which wants optical depths: "
      "use "
      "march, jackknife or series, or --multiple-scattering full",
      name(arguments.transmittance));
}

std::string denoising_problem(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  if (!arguments.denoise || arguments.error || arguments.time_limit || is_part(arguments.output)) return {};
  const auto& range = arguments.sample_range;
  const int samples =
      range ? range->last - range->first + 1
            : arguments.settings.get(&scene::RenderSettings::samples).value_or(settings.samples);
  if (samples >= least_samples_to_denoise) return {};
  return fmt::format("--denoise wants at least {} samples per pixel to tell noise from light, not {}",
                     least_samples_to_denoise, samples);
}

std::string settings_problem(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  std::string problem = picture_problem(arguments, settings);
  if (problem.empty()) problem = scattering_problem(arguments, settings);
  return problem.empty() ? denoising_problem(arguments, settings) : problem;
}

std::string what_is_ignored(const RenderArguments& arguments, const scene::RenderSettings& settings) {
  if (render::traits(arguments.method).many_light_samples || settings.light_samples <= 1) return {};
  return fmt::format(
      "light_samples {} has no effect with --method {}: only decoupled marching takes more than one light "
      "point for a segment of a path",
      settings.light_samples, name(arguments.method));
}

}  // namespace tyndall::tools
