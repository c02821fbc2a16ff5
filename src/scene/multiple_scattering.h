// How light that is scattered many times in media is found.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/fields.h"

namespace tyndall::scene {

// Paths are followed through `real` scatterings in media. Each of the next `orders` is then approximated by
// single scattering in a medium that is thinner towards the light, darker and less directed by a constant
// factor each (Wrenninge, Kulla and Lundqvist, "Oz: The Great and Volumetric", SIGGRAPH 2013 Talks).
struct ApproximateScattering {
  static constexpr std::string_view keyword = "approximate";
  int real = 1, orders = 8;
  double extinction = 0.5, contribution = 0.7, anisotropy = 0.5;
  bool operator==(const ApproximateScattering&) const = default;

  template <class F>
  static void fields(F&& field) {
    using A = ApproximateScattering;
    field(&A::real, FieldInfo{"real", "scatterings in media that paths are followed through, >= 0"});
    field(&A::orders, FieldInfo{"orders", "further scatterings that are approximated, 0 to 64"});
    field(&A::extinction,
          FieldInfo{"extinction", "of one order towards the light, in shares of the one before, 0 to 1"});
    field(&A::contribution,
          FieldInfo{"contribution", "of one order, in shares of the one before, 0 to 1; times the albedo"});
    field(&A::anisotropy,
          FieldInfo{"anisotropy", "of one order's phase function, in shares of the one before, 0 to 1"});
  }
};

struct MultipleScattering {
  static constexpr std::string_view full = "full";
  std::optional<ApproximateScattering> approximate;  // none: full
  bool operator==(const MultipleScattering&) const = default;
};

// As a scene says it: "full", "approximate(real: 1, orders: 8, …)".
std::string describe(const MultipleScattering& scattering);

}  // namespace tyndall::scene
