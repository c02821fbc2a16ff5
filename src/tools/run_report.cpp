#include "tools/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/march/segment_limit.h"
#include "resolve/told_values.h"
#include "tools/identity.h"
#include "tools/progress.h"

namespace tyndall::tools {
namespace {

// Samples of each pixel that the command line and the scene ask for, first and last.
SampleRange samples_of(const RenderArguments& arguments, const scene::Scene& scene) {
  return arguments.sample_range.value_or(SampleRange{0, scene.settings.samples - 1});
}

// Without --crop.
double mean_samples(const scene::Scene& scene, const render::Statistics& statistics) {
  return static_cast<double>(statistics.samples) /
         (static_cast<double>(scene.settings.resolution.width) * scene.settings.resolution.height);
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

// Whether what is marched depends on the steps of marches.
bool steps_matter(const RenderArguments& arguments, const render::Statistics& statistics) {
  const bool tracked =
      arguments.method == render::Method::tracking && render::by_ratio(arguments.transmittance);
  return (statistics.step_bias.known || statistics.step_bias.proven > 0) && !tracked;
}

// A share as people read it.
std::string percent(double share) {
  return share < 0.0005 ? "below 0.05 %" : fmt::format("about {:.2g} %", 100 * share);
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
      if (bad.instead)
        return {told(" that are infinite", std::string(*bad.instead)), "look for a division by zero"};
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

// Likewise down, as what must not be asked too high.
std::string rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return fmt::format("{:.3g}", std::floor(value / unit * (1 + 1e-9)) * unit);
}

std::string counted_rays(std::uint64_t rays) {
  return fmt::format("{} {}", rays, rays == 1 ? "ray" : "rays");
}

// How many bounces leave out less than this share of the light.
std::string enough_bounces(int bounces, const render::Statistics& statistics, double share) {
  const double late = bounces + 1 - static_cast<double>(render::first_late_bounce(bounces));
  const double more =
      std::ceil(late * std::log(statistics.cut_share() / share) / -std::log(statistics.cut_light.left()));
  const double enough = bounces + std::max(more, 1.0);
  if (!(enough < static_cast<double>(scene::RenderSettings::bounces_range.most)))
    return "the light hardly fades from bounce to bounce: give surfaces and media an albedo below 1";
  return fmt::format("it takes `bounces: {}` or more until it is below 1%", rounded_up(enough));
}

// Whether it was told before the rendering, of the same statement.
bool was_told(const render::BadValue& bad, const Diagnostics& diagnostics) {
  using resolve::OutOfRange;
  if (bad.kind == render::BadValue::Kind::coarse || bad.output.empty()) return false;
  const OutOfRange kind = bad.kind == render::BadValue::Kind::undefined ? OutOfRange::undefined
                          : bad.kind == render::BadValue::Kind::below   ? OutOfRange::below
                                                                        : OutOfRange::above;
  const std::string told = resolve::told_out_of_range(bad.output, kind, bad.lowest, bad.highest);
  return std::any_of(diagnostics.all().begin(), diagnostics.all().end(),
                     [&](const Diagnostic& d) { return d.span == bad.span && d.message.starts_with(told); });
}

// Tells of a run: what may be an error is one with --strict.
struct Teller {
  const RenderArguments& arguments;
  const scene::Scene& scene;
  const render::Statistics& statistics;
  Diagnostics& diagnostics;

  void report(Span span, std::string message, std::string help) {
    if (arguments.strict) {
      diagnostics.error(span, std::move(message), std::move(help));
    } else {
      diagnostics.warning(span, std::move(message), std::move(help));
    }
  }
  void tell_values();
  void tell_samples();
  void tell_steps();
  void tell_lost_light();
};

// What shaders gave out of range.
void Teller::tell_values() {
  for (const render::BadValue& bad : statistics.bad_values) {
    if (was_told(bad, diagnostics)) continue;
    const auto [message, help] = text_of(bad);
    if (bad.kind == render::BadValue::Kind::coarse)
      diagnostics.warning(bad.span, message, help);
    else
      report(bad.span, message, help);
  }
}

// Samples and pixels that are bad or missing.
void Teller::tell_samples() {
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
}

// Steps that are too long or were widened, tolerances that were not kept.
void Teller::tell_steps() {
  constexpr double told_bias = 0.02;
  if (const compile::StepBias& bias = statistics.step_bias;
      steps_matter(arguments, statistics) && bias.worst_share > told_bias)
    diagnostics.warning(
        {},
        fmt::format("a step of {:.3g} m is too long, and changes the light of the picture by {}", bias.worst,
                    percent(bias.worst_share)),
        bias.enough < bias.worst ? fmt::format("`step: {}` would do, or none, for `auto` is the default",
                                               rounded_down(bias.enough))
                                 : "it is the finest that a ray may have: a smaller volume around what "
                                   "varies most allows finer ones, "
                                   "--method tracking with --transmittance ratio needs none");
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
    report({},
           fmt::format(
               "`step: auto({:.3g}%)` is not kept on {}: the {} segments that a ray may have prove no better "
               "than {}%",
               missed.asked * 100, counted_rays(missed.rays), render::max_segments,
               rounded_up(missed.reached * 100)),
           fmt::format("{}--method tracking with --transmittance ratio needs no segments",
                       missed.reached < 1
                           ? fmt::format("`step: auto({}%)` is kept; ", rounded_up(missed.reached * 100))
                           : "a smaller volume around what varies most takes fewer; "));
}

// Light that the film, `bounces` or cut bounds left out.
void Teller::tell_lost_light() {
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
  constexpr double told_cut = 0.01;
  if (statistics.cut_share() > told_cut)
    diagnostics.warning({},
                        fmt::format("`bounces: {}` left out about {:.2g}% of the light",
                                    scene.settings.bounces, statistics.cut_share() * 100),
                        enough_bounces(scene.settings.bounces, statistics, told_cut));
  if (statistics.cut_majorants > 0)
    diagnostics.warning(
        {},
        fmt::format("the proven bounds of a density were too great to track through, and cut {} {}",
                    statistics.cut_majorants, statistics.cut_majorants == 1 ? "time" : "times"),
        "the picture may be noisy or wrong there: limit the density by min(…), or leave out --method and "
        "--transmittance, for marching needs no bounds");
}

}  // namespace

std::string samples_text(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics) {
  const double mean = mean_samples(scene, statistics);
  if (arguments.error || statistics.uneven) return fmt::format("{} a pixel on average", mean);
  if (arguments.time_limit) return fmt::format("0..{}", static_cast<std::int64_t>(mean) - 1);
  const SampleRange samples = samples_of(arguments, scene);
  return fmt::format("{}..{}", samples.first, samples.last);
}

std::optional<render::ClampedLight> clamped_light(const scene::Scene& scene,
                                                  const render::Statistics& statistics) {
  if (!scene.settings.clamp.limits()) return std::nullopt;
  return statistics.clamped_light;
}

std::string step_bias_text(const RenderArguments& arguments, const render::Statistics& statistics) {
  if (!steps_matter(arguments, statistics)) return {};
  const compile::StepBias& bias = statistics.step_bias;
  if (bias.known) return percent(bias.share);
  return fmt::format("below {:.3g} % of what media let through (proven)", 100 * bias.proven);
}

void report_run_problems(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics, Diagnostics& diagnostics) {
  Teller teller{arguments, scene, statistics, diagnostics};
  teller.tell_values();
  teller.tell_samples();
  teller.tell_steps();
  teller.tell_lost_light();
}

std::string summary_line(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics) {
  const double rate =
      statistics.seconds > 0 ? static_cast<double>(statistics.samples) / statistics.seconds : 0;
  std::string samples;
  if (arguments.error || arguments.time_limit) {
    samples = fmt::format("{:.3g} samples per pixel", mean_samples(scene, statistics));
    if (statistics.estimated_error > 0) samples += error_text(*arguments.error, statistics);
    if (statistics.out_of_time) samples += ", out of time";
  } else {
    const SampleRange range = samples_of(arguments, scene);
    samples = fmt::format("{} samples per pixel{}", range.last - range.first + 1,
                          statistics.stopped ? " wanted, interrupted" : "");
  }
  const std::string bias = step_bias_text(arguments, statistics);
  return fmt::format(
      "{}: {}x{}, {} in {}, {}samples/s{}{}\n", arguments.output, scene.settings.resolution.width,
      scene.settings.resolution.height, samples, duration_text(statistics.seconds), count_text(rate),
      bias.empty() ? bias : ", step bias " + bias, removed_text(clamped_light(scene, statistics)));
}

}  // namespace tyndall::tools
