#include "tools/run_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "render/segment_limit.h"
#include "tools/progress.h"
#include "vm/machine.h"

namespace tyndall::tools {
namespace {

// Samples of each pixel that the command line and the scene ask for, first and last.
SampleRange samples_of(const RenderArguments& arguments, const scene::Scene& scene) {
  return arguments.sample_range.value_or(SampleRange{0, scene.settings.samples - 1});
}

// Without --crop.
double mean_samples(const scene::Scene& scene, const render::Statistics& statistics) {
  return static_cast<double>(statistics.samples) /
         (static_cast<double>(scene.settings.width) * scene.settings.height);
}

// Largest resident size of the process so far [bytes].
std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
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

// The error that was reached, and whether it is to be trusted.
std::string error_text(double wanted, const render::Statistics& statistics) {
  std::string text = fmt::format(", estimated error {:.3g}", statistics.estimated_error);
  if (statistics.estimated_error > wanted) text += fmt::format(" where {:.3g} was wanted", wanted);
  if (statistics.outlier_share > 0.5)
    text += fmt::format(" ({:.0f} % of its square in a few pixels that met rare bright paths: more may come)",
                        100 * statistics.outlier_share);
  return text;
}

nlohmann::json shortfall_json(const render::Shortfall& shortfall) {
  nlohmann::json object{{"rays", shortfall.rays}};
  if (shortfall.rays > 0) object.update({{"asked", shortfall.asked}, {"reached", shortfall.reached}});
  return object;
}

// What is told of a shader's bad values, and the way out.
std::pair<std::string, std::string> text_of(const render::BadValue& bad) {
  const std::string output = bad.output.empty() ? "of a coefficient" : fmt::format("of '{}'", bad.output);
  const auto told = [&](const std::string& what, const std::string& taken_as) {
    return fmt::format("'{}' gave {} {} {} here, taken as {}", bad.shader, bad.count,
                       bad.count == 1 ? "value" : "values", output + what, taken_as);
  };
  const std::string lowest = fmt::format("{}", bad.lowest), highest = fmt::format("{}", bad.highest);
  switch (bad.kind) {
    case render::BadValue::Kind::undefined:
      return {told(" that are no numbers", bad.instead
                                               ? std::string(*bad.instead)
                                               : fmt::format("{}", std::clamp(0.0, bad.lowest, bad.highest))),
              "look for 0/0, or a root or logarithm of a negative number"};
    case render::BadValue::Kind::below:
      return {told(" below " + lowest, lowest), fmt::format("max({}, …) says that it is meant", lowest)};
    case render::BadValue::Kind::above:
      if (bad.highest >= double{scene::largest_coefficient})
        return {told(" that are infinite or above 1e30", "1e30"), "look for a division by zero"};
      return {told(" above " + highest, highest), fmt::format("min({}, …) says that it is meant", highest)};
    case render::BadValue::Kind::coarse:
      return {fmt::format("'{}' asks for '{}' here at places as far out as {:.2g}, where numbers are {:.2g} "
                          "apart: from 8e6 on it is constant",
                          bad.shader, bad.output, bad.highest,
                          std::exp2(std::floor(std::log2(bad.highest)) - 23)),
              "subtract a place near by before it is scaled, or scale by less"};
  }
  return {};
}

// A number rounded up to two digits, as what must not be promised too low.
std::string rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return fmt::format("{:.3g}", std::ceil(value / unit * (1 - 1e-9)) * unit);
}

std::string counted_rays(std::uint64_t rays) {
  return fmt::format("{} {}", rays, rays == 1 ? "ray" : "rays");
}

}  // namespace

std::string stable_hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

