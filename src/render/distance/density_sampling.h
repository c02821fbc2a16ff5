// Distances along a marched ray by what is scattered there, without regard to lights.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "render/distance/distance_query.h"
#include "render/march/march.h"

namespace tyndall::render {

// Distances distributed as scattered radiance: per channel discrete over segments and exponential inside,
// channels mixed in proportion to throughput times ∫ sigma_s T (transport §3, "Density"). The mixture's own
// distribution is inverted, with no choice of a channel: the distance never decreases with the number.
class DensityDistribution {
 public:
  // Keeps a reference to the march.
  DensityDistribution(const March& march, const Rgb& throughput);
  bool available() const { return available_; }
  // For a number in [0, 1).
  MarchPlace sample(float u) const;
  // Per metre.
  double pdf(const MarchPlace& at) const;
  // The probability of distances up to there.
  double cdf(const MarchPlace& at) const;

 private:
  // The probability of all segments before this one.
  double before(std::uint32_t segment) const;
  std::uint32_t segment_of(double target) const;

  const March& march_;
  std::array<double, 3> weight_{};  // of the channels: throughput over the sum of throughput ∫ sigma_s T
  bool available_ = false;
};

// As a strategy for direct light: it covers all that scatters, so it may always stand in for the others.
class DensityStrategy {
 public:
  static constexpr StrategyTraits traits{};
  bool prepare(const DistanceQuery& query);
  MarchPlace sample(const March& march, float u) const;
  double pdf(const MarchPlace& at) const;
  double cdf(const MarchPlace& at) const;

 private:
  const DensityDistribution* density_ = nullptr;
  const Intervald* within_ = nullptr;  // null: all
  double before_ = 0, mass_ = 1;       // of the part to be drawn from
};

}  // namespace tyndall::render
