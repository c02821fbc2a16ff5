#include "tools/measure/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "tools/html.h"

namespace tyndall::tools {
namespace {

constexpr double plot_width = 560, plot_height = 360, left = 64, right = 16, top = 12, bottom = 44;  // [px]

// One axis: from numbers to pixels.
class LogAxis {
 public:
  LogAxis(double begin, double end) : begin_(begin), end_(end) {}
  void include(double value) {
    if (!(value > 0 && value < infinity)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  // Leaves room at both ends.
  void settle() {
    if (!(low_ <= high_)) low_ = high_ = 1;
    const double room = std::max(1.15, std::pow(high_ / low_, 0.06));
    low_ /= room;
    high_ *= room;
  }
  double place(double value) const {
    const double share = std::log(std::clamp(value, low_, high_) / low_) / std::log(high_ / low_);
    return begin_ + share * (end_ - begin_);
  }
  // 1, 2 and 5 of each decade; all digits where these are fewer than three.
  std::vector<double> ticks() const {
    std::vector<double> found;
    for (const bool all : {false, true}) {
      found.clear();
      for (int decade = static_cast<int>(std::floor(std::log10(low_))); decade <= std::log10(high_); ++decade)
        for (int digit = 1; digit < 10; ++digit) {
          const double value = digit * std::pow(10.0, decade);
          if ((all || digit == 1 || digit == 2 || digit == 5) && value >= low_ && value <= high_)
            found.push_back(value);
        }
      if (found.size() >= 3) break;
    }
    return found;
  }

 private:
  double begin_, end_, low_ = infinity, high_ = 0;
};

struct Axes {
  LogAxis x{left, plot_width - right}, y{plot_height - bottom, top};
};

bool is_drawn(const PlotPoint& point) { return point.x > 0 && point.y > 0; }

std::string axes_svg(const Plot& plot, const Axes& axes) {
  std::string svg;
  for (const double tick : axes.x.ticks())
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
        "<text class=\"tick\" x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
        axes.x.place(tick), top, plot_height - bottom, plot_height - bottom + 16, tick);
  for (const double tick : axes.y.ticks())
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>"
        "<text class=\"tick\" x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>\n",
        axes.y.place(tick), left, plot_width - right, left - 6, axes.y.place(tick) + 4, tick);
  svg += fmt::format("<text class=\"axis\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     (left + plot_width - right) / 2, plot_height - 8, escaped_text(plot.x_label));
  const double middle = (top + plot_height - bottom) / 2;
  svg += fmt::format(
      "<text class=\"axis\" transform=\"translate(16 {:.1f}) rotate(-90)\" "
      "text-anchor=\"middle\">{}</text>\n",
      middle, escaped_text(plot.y_label));
  return svg;
}

std::string line_svg(const PlotLine& line, const Axes& axes) {
  std::string places;
  for (const PlotPoint& point : line.points)
    if (is_drawn(point))
      places += fmt::format("{:.1f},{:.1f} ", axes.x.place(point.x), axes.y.place(point.y));
  return places.empty() ? "" : fmt::format("<polyline class=\"{}\" points=\"{}\"/>\n", line.kind, places);
}

std::string point_svg(const PlotPoint& point, const Axes& axes) {
  const double x = axes.x.place(point.x);
  std::string svg;
  if (point.high > point.low)
    svg += fmt::format(
        "<line class=\"interval\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"/>\n", x,
        axes.y.place(point.low), axes.y.place(point.high));
  return svg + fmt::format(
                   "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" data-x=\"{}\" data-y=\"{}\">"
                   "<title>{}</title></circle>\n",
                   point.filled ? "point" : "point hollow", x, axes.y.place(point.y), point.x, point.y,
                   escaped_text(point.label));
}

}  // namespace

std::string svg_of(const Plot& plot) {
  Axes axes;
  const auto include = [&axes](const PlotPoint& point) {
    if (!is_drawn(point)) return;
    axes.x.include(point.x);
    for (const double y : {point.y, point.low, point.high}) axes.y.include(y);
  };
  for (const PlotLine& line : plot.lines) std::for_each(line.points.begin(), line.points.end(), include);
  std::for_each(plot.points.begin(), plot.points.end(), include);
  axes.x.settle();
  axes.y.settle();
  std::string svg =
      fmt::format("<figure id=\"{}\"><figcaption>{}</figcaption>\n<svg viewBox=\"0 0 {} {}\" role=\"img\">\n",
                  escaped_text(plot.id), escaped_text(plot.title), plot_width, plot_height);
  svg += axes_svg(plot, axes);
  for (const PlotLine& line : plot.lines) svg += line_svg(line, axes);
  for (const PlotPoint& point : plot.points)
    if (is_drawn(point)) svg += point_svg(point, axes);
  return svg + "</svg></figure>\n";
}

}  // namespace tyndall::tools