image::Metadata metadata_of(const RenderArguments& arguments, const scene::Scene& scene,
                            const std::string& scene_hash, const render::Statistics& statistics) {
  const SampleRange samples = samples_of(arguments, scene);
  std::string settings = fmt::format(
      "step={} light_samples={} bounces={} multiple_scattering={} method={} distance={} transmittance={} "
      "emission={}",
      scene::describe(scene.settings.step), scene.settings.light_samples, scene.settings.bounces,
      scene::describe(scene.settings.multiple_scattering), name(arguments.method), name(arguments.distance),
      name(arguments.transmittance), name_in(emissions, arguments.emission_sampling));
  if (arguments.crop) {
    const auto& crop = *arguments.crop;
    settings += fmt::format(" crop={},{},{},{}", crop.x0, crop.y0, crop.x1, crop.y1);
  }
  std::string count = fmt::format("{}..{}", samples.first, samples.last);
  if (arguments.error) {
    settings += fmt::format(" error={}", *arguments.error);
    count = fmt::format("{} a pixel on average", mean_samples(scene, statistics));
  } else if (statistics.uneven) {
    count = fmt::format("{} a pixel on average", mean_samples(scene, statistics));
  } else if (arguments.time_limit) {
    count = fmt::format("0..{}", static_cast<std::int64_t>(mean_samples(scene, statistics)) - 1);
  }
  image::Metadata metadata{
      {"Software", "Tyndall " TYNDALL_VERSION},
      {"tyndall:version", TYNDALL_VERSION},
      {"tyndall:scene_hash", scene_hash},
      {"tyndall:frame", fmt::format("{}", scene.frame)},
      {"tyndall:samples", count},
      {"tyndall:seed", fmt::format("{}", scene.settings.seed)},
      {"tyndall:settings", settings},
      {"tyndall:simd", vm::simd_name()},
  };
  if (statistics.stopped)
    metadata.emplace_back("tyndall:interrupted", fmt::format("after {} samples in all", statistics.samples));
  return metadata;
}

nlohmann::json statistics_json(const scene::Scene& scene, const std::string& scene_hash,
                               const StageSeconds& seconds, const render::Statistics& statistics,
                               const Sources& sources) {
  const render::Statistics& s = statistics;
  nlohmann::json result{
      {"version", TYNDALL_VERSION},
      {"simd", vm::simd_name()},
      {"scene_hash", scene_hash},
      {"frame", scene.frame},
      {"resolution", {scene.settings.width, scene.settings.height}},
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
      {"peak_memory_bytes", peak_memory()},
  };
  if (s.estimated_error > 0) {
    result["estimated_error"] = s.estimated_error;
    result["outlier_share"] = s.outlier_share;
  }
  if (s.out_of_time) result["out_of_time"] = true;
  if (s.pixels_without_samples > 0) result["pixels_without_samples"] = s.pixels_without_samples;
  if (s.first_bad_sample)
    result["first_bad_sample"] = {{"pixel", {s.first_bad_sample->x, s.first_bad_sample->y}},
                                  {"sample", s.first_bad_sample->sample}};
  return result;
}

