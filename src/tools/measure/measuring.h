// Measures: renders what the schedule says until the budget is spent, and keeps what comes of it.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "scene/scene.h"
#include "tools/measure/measurements.h"
#include "tools/measure/report.h"
#include "tools/measure/schedule.h"
#include "tools/measure/sweep.h"

namespace tyndall::tools {

struct MeasureGoals {
  int seeds = 4;
  double budget_seconds = 600;
  double reference_error = 0.01;
};

class Measuring {
 public:
  // `given`: a reference from a file, of the scene's size; nothing: one is made.
  Measuring(const scene::Scene& scene, std::vector<MeasuredSetting> settings, MeasureGoals goals,
            std::optional<Reference> given, Measurements& measurements);

  // Until nothing is left to be done, the budget is spent or `stop` is set; says what it does unless `quiet`.
  // Gives an error message, or an empty string.
  std::string run(const std::atomic<bool>& stop, bool quiet);

  // What is known now.
  std::vector<SettingRow> rows() const;
  Reference reference() const;
  ReferenceFacts reference_facts() const;
  bool is_complete() const { return tools::is_complete(progress_, reference_progress_, goals_.seeds); }

  // One render of a setting, and the mean of all; empty where there is none.
  std::vector<float> first_picture(std::size_t setting) const;
  std::vector<float> mean_picture(std::size_t setting) const;

 private:
  std::string do_task(const Task& task, const std::atomic<bool>& stop);
  std::string do_run(std::size_t setting, const std::atomic<bool>& stop);
  std::string do_reference(int samples, const std::atomic<bool>& stop);
  // A render that is kept.
  std::string render(const RenderArguments& arguments, MeasuredRun run, const std::atomic<bool>& stop);
  void note_progress();
  void note_errors();
  std::string told(const Task& task) const;
  std::vector<MeasuredRun> reference_rounds() const;

  const scene::Scene& scene_;
  std::vector<MeasuredSetting> settings_;
  std::vector<std::string> keys_;
  MeasureGoals goals_;
  std::optional<Reference> given_;
  RenderArguments reference_arguments_;
  std::string reference_key_;
  Measurements& measurements_;
  std::vector<SettingProgress> progress_;
  ReferenceProgress reference_progress_;
};

// How the reference of these settings is rendered: without bias, so by tracking null collisions, without
// clamp or approximation, and with as many bounces as any of them has.
RenderArguments reference_arguments(const scene::Scene& scene, const std::vector<MeasuredSetting>& settings);

}  // namespace tyndall::tools
