// The report as one page of HTML that needs no other file.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/report.h"

namespace tyndall::tools {

// Data URIs of one render and of the mean of all, each with its error map.
struct SettingPictures {
  std::string name, render, render_errors, mean, mean_errors;
};

struct PagePictures {
  std::string reference;
  double most_error = 0;  // that the maps show
  std::vector<SettingPictures> settings{};
};

// The whole report stands in it as JSON, too, in the element `measurements`.
std::string page_of(const MeasureReport& report, const PagePictures& pictures);

}  // namespace tyndall::tools
