// How finely volumes are marched.
#pragma once

#include <string>

namespace tyndall::scene {

// A length of segments [m of world space], or a tolerance from which lengths follow: of what the steps of a
// march change of the picture, as a pilot of marches estimates it (compile/steps), in shares of its light; or
// of what may be added in the mean to the transmittance of any ray, as bounds prove it.
struct Step {
  static constexpr double usual_tolerance = 0.005;

  double metres = 0;
  double tolerance = usual_tolerance;  // > 0: `metres` follows
  bool proven = false;

  constexpr Step() = default;
  constexpr Step(double m) : metres(m), tolerance(0) {}
  static constexpr Step estimated_within(double tolerance) {
    Step step;
    step.tolerance = tolerance;
    return step;
  }
  static constexpr Step proven_within(double tolerance) {
    Step step = estimated_within(tolerance);
    step.proven = true;
    return step;
  }

  constexpr bool fixed() const { return tolerance == 0; }
  constexpr bool estimated() const { return !fixed() && !proven; }
  bool operator==(const Step&) const = default;
};

// As a scene says it: "0.1", "auto", "adaptive(2%)", "auto(1%)".
std::string describe(const Step& step);

}  // namespace tyndall::scene
