// What each feature of a scene costs: the scene is rendered as it is, and with each of them taken out.
#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/measure/accuracy.h"
#include "tools/measure/render_run.h"

namespace tyndall::tools {

// A feature of a scene, and how a scene is made to do without it.
struct Feature {
  std::string name;  // "medium smoke", "motion blur"
  std::function<void(scene::Scene& scene, RenderArguments& arguments)> take_out;
};

// Those that the scene uses, rendered so.
std::vector<Feature> features_to_take_out(const scene::Scene& scene, const RenderArguments& arguments);

struct FeatureCost {
  std::string name;  // empty: the whole scene
  int runs = 0;
  RunCost cost;  // without it: means, and the largest memory
  // What it takes of the whole scene's CPU time, as a share; of two runs and more.
  std::optional<Estimate> time_share{};
  double bytes = 0;  // by which the whole scene needs more memory; of the process, so whole pages
};

struct FeatureCosts {
  std::vector<FeatureCost> rows{};  // the whole scene first
  bool complete = false;
};

struct FeatureRequest {
  scene::Scene& scene;  // each process takes its copy apart
  const RenderArguments& arguments;
  int runs = 4;
  double budget_seconds = 600;
  bool quiet = false;
};

// Renders all of them in turns, so that what else the machine does falls on all alike; until there are so
// many runs of each, the budget is spent or `stop` is set. Why nothing could be measured is in `problem`.
FeatureCosts measure_features(const FeatureRequest& request, const std::atomic<bool>& stop,
                              std::string& problem);

std::string table_of(const FeatureCosts& costs);
std::string csv_of(const FeatureCosts& costs);
nlohmann::json to_json(const FeatureCosts& costs);
// A section of a page; empty where nothing was measured.
std::string html_of(const FeatureCosts& costs);

}  // namespace tyndall::tools
