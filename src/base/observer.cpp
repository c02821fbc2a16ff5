#include "base/observer.h"

#include <cmath>

namespace tyndall {

// A Gaussian with different widths on its two sides.
static double observer_lobe(double x, double height, double center, double inverse_left,
                            double inverse_right) {
  const double t = (x - center) * (x < center ? inverse_left : inverse_right);
  return height * std::exp(-0.5 * t * t);
}

Vec3d observer(double nanometres) {
  const auto lobe = [&](double height, double center, double inverse_left, double inverse_right) {
    return observer_lobe(nanometres, height, center, inverse_left, inverse_right);
  };
  return {lobe(1.056, 599.8, 1 / 37.9, 1 / 31.0) + lobe(0.362, 442.0, 1 / 16.0, 1 / 26.7) +
              lobe(-0.065, 501.1, 1 / 20.4, 1 / 26.2),
          lobe(0.821, 568.8, 1 / 46.9, 1 / 40.5) + lobe(0.286, 530.9, 1 / 16.3, 1 / 31.1),
          lobe(1.217, 437.0, 1 / 11.8, 1 / 36.0) + lobe(0.681, 459.0, 1 / 26.0, 1 / 13.8)};
}

Vec3d rec709_of_xyz(const Vec3d& xyz) {
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

}  // namespace tyndall
