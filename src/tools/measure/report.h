// What was measured of all settings and features, and how it is told: as a table, as CSV and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/render_settings.h"
#include "tools/measure/accuracy.h"
#include "tools/measure/feature_costs.h"
#include "tools/measure/render_run.h"

namespace tyndall::tools {

struct SettingRow {
  std::string name;
  std::vector<std::pair<std::string, std::string>> swept;
  scene::RenderSettings settings;    // all that it was rendered with
  std::vector<std::string> options;  // of the command line that no `render {}` can say
  int runs = 0;
  RunCost cost;                        // means, and the largest memory
  std::optional<Accuracy> accuracy{};  // of two runs and more
  std::optional<double> flip{};        // mean FLIP of one render
  bool on_front = false;               // none is as fast and more accurate
};

// Root of the relMSE of one render; nothing where it is not known.
std::optional<Estimate> error_of(const SettingRow& row);
// 1/(relMSE · CPU seconds).
std::optional<double> efficiency_of(const SettingRow& row);
void mark_front(std::vector<SettingRow>& rows);

struct ReferenceFacts {
  bool given = false;
  std::string file;    // of a given one
  std::string method;  // of one that was made: the options that it was rendered with
  int samples = 0;     // a pixel, of all parts
  int parts = 0;
  double seconds = 0;
  std::optional<Estimate> error{};  // root of the relative variance; nothing where it cannot be known
};

// A setting that is expected to have an error, with as many samples as that takes.
struct Advice {
  double error = 0;              // that is wanted
  bool is_out_of_reach = false;  // without a setting: all are proven to err more
  std::string setting{};         // that was measured; empty: none reaches it
  int samples = 0;
  double seconds = 0;
  bool is_measured = false;  // with these samples; else noise is taken to fall as 1/samples
  std::string render{};      // the block to paste
  std::vector<std::string> options{};
};

struct MeasureReport {
  std::string scene;
  int width = 0, height = 0, frame = 0, threads = 0, seeds = 0;
  bool complete = false;
  ReferenceFacts reference;
  std::vector<SettingRow> rows;
  std::vector<Advice> advice;
  std::vector<std::pair<std::string, bool>> features;
  FeatureCosts feature_costs{};  // where they were asked for
};

// Why no setting is advised.
std::string why_not_reached(const Advice& advice);
// In a line.
std::string reference_text(const ReferenceFacts& reference);
std::string table_of(const MeasureReport& report);
std::string csv_of(const MeasureReport& report);
nlohmann::json to_json(const MeasureReport& report);

}  // namespace tyndall::tools
