#include "render/distance/product_sampling.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {

namespace {

// Parts in which the pivot sees more than this angle are cut, whatever is in them: pi/4.
constexpr double widest_cosine = 0.7;
// Parts that are narrower than this, a fifth, and whose ends differ by less than a third, are taken as
// linear.
constexpr double narrow_cosine = 0.98;
constexpr double alike = 0.7;
// Others are cut until what the line misses is less than this share of all.
constexpr double tolerance = 8e-3;
constexpr int most_levels = 40;
// Of the density there is this much that trusts neither the phase function of the typical segment nor the
// transmittance towards the light: no rough guess can make a sample too heavy. It is proportional to what is
// known exactly, the light scattered towards the camera and the inverse square.
constexpr double defence = 0.05;

// e^-x for x >= 0, to a thousandth below 2; a rational that is never far too small above.
double cautious_exp(double x) {
  return 1 / (1 + x * (1 + x * (1.0 / 2 + x * (1.0 / 6 + x * (1.0 / 24 + x * (1.0 / 120 + x / 720))))));
}

// Of a whole march, mean of the channels [1/m].
double mean_extinction(const March& m) {
  double depth = 0, length = 0;
  for (std::uint32_t i = 0; i < m.count; ++i) length += m.dt[i];
  for (int c = 0; c < m.extinction_channels; ++c)
    for (std::uint32_t i = 0; i < m.count; ++i) depth += m.sigma_t[c][i] * m.dt[i];
  return length > 0 ? depth / (length * m.extinction_channels) : 0;
}

}  // namespace

void ProductSampling::set(const March& march, const Rgb& throughput, const optics::Pivot& pivot,
                          const std::vector<Intervald>& lit, const PhaseMixture& phase) {
  march_ = &march;
  phase_ = &phase;
  table_.clear();
  coarse_.clear();
  parts_.clear();
  mass_ = 0;
  line_ = {march.ray.origin, march.ray.direction, pivot.position};
  for (const Intervald& interval : lit)
    if (line_.distance() == 0 && !(line_.weight(interval) < infinity)) return;
  shares_ = {luminance(Rgb{throughput.x, 0, 0}), luminance(Rgb{0, throughput.y, 0}),
             luminance(Rgb{0, 0, throughput.z})};
  if (march.channels == 1) shares_ = {shares_.x + shares_.y + shares_.z, 0, 0};
  flat_ = !(pivot.normal == Vec3d{});
  faces_at_zero_ = dot(pivot.normal, march.ray.origin - pivot.position);
  faces_per_metre_ = dot(pivot.normal, march.ray.direction);
  sigma_t_ = mean_extinction(march);
  for (const Intervald& interval : lit) lay(interval);
  for (const Part& part : coarse_) mass_ += part.mass();
  for (const Part& part : coarse_) refine(part, 0);
  fill_table();
}

ProductSampling::Node ProductSampling::node(double t) const {
  const double along = t - line_.delta(), d2 = sqr(line_.distance()), r = std::sqrt(d2 + sqr(along));
  // cos = -along / r, without cancellation for a pivot straight ahead.
  const double one_minus_cos = along < 0 ? d2 / (r * (r - along)) : 1 + (r > 0 ? along / r : 0);
  double arrives = phase_->pdf(static_cast<float>(one_minus_cos)) * cautious_exp(sigma_t_ * r);
  if (flat_) arrives *= std::abs(faces_at_zero_ + t * faces_per_metre_) / r;
  return {t, r, arrives};
}

double ProductSampling::carried(std::uint32_t i, double t) const {
  const Vec3d transmittance = march_->transmittance_at(i, t);
  double sum = 0;
  for (int c = 0; c < march_->channels; ++c) sum += shares_[c] * march_->sigma_s[c][i] * transmittance[c];
  return std::max(sum, 0.0);
}

double ProductSampling::carried_at_start(std::uint32_t i) const {
  double sum = 0;
  for (int c = 0; c < march_->channels; ++c)
    sum += shares_[c] * march_->sigma_s[c][i] * march_->transmittance[march_->extinction_row(c)][i];
  return std::max(sum, 0.0);
}

