#include "compile/steps/line_profile.h"

#include <algorithm>
#include <cmath>

namespace tyndall::compile {

namespace {

PlaceCoefficients mixed(const PlaceCoefficients& a, const PlaceCoefficients& b, double share) {
  const auto mix = [&](float x, float y) { return x + (y - x) * static_cast<float>(share); };
  return {mix(a.sigma_t, b.sigma_t), mix(a.sigma_s, b.sigma_s), mix(a.emission, b.emission)};
}

// ∫ e^-(sigma x) from 0 to h, where e^-(sigma h) is known.
double reach_of(double sigma, double h, double through) {
  return sigma * h > 1e-5 ? (1 - through) / sigma : h * (1 - 0.5 * sigma * h);
}

}  // namespace

LineProfile::LineProfile(double length, std::span<const double> places,
                         std::span<const PlaceCoefficients> values)
    : length_(length), apart_(length / static_cast<double>(places.size())) {
  const std::size_t n = places.size();
  values_.reserve(n + 1);
  for (std::size_t k = 0, next = 0; k <= n; ++k) {
    const double t = static_cast<double>(k) * apart_;
    while (next < n && places[next] < t) ++next;
    if (next == 0 || next == n)
      values_.push_back(values[next == 0 ? 0 : n - 1]);
    else
      values_.push_back(
          mixed(values[next - 1], values[next], (t - places[next - 1]) / (places[next] - places[next - 1])));
  }
  for (auto* sums : {&depth_, &reach_, &scattered_, &emitted_}) sums->assign(n + 1, 0.0);
  double through = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const PlaceCoefficients c = mixed(values_[k], values_[k + 1], 0.5);
    const double step_through = std::exp(-double{c.sigma_t} * apart_);
    const double reach = through * reach_of(double{c.sigma_t}, apart_, step_through);
    depth_[k + 1] = depth_[k] + double{c.sigma_t} * apart_;
    reach_[k + 1] = reach_[k] + reach;
    scattered_[k + 1] = scattered_[k] + double{c.sigma_s} * reach;
    emitted_[k + 1] = emitted_[k] + double{c.emission} * reach;
    through *= step_through;
  }
}

PlaceCoefficients LineProfile::at(double t) const {
  const double x = std::clamp(t / apart_, 0.0, static_cast<double>(values_.size() - 1));
  const std::size_t k = std::min(static_cast<std::size_t>(x), values_.size() - 2);
  return mixed(values_[k], values_[k + 1], x - static_cast<double>(k));
}

double LineProfile::cumulated(const std::vector<double>& sums, double t) const {
  const double x = std::clamp(t / apart_, 0.0, static_cast<double>(sums.size() - 1));
  const std::size_t k = std::min(static_cast<std::size_t>(x), sums.size() - 2);
  double share = x - static_cast<double>(k);
  // Light falls off between two places, too.
  constexpr double thin = 1e-3;
  if (const double depth = depth_[k + 1] - depth_[k]; depth > thin)
    share = std::expm1(-depth * share) / std::expm1(-depth);
  return sums[k] + (sums[k + 1] - sums[k]) * share;
}

double LineProfile::transmitted() const { return std::exp(-depth_.back()); }

double LineProfile::place_of_share(double share) const {
  const double depth = -std::log1p(share * std::expm1(-depth_.back()));
  const auto after = std::upper_bound(depth_.begin(), depth_.end(), depth);
  if (after == depth_.end() || after == depth_.begin()) return share * length_;
  const std::size_t k = static_cast<std::size_t>(after - depth_.begin());
  const double part = (depth - depth_[k - 1]) / (depth_[k] - depth_[k - 1]);
  return (static_cast<double>(k - 1) + part) * apart_;
}

LineProfile::Segment LineProfile::segment(double begin, double h) const {
  Segment s;
  double reach = cumulated(reach_, begin), scattered = cumulated(scattered_, begin);
  for (int i = 0; i < parts; ++i) {
    const double end = begin + h * (i + 1) / parts, reach_end = cumulated(reach_, end),
                 scattered_end = cumulated(scattered_, end);
    s.incoming[i] = (reach_end - reach) * parts / h;
    s.exact_scattered += s.incoming[i] * (scattered_end - scattered);
    reach = reach_end;
    scattered = scattered_end;
  }
  s.exact_emitted = cumulated(emitted_, begin + h) - cumulated(emitted_, begin);
  return s;
}

// What one segment brings and lets through when its coefficients are those at a place.
void LineProfile::pass(const Segment& segment, const PlaceCoefficients& c, double h, double& through,
                       LineLight& light) const {
  const double sigma = double{c.sigma_t}, part = std::exp(-sigma * h / parts),
               reach = reach_of(sigma, h / parts, part);
  double before = 1, seen = 0;
  for (const double incoming : segment.incoming) {
    seen += before * incoming;
    before *= part;
  }
  light.scattered += through * double{c.sigma_s} * reach * seen;
  light.emitted += through * double{c.emission} * reach_of(sigma, h, before);
  through *= before;
}

// Goes on through a piece, pair after pair.
void LineProfile::march(const LinePiece& piece, Compared& out) const {
  const double h = (piece.t1 - piece.t0) / piece.count;
  for (int k = 0; k < piece.count; k += 2) {
    const bool two = k + 1 < piece.count;
    const double begin = piece.t0 + k * h;
    const Segment first = segment(begin, h), second = two ? segment(begin + h, h) : Segment{};
    double through_sum = 0, emitted_before = 0, emitted_squares = 0;
    LineLight pair;
    for (int j = 0; j < jitters; ++j) {
      const double place = (j + 0.5) / jitters;
      double through = 1;
      pass(first, at(begin + place * h), h, through, pair);
      if (two) pass(second, at(begin + (2 - place) * h), h, through, pair);
      through_sum += through;
      emitted_squares += (pair.emitted - emitted_before) * (pair.emitted - emitted_before);
      emitted_before = pair.emitted;
    }
    const double mean = pair.emitted / jitters;
    out.variance += out.marched.transmitted * out.marched.transmitted *
                    std::max(emitted_squares / jitters - mean * mean, 0.0);
    out.marched.scattered += out.marched.transmitted * pair.scattered / jitters;
    out.marched.emitted += out.marched.transmitted * pair.emitted / jitters;
    out.marched.transmitted *= through_sum / jitters;
    out.exact.scattered += first.exact_scattered + second.exact_scattered;
    out.exact.emitted += first.exact_emitted + second.exact_emitted;
  }
}

LineProfile::Compared LineProfile::compared(std::span<const LinePiece> pieces) const {
  Compared out;
  out.marched.transmitted = 1;
  for (const LinePiece& piece : pieces) march(piece, out);
  out.exact.transmitted = transmitted();
  return out;
}

LineProfile::Compared LineProfile::compared(double step) const {
  const double most = static_cast<double>(values_.size());
  const LinePiece whole{0, length_, static_cast<int>(std::clamp(std::ceil(length_ / step), 1.0, most))};
  return compared(std::span(&whole, 1));
}

}  // namespace tyndall::compile
