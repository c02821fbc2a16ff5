// The report of what a measurement knows, and its page with pictures.
#pragma once

#include <atomic>
#include <string>

#include "tools/measure/measuring.h"
#include "tools/measure/report.h"

namespace tyndall::tools {

struct ReportRequest {
  std::string scene, reference;  // paths
  int threads = 0, seeds = 0;
};

// Of the scene and how it is measured, without anything that was.
MeasureReport empty_report(const ReportRequest& request, const scene::Scene& scene,
                           const scene::RenderSettings& settings);
MeasureReport full_report(const ReportRequest& request, const scene::Scene& scene,
                          const scene::RenderSettings& settings, const Measuring& measuring);

// Writes the page, with the pictures of what was measured of settings. Gives an error message, or an empty
// string.
std::string write_page(const std::string& path, const MeasureReport& report, const scene::Scene& scene,
                       const Measuring* measuring);

}  // namespace tyndall::tools