// What the next segment starts with is what this one ends with, unless a surface or roulette stands between.
double ProductSampling::carried_at_end(std::uint32_t i) const {
  double sum = 0;
  for (int c = 0; c < march_->channels; ++c) {
    const int row = march_->extinction_row(c);
    const double start = march_->transmittance[row][i], next = march_->transmittance[row][i + 1],
                 depth = march_->sigma_t[row][i] * march_->dt[i];
    const bool goes_on = start * (1 - depth) <= next && next * (1 + depth) <= start * (1 + 1e-9) && next > 0;
    sum += shares_[c] * march_->sigma_s[c][i] * (goes_on ? next : start * std::exp(-depth));
  }
  return std::max(sum, 0.0);
}

double ProductSampling::cosine(const Part& part) const {
  const double a = part.a.t - line_.delta(), b = part.b.t - line_.delta();
  return (sqr(line_.distance()) + a * b) / (part.a.r * part.b.r);
}

bool ProductSampling::halved(const Part& part, Part& first, Part& second) const {
  const double t = (part.a.t * part.b.r + part.b.t * part.a.r) / (part.a.r + part.b.r);
  if (!(part.a.t < t && t < part.b.t)) return false;
  const Node middle = node(t);
  const double there = carried(part.segment, t);
  first = {part.a, middle, part.carried_a, there, part.segment};
  second = {middle, part.b, there, part.carried_b, part.segment};
  return true;
}

// The parts of an interval's segments.
void ProductSampling::lay(const Intervald& interval) {
  const March& m = *march_;
  Node from = node(interval.lo);
  for (std::uint32_t i = m.segment_at(interval.lo); i < m.count && m.t0[i] < interval.hi; ++i) {
    const double end = m.t0[i] + m.dt[i];
    const Intervald t = interval.clipped_to({m.t0[i], end});
    if (t.empty()) continue;
    if (from.t != t.lo) from = node(t.lo);
    const Node to = node(t.hi);
    cut_wide({from, to, t.lo == m.t0[i] ? carried_at_start(i) : carried(i, t.lo),
              t.hi == end ? carried_at_end(i) : carried(i, t.hi), i},
             0);
    from = to;
  }
}

void ProductSampling::cut_wide(const Part& part, int level) {
  Part first, second;
  if (cosine(part) < widest_cosine && level < most_levels && halved(part, first, second)) {
    cut_wide(first, level + 1);
    cut_wide(second, level + 1);
  } else {
    coarse_.push_back(part);
  }
}

void ProductSampling::refine(const Part& part, int level) {
  const double lo = part.lo(), hi = part.hi(), mass = part.mass(), cos = cosine(part);
  const bool linear = cos > narrow_cosine && std::min(lo, hi) >= alike * std::max(lo, hi);
  Part first, second;
  if (linear || level == most_levels || mass <= 0.5 * tolerance * mass_ || !halved(part, first, second)) {
    parts_.push_back(part);
    return;
  }
  // In the middle the density per unit of s is that of half the angle's cosine squared.
  const double middle = first.hi() * 2 / (1 + cos);
  const double missed = 2.0 / 3 * std::abs(middle - 0.5 * (lo + hi)) * part.weight();
  mass_ += first.mass() + second.mass() - mass;
  if (missed > tolerance * mass_) {
    refine(first, level + 1);
    refine(second, level + 1);
  } else {
    parts_.push_back(first);
    parts_.push_back(second);
  }
}

void ProductSampling::fill_table() {
  double product = 0, known = 0;
  for (const Part& part : parts_) {
    product += part.mass();
    known += 0.5 * (part.carried_a + part.carried_b) * part.weight();
  }
  const double floor = product > 0 && product < infinity ? defence / (1 - defence) * product / known : 0;
  for (const Part& part : parts_) {
    const double w = part.weight();
    table_.add({{part.a.t, part.b.t},
                part.b.r / part.a.r,
                (part.lo() + floor * part.carried_a) * w,
                (part.hi() + floor * part.carried_b) * w,
                part.segment});
  }
  table_.finish();
}

}  // namespace tyndall::render
