// The distance along a marched ray at which one light is taken: the strategies of `--distance` in one
// mixture, divided by the sum of their densities.
//
// A strategy is a class of its own that knows none of the others. It has
//
//   traits    what the rest of the renderer needs to know of it (distance_query.h)
//   prepare   readies it for a ray and a light; false where it cannot be had
//   sample    the place for a number in [0, 1), which never decreases with it
//   pdf       the density of a place [1/m]
//   cdf       the probability of all places before it
//
// No number chooses between strategies: that would break the smooth map from the number to the distance, and
// with it what low-discrepancy points gain. The sum of their distributions is inverted.
//
// Its name stands in `DistanceStrategies`; the mixtures that it has a share in are rows of `distance_infos`.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/interval.h"
#include "optics/light_sampling.h"
#include "render/distance/density_sampling.h"
#include "render/distance/distance_query.h"
#include "render/distance/equiangular.h"
#include "render/distance/product_sampling.h"

namespace tyndall::render {

// The density stands last: it is asked where none of the others can be had.
using DistanceStrategies = std::tuple<ProductStrategy, EquiangularStrategy, DensityStrategy>;
inline constexpr std::size_t distance_strategy_count = std::tuple_size_v<DistanceStrategies>;

inline constexpr std::array<StrategyTraits, distance_strategy_count> strategy_traits =
    []<class... Strategies>(std::type_identity<std::tuple<Strategies...>>) {
      return std::array{Strategies::traits...};
    }(std::type_identity<DistanceStrategies>{});

// The place of a strategy among them.
template <class Strategy>
inline constexpr std::size_t strategy_index =
    []<class... Strategies>(std::type_identity<std::tuple<Strategies...>>) {
      constexpr std::array same{std::is_same_v<Strategies, Strategy>...};
      static_assert((std::is_same_v<Strategies, Strategy> + ...) == 1, "stands once in DistanceStrategies");
      return static_cast<std::size_t>(std::find(same.begin(), same.end(), true) - same.begin());
    }(std::type_identity<DistanceStrategies>{});

// Which mixture of them, by `--distance`.
enum class Distance : std::uint8_t { density, equiangular, mis, product };

// The weight that a strategy has in a mixture.
template <class Strategy>
struct Share {
  double weight = 1;
};

// A mixture: its word on the command line, and the strategies that share it.
struct DistanceInfo {
  Distance distance;
  std::string_view name;
  std::array<double, distance_strategy_count> weights{};  // of the strategies in their order; add up to 1

  template <class... Strategies>
  constexpr DistanceInfo(Distance d, std::string_view word, Share<Strategies>... shares)
      : distance(d), name(word) {
    ((weights[strategy_index<Strategies>] = shares.weight), ...);
  }
  // Whether a strategy that takes part has what `trait` names, like &StrategyTraits::aims_at_light.
  constexpr bool has(bool StrategyTraits::*trait) const {
    for (std::size_t k = 0; k < distance_strategy_count; ++k)
      if (weights[k] > 0 && strategy_traits[k].*trait) return true;
    return false;
  }
  template <class Strategy>
  constexpr bool includes() const {
    return weights[strategy_index<Strategy>] > 0;
  }
};
// In the order of the enumeration.
inline constexpr std::array distance_infos{
    DistanceInfo(Distance::density, "density", Share<DensityStrategy>{}),
    DistanceInfo(Distance::equiangular, "equiangular", Share<EquiangularStrategy>{}),
    DistanceInfo(Distance::mis, "mis", Share<EquiangularStrategy>{0.5}, Share<DensityStrategy>{0.5}),
    DistanceInfo(Distance::product, "product", Share<ProductStrategy>{})};
static_assert([] {
  for (std::size_t i = 0; i < distance_infos.size(); ++i) {
    double sum = 0;
    for (const double weight : distance_infos[i].weights) sum += weight;
    if (static_cast<std::size_t>(distance_infos[i].distance) != i || sum != 1) return false;
  }
  return true;
}());
inline constexpr std::array<std::string_view, distance_infos.size()> distance_names = [] {
  std::array<std::string_view, distance_infos.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = distance_infos[i].name;
  return names;
}();
constexpr const DistanceInfo& info(Distance distance) {
  return distance_infos[static_cast<std::size_t>(distance)];
}

// Appends the parts of the ray that scatter and that the light reaches, in order.
// `within`: in this part of it; null: all.
void lit_intervals(const compile::CompiledLight& light, const optics::Pivot& pivot, const March& march,
                   const Intervald* within, std::vector<Intervald>& out);

// The segment from which most is scattered, whose phase functions stand for those of all.
std::uint32_t brightest_segment(const March& march);

// What a mixture is asked about: a ray, and one light.
struct MixtureQuery {
  const compile::CompiledLight& light;
  const March& march;
  const Rgb& throughput;
  const DensityDistribution& density;
  const std::optional<optics::Pivot>&
      pivot;  // the light is aimed at through it; none for lights without a place
  const PhaseMixture* typical_phase = nullptr;
  const Intervald* within = nullptr;  // the part of the ray to be drawn from; null: all
};

// Prepared for one ray and light after the other; keeps its memory.
class DistanceMixture {
 public:
  // False when there is nothing to draw from. Keeps references to what is asked about.
  bool prepare(Distance distance, const MixtureQuery& query);
  // The distance for a number in [0, 1), which it never decreases with.
  MarchPlace sample(float u) const;
  // Per metre.
  double pdf(const MarchPlace& at) const;
  // The probability of distances up to there.
  double cdf(const MarchPlace& at) const;

 private:
  MarchPlace inverse(double u) const;

  const March* march_ = nullptr;
  std::vector<Intervald> lit_;
  DistanceStrategies strategies_;
  std::array<double, distance_strategy_count> weights_{};  // add up to 1
};

}  // namespace tyndall::render
