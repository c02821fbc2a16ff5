// The statistics of a run as JSON: `--stats` and `--json`.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tools/run_report.h"
#include "vm/run/machine.h"

namespace tyndall::tools {
namespace {

// Largest resident size of the program so far [bytes]. getrusage() would count what started it, too, from
// before it became this program.
std::uint64_t peak_memory() {
  constexpr std::string_view name = "VmHWM:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return 1024 * std::strtoull(line.c_str() + name.size(), nullptr, 10);
  return 0;
}

std::string_view kind_name(render::BadValue::Kind kind) {
  switch (kind) {
    case render::BadValue::Kind::undefined:
      return "undefined";
    case render::BadValue::Kind::below:
      return "below";
    case render::BadValue::Kind::above:
      return "above";
    case render::BadValue::Kind::coarse:
      return "coarse";
  }
  return {};
}

nlohmann::json bad_values_json(const std::vector<render::BadValue>& bad_values, const Sources& sources) {
  nlohmann::json list = nlohmann::json::array();
  for (const render::BadValue& bad : bad_values) {
    nlohmann::json object{{"kind", kind_name(bad.kind)}, {"in", bad.shader}, {"count", bad.count}};
    if (!bad.output.empty()) object["output"] = bad.output;
    if (bad.span.valid()) {
      const Source& source = sources[bad.span.source];
      object["file"] = source.name();
      object["line"] = source.locate(bad.span.begin).line;
    }
    list.push_back(std::move(object));
  }
  return list;
}

// Of each file what is kept of it; the largest first.
nlohmann::json assets_json(const resolve::AssetBytes& assets) {
  std::vector<std::pair<resolve::Asset, std::uint64_t>> sorted(assets.begin(), assets.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [asset, bytes] : sorted) {
    nlohmann::json object{{"path", asset.path}, {"kind", asset.kind}, {"bytes", bytes}};
    if (!asset.part.empty()) object["part"] = asset.part;
    list.push_back(std::move(object));
  }
  return list;
}

nlohmann::json shortfall_json(const render::Shortfall& shortfall) {
  nlohmann::json object{{"rays", shortfall.rays}};
  if (shortfall.rays > 0) object.update({{"asked", shortfall.asked}, {"reached", shortfall.reached}});
  return object;
}

}  // namespace

nlohmann::json statistics_json(const scene::Scene& scene, const std::string& scene_hash,
                               const StageSeconds& seconds, const render::Statistics& statistics,
                               const Sources& sources, const resolve::AssetBytes& assets) {
  const render::Statistics& s = statistics;
  nlohmann::json result{
      {"version", TYNDALL_VERSION},
      {"simd", vm::simd_name()},
      {"scene_hash", scene_hash},
      {"frame", scene.frame},
      {"resolution", {scene.settings.resolution.width, scene.settings.resolution.height}},
      {"interrupted", s.stopped},
      {"threads", s.threads},
      {"seconds",
       {{"read", seconds.read},
        {"parse", seconds.parse},
        {"resolve", seconds.resolve},
        {"compile", seconds.compile},
        {"render", seconds.render},
        {"write", seconds.write}}},
      {"samples", s.samples},
      {"samples_per_second", s.seconds > 0 ? static_cast<double>(s.samples) / s.seconds : 0},
      {"rays", s.rays},
      {"shadow_rays", s.shadow_rays},
      {"marches", s.marches},
      {"segments", s.segments},
      {"cut_majorants", s.cut_majorants},
      {"step_bias", s.step_bias.share},
      {"widened_steps", shortfall_json(s.widened_steps)},
      {"missed_tolerances", shortfall_json(s.missed_tolerances)},
      {"vm",
       {{"runs", s.vm_runs},
        {"instructions", s.vm_instructions},
        {"lanes_issued", s.lanes_issued},
        {"lanes_used", s.lanes_used}}},
      {"bad_samples", s.bad_samples},
      {"clipped_samples", s.clipped_samples},
      {"lost_light", s.light > 0 ? s.lost_light / s.light : 0},
      {"bad_values", bad_values_json(s.bad_values, sources)},
      {"cut_paths", s.cut_paths},
      {"cut_throughput", s.cut_throughput},
      {"cut_light", s.cut_share()},
      {"peak_memory_bytes", peak_memory()},
      {"assets", assets_json(assets)},
  };
  if (s.estimated_error > 0) {
    result["estimated_error"] = s.estimated_error;
    result["outlier_share"] = s.outlier_share;
  }
  if (const auto light = clamped_light(scene, s)) result["clamped_light"] = light->share();
  if (s.out_of_time) result["out_of_time"] = true;
  if (s.pixels_without_samples > 0) result["pixels_without_samples"] = s.pixels_without_samples;
  if (s.first_bad_sample)
    result["first_bad_sample"] = {{"pixel", {s.first_bad_sample->x, s.first_bad_sample->y}},
                                  {"sample", s.first_bad_sample->sample}};
  return result;
}

}  // namespace tyndall::tools
