// The phase function that is the same in all directions.
#pragma once

#include <string_view>

#include "base/numerics.h"

namespace tyndall::optics {

struct Isotropic {
  static constexpr std::string_view keyword = "isotropic";
  static constexpr std::string_view documentation = "Scatters alike in all directions.";
  static constexpr std::string_view example = "isotropic";
  template <class F>
  static constexpr void fields(F&&) {}

  float eval(float) const { return static_cast<float>(inv_4pi); }
  float sample(float u0, float) const { return 2 - 2 * u0; }
  float mean_cosine() const { return 0; }
  float eval_softened(float m, float) const { return eval(m); }
};

}  // namespace tyndall::optics
