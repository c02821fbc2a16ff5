// Light scattered more often than paths are followed, as `multiple_scattering: approximate(…)` has it: single
// scattering once more for each order, in a medium that is thinner towards the light, darker and less
// directed.
#pragma once

#include <vector>

#include "scene/multiple_scattering.h"

namespace tyndall::render {

struct ScatteringOrder {
  float extinction = 1;    // of shadow rays
  float contribution = 1;  // times the albedo to the power of the order
  float anisotropy = 1;
};

// Orders 1, 2, … of an approximation.
inline std::vector<ScatteringOrder> higher_orders(const scene::ApproximateScattering& approximation) {
  std::vector<ScatteringOrder> orders;
  ScatteringOrder order;
  for (int i = 0; i < approximation.orders; ++i) {
    order.extinction *= static_cast<float>(approximation.extinction);
    order.contribution *= static_cast<float>(approximation.contribution);
    order.anisotropy *= static_cast<float>(approximation.anisotropy);
    orders.push_back(order);
  }
  return orders;
}

}  // namespace tyndall::render
