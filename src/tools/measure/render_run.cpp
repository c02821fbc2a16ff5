#include "tools/measure/render_run.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstring>

#include "compile/compiled_scene.h"
#include "tools/measure/measured_child.h"
#include "tools/render_frame.h"
#include "tools/scene_features.h"

namespace tyndall::tools {
namespace {

double cpu_seconds_so_far() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string rendered_bytes(scene::Scene scene, const RenderArguments& arguments, std::uint64_t seed) {
  apply(arguments.settings, scene.settings);
  scene.settings.seed = seed;
  const compile::CompiledScene world = compile::compile(std::move(scene));
  const double preparation = cpu_seconds_so_far();
  const render::RenderResult result = render::render(world, render_options_of(arguments));
  const auto [width, height] = world.scene.settings.resolution;
  std::vector<float> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb light = result.film.mean(x, y);
      pixels.insert(pixels.end(), {light.x, light.y, light.z});
    }
  std::string bytes(sizeof preparation + pixels.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), &preparation, sizeof preparation);
  std::memcpy(bytes.data() + sizeof preparation, pixels.data(), pixels.size() * sizeof(float));
  return bytes;
}

}  // namespace

RenderRun render_run(const scene::Scene& scene, const RenderArguments& arguments, std::uint64_t seed,
                     const std::atomic<bool>& stop) {
  const ChildResult child = in_child([&] { return rendered_bytes(scene, arguments, seed); }, stop);
  RenderRun run;
  run.stopped = child.stopped;
  run.problem = child.problem;
  if (!run.problem.empty() || run.stopped) return run;
  double preparation = 0;
  std::memcpy(&preparation, child.bytes.data(), sizeof preparation);
  run.cost = {child.cost.wall_seconds, child.cost.cpu_seconds, preparation, child.cost.peak_bytes};
  run.pixels.resize((child.bytes.size() - sizeof preparation) / sizeof(float));
  std::memcpy(run.pixels.data(), child.bytes.data() + sizeof preparation, run.pixels.size() * sizeof(float));
  return run;
}

std::vector<std::pair<std::string, bool>> features_of(const scene::Scene& scene) {
  const std::atomic<bool> never{false};
  const ChildResult child = in_child(
      [&] {
        std::string lines;
        for (const auto& [name, used] : scene_features(compile::compile(scene::Scene(scene))))
          lines += fmt::format("{}{}\n", used ? '+' : '-', name);
        return lines;
      },
      never);
  std::vector<std::pair<std::string, bool>> features;
  for (std::size_t at = 0, end = 0; (end = child.bytes.find('\n', at)) != std::string::npos; at = end + 1)
    features.emplace_back(child.bytes.substr(at + 1, end - at - 1), child.bytes[at] == '+');
  return features;
}

}  // namespace tyndall::tools
