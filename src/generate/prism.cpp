#include "generate/prism.h"

#include <fmt/format.h>

#include <algorithm>

#include "generate/line.h"

namespace tyndall::generate {

Problems Prism::validate() const {
  Problems problems;
  want_positive(problems, "height", height);
  std::size_t points = 0;
  for (std::size_t i = 0; i < outline.closed.size(); ++i) {
    const std::size_t size = outline.closed[i].size();
    points += size;
    if (size < 3 && problems.empty())
      problems.push_back({"outline",
                          fmt::format("an outline takes three points at least, outline {} has {}", i, size),
                          "write [(x, z), …], once around; the last is joined to the first"});
  }
  if (points > most_outline_points)
    problems.push_back({"outline", fmt::format("more than {} points of outlines", most_outline_points)});
  if (outline.closed.empty()) problems.push_back({"outline", "'outline' holds none"});
  if (!problems.empty()) return problems;
  if (const auto found = crossings(outline.closed, 1); !found.empty()) {
    const auto& [one, other, at] = found[0];
    problems.push_back({"outline",
                        one == other
                            ? fmt::format("outline {} crosses itself near ({:.4g}, {:.4g})", one, at.x, at.y)
                            : fmt::format("outlines {} and {} cross near ({:.4g}, {:.4g})",
                                          std::min(one, other), std::max(one, other), at.x, at.y),
                        "an outline goes around once; what overlaps is better made of several prisms"});
  }
  return problems;
}

double Prism::facets() const {
  double points = 0;
  for (const Outline& o : outline.closed) points += static_cast<double>(o.size());
  return 2 * points;
}

Made Prism::make() const {
  // Seen from above, x to the right and -z upwards.
  std::vector<Outline> seen = outline.closed;
  for (Outline& points : seen)
    for (Pair<double>& p : points) p.y = -p.y;
  const Area area = fill(seen, Filled::odd);
  if (area.triangles.empty())
    return {{}, {{"outline", "the outline encloses nothing", "its points lie on a line"}}};
  Extrusion how;
  how.high = height;
  how.along = {0, 0, -1};
  how.up = {0, 1, 0};
  bounds_of(seen, how.from, how.to);
  MeshMaker maker;
  extrude(maker, area, how);
  return {maker.take(), {}};
}

}  // namespace tyndall::generate
