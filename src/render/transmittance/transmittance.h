// How transmittance towards a light is found where it has no closed form (transport §4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tyndall::render {

enum class Transmittance : std::uint8_t { march, jackknife, ratio, residual_ratio, series };

struct TransmittanceInfo {
  Transmittance estimator;
  std::string_view name;  // its word on the command line
  bool by_ratio = false;  // it needs proven bounds instead of steps
  bool unbiased = false;  // whatever the step
};
// In the order of the enumeration.
inline constexpr std::array transmittance_infos{
    TransmittanceInfo{.estimator = Transmittance::march, .name = "march"},
    TransmittanceInfo{.estimator = Transmittance::jackknife, .name = "jackknife"},
    TransmittanceInfo{.estimator = Transmittance::ratio, .name = "ratio", .by_ratio = true, .unbiased = true},
    TransmittanceInfo{.estimator = Transmittance::residual_ratio,
                      .name = "residual-ratio",
                      .by_ratio = true,
                      .unbiased = true},
    TransmittanceInfo{.estimator = Transmittance::series, .name = "series", .unbiased = true}};
inline constexpr std::array<std::string_view, transmittance_infos.size()> transmittance_names = [] {
  std::array<std::string_view, transmittance_infos.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = transmittance_infos[i].name;
  return names;
}();
constexpr const TransmittanceInfo& info(Transmittance estimator) {
  return transmittance_infos[static_cast<std::size_t>(estimator)];
}
constexpr bool by_ratio(Transmittance estimator) { return info(estimator).by_ratio; }

}  // namespace tyndall::render
