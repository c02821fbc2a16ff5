#include "tools/measure/feature_costs.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/student_t.h"
#include "compile/compiled_scene.h"
#include "tools/measure/measured_child.h"
#include "tools/render_frame.h"
#include "tools/report.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {
namespace {

// Makes the most memory that was resident what is resident now: what was taken out is not counted. Only where
// the system can do it (proc(5), clear_refs); elsewhere memory is that of the scene as it was loaded.
void forget_peak() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::string rendered_without(const FeatureRequest& request, const Feature* feature, std::uint64_t seed) {
  RenderArguments arguments = request.arguments;
  scene::Scene scene = std::move(request.scene);
  if (feature != nullptr) feature->take_out(scene, arguments);
  forget_peak();
  apply(arguments.settings, scene.settings);
  scene.settings.seed += seed;
  const compile::CompiledScene world = compile::compile(std::move(scene));
  render::render(world, render_options_of(arguments));
  return {};
}

// One of the scene's renders, in a process of its own.
struct FeatureRun {
  double seconds = 0, cpu_seconds = 0, peak_bytes = 0;
};

// The quantile of Student's distribution that |t| is below in 95 of 100 cases, by bisection.
double student_t_95(double degrees) {
  double low = 1, high = 100;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (student_t_two_sided(middle, degrees) > 0.05 ? low : high) = middle;
  }
  return low;
}

// The mean over the rounds of 1 − without / whole: each round's two renders have the same seed and moment.
std::optional<Estimate> time_share(const std::vector<FeatureRun>& whole,
                                   const std::vector<FeatureRun>& without) {
  const std::size_t n = std::min(whole.size(), without.size());
  if (n < 2) return std::nullopt;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double share = 1 - without[i].cpu_seconds / whole[i].cpu_seconds;
    sum += share;
    squares += share * share;
  }
  const auto count = static_cast<double>(n);
  const double mean = sum / count, variance = std::max(0.0, squares / count - mean * mean) / (count - 1),
               reach = student_t_95(count - 1) * std::sqrt(variance);
  return Estimate{mean, mean - reach, mean + reach};
}

FeatureCost cost_of(std::string name, const std::vector<FeatureRun>& runs) {
  FeatureCost cost{.name = std::move(name), .runs = static_cast<int>(runs.size()), .cost = {}};
  for (const FeatureRun& run : runs) {
    cost.cost.seconds += run.seconds / static_cast<double>(runs.size());
    cost.cost.cpu_seconds += run.cpu_seconds / static_cast<double>(runs.size());
    cost.cost.peak_bytes = std::max(cost.cost.peak_bytes, run.peak_bytes);
  }
  return cost;
}

}  // namespace

FeatureCosts measure_features(const FeatureRequest& request, const std::atomic<bool>& stop,
                              std::string& problem) {
  const std::vector<Feature> features = features_to_take_out(request.scene, request.arguments);
  std::vector<std::vector<FeatureRun>> runs(features.size() + 1);  // the whole scene first
  const Stopwatch watch;
  bool complete = true;
  double longest_round = 0;
  for (int round = 0; round < request.runs && complete; ++round) {
    const double begin = watch.seconds();
    complete = round == 0 || begin + longest_round <= request.budget_seconds;
    for (std::size_t i = 0; i < runs.size() && complete && !stop; ++i) {
      const Feature* feature = i == 0 ? nullptr : &features[i - 1];
      if (!request.quiet)
        print_message(fmt::format("{}: render {} of {}\n",
                                  feature ? "without " + feature->name : "whole scene", round + 1,
                                  request.runs));
      const ChildResult child = in_child(
          [&] { return rendered_without(request, feature, static_cast<std::uint64_t>(round)); }, stop);
      if (problem = child.problem; !problem.empty()) return {};
      if (child.stopped) break;
      runs[i].push_back({child.cost.wall_seconds, child.cost.cpu_seconds, child.cost.peak_bytes});
    }
    complete = complete && !stop;
    longest_round = std::max(longest_round, watch.seconds() - begin);
  }
  FeatureCosts costs{.complete = complete};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    FeatureCost cost = cost_of(i == 0 ? std::string() : features[i - 1].name, runs[i]);
    if (i > 0 && cost.runs > 0) {
      cost.time_share = time_share(runs[0], runs[i]);
      cost.bytes = costs.rows[0].cost.peak_bytes - cost.cost.peak_bytes;
    }
    if (cost.runs > 0) costs.rows.push_back(std::move(cost));
  }
  return costs;
}

}  // namespace tyndall::tools
