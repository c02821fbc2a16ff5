// Outlying pixels: their share in each scene of the gallery and in scenes that are prone to them, and the
// kinds of path that the heaviest samples of these pixels have.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench.h"
#include "image/image.h"
#include "image/outliers.h"
#include "scene_file.h"

namespace tyndall {

namespace {

constexpr int samples = 16;
constexpr std::size_t replayed_pixels = 24;

// The heaviest contribution in the trace of a sample: through which vertices it came, and by what.
struct Heaviest {
  std::string kind;
  double light = 0;
};
class TraceReader {
 public:
  Heaviest read(const std::string& trace) {
    std::string_view rest = trace;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      line(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return heaviest_;
  }

 private:
  static std::string_view after(std::string_view text, std::string_view word) {
    const std::size_t at = text.find(word);
    return at == std::string_view::npos ? std::string_view{} : text.substr(at + word.size());
  }
  void line(std::string_view text) {
    if (text.starts_with("  + (")) {
      light(text);
    } else if (const std::string_view at = after(text, "depth "); !at.empty()) {
      branch_ = text.substr(0, text.find("depth "));
      depth_ = std::atoi(at.data());
      const std::string_view from = after(text, "ray from ");
      kinds_[{std::string(branch_), depth_}] = std::string(from.substr(0, from.find(" (")));
    }
  }
  void light(std::string_view text) {
    double r = 0, g = 0, b = 0;
    if (std::sscanf(std::string(text).c_str(), "  + (%lf, %lf, %lf)", &r, &g, &b) != 3) return;
    const double light = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    if (light <= heaviest_.light) return;
    std::string_view what = after(text, ") ");
    std::string branch(branch_);
    int depth = depth_;
    if (what.starts_with("direct light, ")) {
      const std::string_view place = after(what, ", ");
      branch = place.substr(0, place.find("depth "));
      depth = std::atoi(after(place, "depth ").data());
      what = place.ends_with("surface") ? "direct light on a surface" : "direct light in a medium";
    }
    heaviest_ = {path_to(branch, depth) + std::string(what), light};
  }
  std::string path_to(const std::string& branch, int depth) const {
    std::string out = branch;
    for (int k = 1; k <= depth; ++k) {
      auto found = kinds_.find({branch, k});
      if (found == kinds_.end()) found = kinds_.find({branch.starts_with("behind") ? "behind: " : "", k});
      out += (found == kinds_.end() ? "?" : found->second) + ", ";
    }
    return out;
  }

  std::map<std::pair<std::string, int>, std::string> kinds_;
  Heaviest heaviest_;
  std::string_view branch_;
  int depth_ = 0;
};

struct Kind {
  int count = 0;
  double share = 0, times = 0;
};

void print_kinds(const compile::CompiledScene& world, const image::Image& picture,
                 const std::vector<image::Outlier>& list) {
  std::map<std::string, Kind> kinds;
  for (std::size_t i = 0; i < std::min(list.size(), replayed_pixels); ++i) {
    render::Replay worst;
    double most = 0;
    for (std::uint64_t s = 0; s < samples; ++s) {
      render::Replay replay = render::replay(world, {}, list[i].x, list[i].y, s);
      if (luminance(replay.radiance) > most) most = luminance(replay.radiance), worst = std::move(replay);
    }
    const Heaviest heaviest = TraceReader().read(worst.trace);
    Kind& kind = kinds[heaviest.kind];
    ++kind.count;
    kind.share += heaviest.light / most;
    const Rgb pixel{picture.at(list[i].x, list[i].y, 0), picture.at(list[i].x, list[i].y, 1),
                    picture.at(list[i].x, list[i].y, 2)};
    kind.times += most / (samples * static_cast<double>(luminance(pixel)));
  }
  std::vector<std::pair<std::string, Kind>> sorted(kinds.begin(), kinds.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second.count > b.second.count; });
  for (const auto& [name, kind] : sorted)
    fmt::print("    {:>3} x {} ({:.0f} % of the sample, which is {:.0f} % of the pixel)\n", kind.count, name,
               100 * kind.share / kind.count, 100 * kind.times / kind.count);
}

bool print_scene(const std::filesystem::path& path, bool with_kinds) {
  auto scene = load_scene(path);
  if (!scene) return false;
  scene->settings.resolution.width = 160;
  scene->settings.resolution.height = 90;
  const compile::CompiledScene world = compile::compile(std::move(*scene));
  render::RenderOptions options;
  options.sample_count = samples;
  const render::RenderResult result = render::render(world, options);
  const image::Image picture = result.film.image();
  const std::vector<image::Outlier> list = image::outliers(picture);
  fmt::print("{:<24} {:8.2f} {:8.3f} {:12}\n", path.stem().string(),
             100.0 * static_cast<double>(list.size()) / (160 * 90), result.statistics.seconds,
             result.statistics.rays + result.statistics.shadow_rays);
  if (with_kinds) print_kinds(world, picture, list);
  std::fflush(stdout);
  return true;
}

}  // namespace

bool bench_pepper(std::string_view part) {
  fmt::print("{:<24} {:>8} {:>8} {:>12}\n", "160x90, 16 samples", "outliers", "seconds", "rays");
  std::vector<std::filesystem::path> paths;
  for (const char* folder : {"scenes", "tests/bench/pepper"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(TYNDALL_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".tyn" && entry.path().string().find(part) != std::string::npos)
        paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths)
    if (!print_scene(path, !part.empty())) return false;
  return true;
}

}  // namespace tyndall
