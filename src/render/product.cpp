#include "render/product.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {

namespace {

// A cell in which more than this happens is cut: what is not constant in it is then known too roughly.
constexpr double cell_angle = 0.4;  // [rad] seen from the pivot
constexpr double cell_depth = 1;    // optical depth
constexpr int most_cuts = 8;        // of one segment, for each of the two reasons

// atan(x)/x for x >= 0, to half a per cent.
double atan_ratio(double x) { return x < 1 ? 1 / (1 + 0.28 * x * x) : (pi / 2 - x / (x * x + 0.28)) / x; }

// e^-x for x >= 0 or more, by a rational that is never far too small.
double rough_exp(double x) { return 1 / (1 + x * (1 + x * (0.5 + x * (1.0 / 6)))); }

// (angle over D) of [a, b], relative to the point nearest the pivot, without trigonometry. Twice the angle
// whose tangent is sin/(1 + cos).
double rough_weight(double distance, double a, double b) {
  const double d2 = distance * distance;
  const double norm = std::sqrt((d2 + a * a) * (d2 + b * b));
  const double half_tangent_over_d = (b - a) / std::max(norm + d2 + a * b, 1e-12 * norm);
  return 2 * half_tangent_over_d * atan_ratio(half_tangent_over_d * distance);
}

// Of a whole march, mean of the channels [1/m].
double mean_extinction(const March& m) {
  double depth = 0, length = 0;
  for (std::uint32_t i = 0; i < m.count; ++i) {
    length += m.dt[i];
    for (int c = 0; c < m.extinction_channels; ++c) depth += m.sigma_t[c][i] * m.dt[i];
  }
  return length > 0 ? depth / (length * m.extinction_channels) : 0;
}

}  // namespace

void Product::set(const March& march, const Rgb& throughput, const Vec3d& pivot,
                  const std::vector<Intervald>& stretches, const PhaseMixture& phase) {
  cells_.clear();
  total_ = 0;
  line_ = {march.ray.origin, march.ray.direction, pivot};
  for (const Intervald& stretch : stretches) {
    if (line_.distance() == 0 && !(line_.weight(stretch) < infinity)) return;
    for (std::uint32_t i = march.segment_at(stretch.lo); i < march.count && march.t0[i] < stretch.hi; ++i) {
      const Intervald part = stretch.clipped_to({march.t0[i], march.t0[i] + march.dt[i]});
      if (!part.empty()) add_segment(march, throughput, i, part);
    }
  }
  if (!cells_.empty()) weigh(mean_extinction(march), phase);
}

// A cell for the part of a segment, or several: equal angles, and equal shares of what its own extinction
// leaves.
void Product::add_segment(const March& m, const Rgb& throughput, std::uint32_t i, const Intervald& part) {
  const double a = part.lo - line_.delta(), b = part.hi - line_.delta();
  const double angle = rough_weight(line_.distance(), a, b) * line_.distance();
  const double sigma_t = m.sigma_t[0][i], depth = sigma_t * part.length();
  cuts_.clear();
  cuts_.push_back(part.lo);
  if (angle > cell_angle || depth > cell_depth) {
    const auto pieces = [](double amount, double each) {
      return std::clamp(static_cast<int>(std::min(amount / each, 1.0 * most_cuts)) + 1, 1, most_cuts);
    };
    const int by_angle = pieces(angle, cell_angle), by_depth = pieces(depth, cell_depth);
    for (int k = 1; k < by_angle; ++k) cuts_.push_back(line_.sample(part, 1.0 * k / by_angle));
    for (int k = 1; k < by_depth; ++k)
      cuts_.push_back(
          part.lo + std::min(-std::log1p(1.0 * k / by_depth * std::expm1(-depth)) / sigma_t, part.length()));
    std::sort(cuts_.begin(), cuts_.end());
  }
  cuts_.push_back(part.hi);
  const Rgb carried = throughput * m.sigma_s_at(i);
  for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
    const Intervald cell{cuts_[k], cuts_[k + 1]};
    if (cell.empty()) continue;
    const double middle = 0.5 * (cell.lo + cell.hi);
    cells_.push_back({cell, std::max(0.0f, luminance(carried * Rgb(m.transmittance_at(i, middle))))});
  }
}

void Product::weigh(double sigma_t, const PhaseMixture& phase) {
  for (Cell& cell : cells_) {
    const double a = cell.t.lo - line_.delta(), b = cell.t.hi - line_.delta(), middle = 0.5 * (a + b);
    const double d2 = sqr(line_.distance()), r = std::sqrt(d2 + sqr(middle));
    // cos = -middle / r, without cancellation for a pivot straight ahead.
    const double one_minus_cos = middle < 0 ? d2 / (r * (r - middle)) : 1 + (r > 0 ? middle / r : 0);
    cell.before = total_;
    total_ += cell.brightness * rough_weight(line_.distance(), a, b) * rough_exp(sigma_t * r) *
              phase.pdf(static_cast<float>(one_minus_cos));
  }
  if (!(total_ < infinity)) total_ = 0;
}

double Product::sample(double u) const {
  const double target = u * total_;
  const auto after = std::upper_bound(cells_.begin(), cells_.end(), target,
                                      [](double value, const Cell& cell) { return value < cell.before; });
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - cells_.begin() - 1, 0));
  const double w = weight(i);
  return line_.sample(cells_[i].t, w > 0 ? std::clamp((target - cells_[i].before) / w, 0.0, 1.0) : 0.0);
}

double Product::pdf(double t) const {
  if (!available()) return 0;
  const auto after = std::upper_bound(cells_.begin(), cells_.end(), t,
                                      [](double value, const Cell& cell) { return value < cell.t.lo; });
  if (after == cells_.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - cells_.begin() - 1);
  if (t > cells_[i].t.hi) return 0;
  const double w = line_.weight(cells_[i].t);
  return w > 0 ? weight(i) / total_ * line_.falloff(t) / w : 0.0;
}

}  // namespace tyndall::render
