// Phase functions: the distribution of the direction after a scattering, per steradian.
//
// cos_theta is between propagation directions: +1 is straight on. Every `eval` integrates to 1 over the
// sphere, and `sample` draws from exactly that density (so value / pdf = 1).
//
// A member of the family is a struct of its own in phase_functions/, with
//
//   keyword, documentation, example   for scenes and the manual
//   fields(f)                         its parameters, floats, with their PhaseParameter
//   prepare()                         optional: numbers that follow from the parameters
//   float eval(float m)               density per steradian at m = 1 - cos_theta
//   float sample(float u0, float u1)  draws m; two uniform numbers (mixtures need the second)
//   float mean_cosine()
//   float eval_softened(float m, float anisotropy)   optional, see Phase
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/vec.h"
#include "optics/phase_functions/draine.h"
#include "optics/phase_functions/droplets.h"
#include "optics/phase_functions/fournier_forand.h"
#include "optics/phase_functions/henyey_greenstein.h"
#include "optics/phase_functions/isotropic.h"
#include "optics/phase_functions/phase_parameter.h"
#include "optics/phase_functions/rayleigh.h"

namespace tyndall::optics {

using PhaseFunction = std::variant<Isotropic, Rayleigh, HenyeyGreenstein, Draine, Droplets, FournierForand>;

// Which of them: its place in the variant.
enum class PhaseKind : std::uint8_t {};

template <class Function>
inline constexpr PhaseKind phase_kind = [] {
  constexpr auto place = []<class... All>(const std::variant<All...>*) {
    std::uint8_t i = 0;
    const bool found = ((std::is_same_v<All, Function> || (++i, false)) || ...);
    return found ? i : std::uint8_t{255};
  }(static_cast<const PhaseFunction*>(nullptr));
  static_assert(place < std::variant_size_v<PhaseFunction>, "not a phase function");
  return PhaseKind{place};
}();

// What scenes and the manual know of a phase function.
struct PhaseInfo {
  PhaseKind kind;
  std::string_view keyword, documentation, example;
  std::vector<PhaseParameter> parameters;
};
// One of each kind, in the order of the kinds.
std::span<const PhaseInfo> phase_functions();
const PhaseInfo& info(PhaseKind kind);

// The most parameters that a phase function has.
inline constexpr std::size_t most_phase_parameters = [] {
  return []<class... All>(const std::variant<All...>*) {
    std::size_t most = 0;
    const auto count = []<class Function>(const Function*) {
      std::size_t n = 0;
      Function::fields([&n](auto, const PhaseParameter&) { ++n; });
      return n;
    };
    ((most = std::max(most, count(static_cast<const All*>(nullptr)))), ...);
    return most;
  }(static_cast<const PhaseFunction*>(nullptr));
}();

// A phase function with its parameters settled.
class Phase {
 public:
  Phase() = default;  // isotropic
  // Parameters are clamped to their ranges.
  template <class Function>
  requires(!std::is_same_v<Function, Phase>) Phase(Function function) {
    Function::fields([&](auto member, const PhaseParameter& p) {
      function.*member =
          std::clamp(function.*member, static_cast<float>(p.lowest), static_cast<float>(p.highest));
    });
    if constexpr (requires { function.prepare(); }) function.prepare();
    function_ = function;
  }
  // The first of `parameters` are those of that kind, in the order of its fields.
  Phase(PhaseKind kind, std::span<const float, most_phase_parameters> parameters);

  // Density per steradian at m = 1 - cos_theta.
  float eval(float one_minus_cos) const;
  // Draws m = 1 - cos_theta in [0, 2]; two uniform numbers in [0, 1).
  float sample(float u0, float u1) const;
  float mean_cosine() const;
  // This function nearer to the isotropic one: its mean cosines and the like times `anisotropy`, in [0, 1].
  // A mixture with the isotropic one where the phase function has no better answer.
  float eval_softened(float one_minus_cos, float anisotropy) const;

 private:
  PhaseFunction function_;
};

// The direction at 1 - cos = m and azimuth phi from the unit direction w.
Vec3f rotate_from(const Vec3f& w, float one_minus_cos, float phi);
// 1 - cos of the angle between two unit directions, from |a - b|^2 / 2: no cancellation for small angles.
float one_minus_cos(const Vec3f& a, const Vec3f& b);

}  // namespace tyndall::optics
