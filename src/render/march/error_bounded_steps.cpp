#include "render/march/error_bounded_steps.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {

namespace {

// What may be spent up to the end of each cell so that the number of segments is least. Where S rises by g
// per unit of spread Λ, segments number dΛ / (8 g); that is convex in g, so S(Λ) is the highest line from the
// origin that stays under the budget's points and never bends down: their lower convex hull.
void spread_the_budget(CertifiedScratch& s) {
  const std::size_t n = s.spread.size();
  std::vector<std::uint32_t>& hull = s.corners;
  hull.clear();
  const auto x = [&](std::uint32_t k) { return k == 0 ? 0.0 : s.spread[k - 1]; };  // corner 0 is the origin
  const auto y = [&](std::uint32_t k) { return k == 0 ? 0.0 : s.budget[k - 1]; };
  hull.push_back(0);
  for (std::uint32_t k = 1; k <= n; ++k) {
    if (x(k) == x(hull.back())) continue;  // nothing to spend in this cell, and the budget only grows
    while (hull.size() > 1) {
      const std::uint32_t a = hull[hull.size() - 2], b = hull.back();
      if ((y(b) - y(a)) * (x(k) - x(a)) < (y(k) - y(a)) * (x(b) - x(a))) break;
      hull.pop_back();
    }
    hull.push_back(k);
  }
  s.spent.resize(n);
  std::size_t corner = 0;
  for (std::uint32_t k = 1; k <= n; ++k) {
    while (corner + 1 < hull.size() && x(hull[corner]) < x(k)) ++corner;
    const std::uint32_t b = hull[corner], a = corner > 0 ? hull[corner - 1] : b;
    const double share = x(b) > x(a) ? std::min(1.0, (x(k) - x(a)) / (x(b) - x(a))) : 1.0;
    s.spent[k - 1] = y(a) + (y(b) - y(a)) * share;
  }
}

}  // namespace

void certified_intervals(std::span<const CertifiedCell> cells, double tolerance, int together, double widest,
                         CertifiedScratch& scratch, std::vector<CertifiedInterval>& out) {
  scratch.spread.clear();
  scratch.budget.clear();
  double spread = 0, depth = 0;
  for (const CertifiedCell& c : cells) {
    // At the cell's start, so that it holds all through the cell: ln(1 + tolerance e^depth), which is
    // depth + ln(tolerance) where that is large.
    const double budget = depth > 600 ? depth + std::log(tolerance) : std::log1p(tolerance * std::exp(depth));
    const double length = c.t1 - c.t0;
    spread += length * c.spread;
    depth += length * c.minorant;
    scratch.spread.push_back(spread);
    scratch.budget.push_back(budget / together);
  }
  spread_the_budget(scratch);

  double spent = 0;
  for (std::size_t i = 0; i < cells.size();) {
    const CertifiedCell& c = cells[i];
    const double length = c.t1 - c.t0, d = length * c.spread;
    const double allowed = scratch.spent[i] - spent;
    // Where the spread is 0 one segment is exact, however long.
    const bool one = d == 0 || (d * d <= 8 * allowed && length <= widest);
    if (!one) {
      const double by_budget = d > 0 ? d * d / (8 * std::max(allowed, 0.0)) : 0;
      constexpr double most_segments = 0x1p40;  // sums of so many are exact
      const double n =
          std::min(std::max({1.0, std::ceil(by_budget), std::ceil(length / widest)}), most_segments);
      out.push_back({c.t0, c.t1, n, c.minorant, c.spread});
      spent = std::min(spent + d * d / (8 * n), scratch.spent[i]);  // what was not kept is not paid back
      ++i;
      continue;
    }
    // One segment; over the next cells too, while it may be.
    double used = d * d / 8, end = c.t1;
    float low = c.minorant, high = c.majorant, spread_of_all = c.spread;
    std::size_t k = i + 1;
    for (; k < cells.size() && cells[k].t0 == end && cells[k].t1 - c.t0 <= widest; ++k) {
      low = std::min(low, cells[k].minorant);
      high = std::max(high, cells[k].majorant);
      const double range = (cells[k].t1 - c.t0) * static_cast<double>(high - low);
      if (range * range > 8 * (scratch.spent[k] - spent)) break;
      used = range * range / 8;
      end = cells[k].t1;
      spread_of_all = high - low;
    }
    out.push_back({c.t0, end, 1, low, spread_of_all});
    spent += used;
    i = k;
  }
}

}  // namespace tyndall::render
