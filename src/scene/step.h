// How finely volumes are marched.
#pragma once

#include <string>

namespace tyndall::scene {

// A length of segments [m of world space], or a tolerance from which lengths follow: what may be added in the
// mean to the transmittance of any ray, in shares of 1. Where it need not be proven, lengths have a lower
// limit.
struct Step {
  double metres = 0.1;
  double tolerance = 0;  // > 0: automatic
  bool proven = false;

  constexpr Step() = default;
  constexpr Step(double m) : metres(m) {}
  static constexpr Step automatic_within(double tolerance) {
    Step step;
    step.tolerance = tolerance;
    step.proven = true;
    return step;
  }
  // `auto` alone.
  static constexpr Step automatic_unproven() {
    Step step = automatic_within(0.01);
    step.proven = false;
    return step;
  }

  constexpr bool automatic() const { return tolerance > 0; }
  bool operator==(const Step&) const = default;
};

// As a scene says it: "0.1", "auto(1%)".
std::string describe(const Step& step);

}  // namespace tyndall::scene