void report_run_problems(const RenderArguments& arguments, const render::Statistics& statistics,
                         Diagnostics& diagnostics) {
  const auto report = [&](Span span, std::string message, std::string help) {
    if (arguments.strict) {
      diagnostics.error(span, std::move(message), std::move(help));
    } else {
      diagnostics.warning(span, std::move(message), std::move(help));
    }
  };
  for (const render::BadValue& bad : statistics.bad_values) {
    const auto [message, help] = text_of(bad);
    if (bad.kind == render::BadValue::Kind::coarse)
      diagnostics.warning(bad.span, message, help);
    else
      report(bad.span, message, help);
  }
  if (const auto& first = statistics.first_bad_sample)
    report({},
           fmt::format("{} {} not finite, and counted as black", statistics.bad_samples,
                       statistics.bad_samples == 1 ? "sample was" : "samples were"),
           "the first again: " + replay_command(arguments, first->x, first->y, first->sample));
  if (statistics.pixels_without_samples > 0)
    diagnostics.warning(
        {},
        fmt::format("{} pixels have no samples and are black: the run ended in its first pass",
                    statistics.pixels_without_samples),
        "more time, or a smaller --resolution, reaches all of them");
  if (statistics.threads_missed > 0)
    diagnostics.warning({}, fmt::format("{} threads could not be had, and {} did the work",
                                        statistics.threads_missed, statistics.threads));
  if (const render::Shortfall& steps = statistics.widened_steps; steps.rays > 0)
    diagnostics.warning(
        {},
        fmt::format("a step of {:.3g} m wants more than {} segments on {}, and was widened to {:.3g} m",
                    steps.asked, render::max_segments, counted_rays(steps.rays), steps.reached),
        fmt::format("what is thinner than that may be missed: `step: auto` puts segments where a medium "
                    "varies, --method tracking with --transmittance ratio needs none; a step of {} m says "
                    "that it is meant",
                    rounded_up(steps.reached)));
  if (const render::Shortfall& missed = statistics.missed_tolerances; missed.rays > 0)
    report(
        {},
        fmt::format("the tolerance of `step: auto({:.3g}%)` takes more than {} segments on {}, within which "
                    "{}% is reached",
                    missed.asked * 100, render::max_segments, counted_rays(missed.rays),
                    rounded_up(missed.reached * 100)),
        fmt::format("{}--method tracking with --transmittance ratio needs no segments",
                    missed.reached < 1
                        ? fmt::format("`step: auto({}%)` is kept; ", rounded_up(missed.reached * 100))
                        : "a smaller volume around what varies most takes fewer; "));
  // What a shader gave out of range is told already, and with its line.
  const bool told =
      std::any_of(statistics.bad_values.begin(), statistics.bad_values.end(),
                  [](const render::BadValue& bad) { return bad.kind == render::BadValue::Kind::above; });
  constexpr double told_film_loss = 0.001;
  if (!told && (statistics.clipped_samples > 0 || statistics.lost_light > told_film_loss * statistics.light))
    report({},
           fmt::format("the film keeps samples from 5e-20 to 2.7e11, and lost {}% of the light: {}",
                       rounded_up(100 * statistics.lost_light / statistics.light),
                       statistics.clipped_samples > 0
                           ? fmt::format("{} {} too bright", statistics.clipped_samples,
                                         statistics.clipped_samples == 1 ? "sample was" : "samples were")
                           : "it is too dark"),
           "light adds up: scale all lights by one factor, and the picture by its inverse");
  if (statistics.cut_majorants > 0)
    diagnostics.warning(
        {},
        fmt::format("the proven bounds of a density were too great to track through, and cut {} {}",
                    statistics.cut_majorants, statistics.cut_majorants == 1 ? "time" : "times"),
        "the picture may be noisy or wrong there: limit the density by min(…), or leave out --method and "
        "--transmittance, for marching needs no bounds");
}

std::string summary_line(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics) {
  const double rate =
      statistics.seconds > 0 ? static_cast<double>(statistics.samples) / statistics.seconds : 0;
  std::string samples;
  if (arguments.error || arguments.time_limit) {
    samples = fmt::format("{:.3g} samples a pixel", mean_samples(scene, statistics));
    if (statistics.estimated_error > 0) samples += error_text(*arguments.error, statistics);
    if (statistics.out_of_time) samples += ", out of time";
  } else {
    const SampleRange range = samples_of(arguments, scene);
    samples = fmt::format("{} samples a pixel{}", range.last - range.first + 1,
                          statistics.stopped ? " wanted, interrupted" : "");
  }
  constexpr double told_cut = 0.01;
  const std::string cut = statistics.cut_throughput > told_cut
                              ? fmt::format("; `bounces: {}` cut {:.2g}% of the light",
                                            scene.settings.bounces, statistics.cut_throughput * 100)
                              : std::string();
  return fmt::format("{}: {}x{}, {} in {}, {}samples/s{}\n", arguments.output, scene.settings.width,
                     scene.settings.height, samples, duration_text(statistics.seconds), count_text(rate),
                     cut);
}

}  // namespace tyndall::tools
