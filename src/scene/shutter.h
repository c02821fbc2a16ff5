// When the shutter is open about the time of its frame, and how much light it lets through meanwhile.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/fields.h"

namespace tyndall::scene {

// Parts of a frame, of which 360deg are one: 0 is the time of the frame.
struct Shutter {
  Angle opens, closes;  // equal: it is closed, and the picture that of a moment
  bool operator==(const Shutter&) const = default;
  bool open() const { return opens != closes; }
};

// A shutter that takes its time: the light that it lets through grows evenly, is all for a while, and fades
// evenly.
struct TrapezoidCurve {
  static constexpr std::string_view keyword = "trapezoid";
  double opening = 0.25, closing = 0.25;  // shares of the time that it is open; together at most 1
  bool operator==(const TrapezoidCurve&) const = default;

  template <class F>
  static void fields(F&& field) {
    using C = TrapezoidCurve;
    field(&C::opening,
          FieldInfo{"opening", "share of the shutter's time in which light grows from none to all, 0 to 1"});
    field(&C::closing,
          FieldInfo{"closing", "share in which it fades again, 0 to 1; together with `opening` at most 1"});
  }
};

// How much of a picture's light comes from which moment. A picture is the mean over the curve: it is as
// bright whatever the curve.
struct ShutterCurve {
  static constexpr std::string_view box = "box";
  std::optional<TrapezoidCurve> trapezoid;  // none: box, all the light all the time
  bool operator==(const ShutterCurve&) const = default;

  // Per share of the time, at a share of it in [0, 1]; the integral is 1.
  double density(double moment) const {
    if (!trapezoid) return 1;
    const auto [a, c] = *trapezoid;
    const double open = moment < a ? moment / a : 1 - moment < c ? (1 - moment) / c : 1;
    return open / all_of_it();
  }
  // The moment below which a share u of the light has come, u in [0, 1): uniform u are moments drawn in
  // proportion to the curve.
  double moment(double u) const {
    if (!trapezoid) return u;
    const auto [a, c] = *trapezoid;
    const double light = u * all_of_it(), rest = (1 - u) * all_of_it();
    if (light < a / 2) return std::sqrt(2 * a * light);
    if (rest < c / 2) return 1 - std::sqrt(2 * c * rest);
    return light + a / 2;
  }

 private:
  // The integral of what is let through.
  double all_of_it() const { return 1 - (trapezoid->opening + trapezoid->closing) / 2; }
};

// As a scene says it: "box", "trapezoid(opening: 0.25, closing: 0.25)".
std::string describe(const ShutterCurve& curve);

}  // namespace tyndall::scene
