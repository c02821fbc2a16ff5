// Step sizes with a proven tolerance (transport §4, certified marching).
//
// Segment i of length Δ takes its extinction at one uniform place, so its optical depth has the right mean
// and lies in a range of width d = Δ (M - m). Where steps are proven, segments are independent (march.h,
// jitter: the worst of mirrored pairs would be twice as bad), and by Hoeffding's lemma
//   1 <= E[T'] / T <= exp(S),  S = ∑ d² / 8.
// With T <= exp(-∫ m) it is enough for E[T'] - T <= tolerance that S <= ln(1 + tolerance exp(∫ m)) at the end
// of every segment: what is deep inside may be coarse.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tyndall::render {

// A cell along a ray, and its bounds of extinction; the next one begins where it ends, or later.
struct CertifiedCell {
  double t0 = 0, t1 = 0;
  float minorant = 0, majorant = 0, spread = 0;
};

// `count` equal segments over [t0, t1), a whole number that may be far beyond what can be laid; and bounds of
// extinction.
struct CertifiedInterval {
  double t0 = 0, t1 = 0;
  double count = 0;
  float minorant = 0, spread = 0;
};

// Scratch of certified_intervals.
struct CertifiedScratch {
  std::vector<double> spread, budget, spent;  // up to the end of each cell
  std::vector<std::uint32_t> corners;
};

// Cuts the cells into as few segments as the tolerance allows, none longer than `widest`. `together` is
// how many media share the segments: their depths add up.
void certified_intervals(std::span<const CertifiedCell> cells, double tolerance, int together, double widest,
                         CertifiedScratch& scratch, std::vector<CertifiedInterval>& out);

}  // namespace tyndall::render
