// Plots on logarithmic axes, as SVG that stands in a page.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::tools {

struct PlotPoint {
  double x = 0, y = 0;       // above 0, else it is left out
  double low = 0, high = 0;  // of an interval of y; equal: none is drawn
  std::string label;
  bool filled = true;
};

struct PlotLine {
  std::vector<PlotPoint> points;
  std::string kind;  // a class of the page's style: "front", "expected", "family"
};

struct Plot {
  std::string id, title, x_label, y_label;
  std::vector<PlotLine> lines{};  // below the points
  std::vector<PlotPoint> points{};
};

// Each point is a circle with its numbers in `data-x` and `data-y`, and its label as a title.
std::string svg_of(const Plot& plot);

}  // namespace tyndall::tools
