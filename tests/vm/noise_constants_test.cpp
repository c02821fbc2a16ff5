// The extremes that the bounds of noise are made of, found again: noise is linear in the gradients at its
// corners, so at any place the extreme over all hashes is a sum over corners, each with the gradient that
// suits it best.
#include "vm/kernels/noise_constants.h"

#include <functional>

#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double fade_slope(double t) { return 30 * t * t * (t - 1) * (t - 1); }
double fade_curvature(double t) { return 60 * t * (2 * t * t - 3 * t + 1); }

// The noise of one cell in `dimensions` dimensions, whose gradients have ones in all places but one.
template <int dimensions>
class Cell {
 public:
  using Place = std::array<double, dimensions>;

  // The largest value of a derivative at x: of ∑ signs[i][j] d_i d_j when `order` is 2, of ∑ signs[i][i] d_i
  // when it is 1, of the noise itself when it is 0.
  struct Derivative {
    int order = 0;
    std::array<std::array<int, dimensions>, dimensions> signs{};
  };
  double extreme(const Derivative& derivative, const Place& x) const {
    double sum = 0;
    for (int corner = 0; corner < (1 << dimensions); ++corner) {
      Place v{};  // the derivative is the scalar product of v and the corner's gradient
      for (int i = 0; i < dimensions; ++i)
        for (int j = 0; j < dimensions; ++j) {
          const int sign = derivative.signs[i][j];
          if (derivative.order == 2 && sign != 0) {
            const double w = share(corner, x, i, j);
            for (int k = 0; k < dimensions; ++k) v[k] += sign * w * distance(corner, x, k);
            v[i] += sign * share(corner, x, j, -1);
            v[j] += sign * share(corner, x, i, -1);
          } else if (derivative.order == 1 && i == j && sign != 0) {
            const double w = share(corner, x, i, -1);
            for (int k = 0; k < dimensions; ++k) v[k] += sign * w * distance(corner, x, k);
            v[i] += sign * share(corner, x, -1, -1);
          }
        }
      if (derivative.order == 0)
        for (int k = 0; k < dimensions; ++k) v[k] = share(corner, x, -1, -1) * distance(corner, x, k);
      double total = 0, least = 1e30;
      for (const double c : v) {
        total += std::fabs(c);
        least = std::min(least, std::fabs(c));
      }
      sum += total - least;
    }
    return dimensions == 4 ? sum * 2 / 3 : sum;
  }

  // Climbs from random places.
  double supremum(const Derivative& derivative, int starts) const {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    double best = 0;
    for (int start = 0; start < starts; ++start) {
      Place x;
      for (double& c : x) c = unit(random);
      double value = extreme(derivative, x), reach = 0.2;
      for (int round = 0; round < 80; ++round) {
        Place y = x;
        for (double& c : y) c = std::clamp(c + reach * (2 * unit(random) - 1), 0.0, 1.0);
        const double there = extreme(derivative, y);
        if (there > value)
          value = there, x = y;
        else
          reach *= 0.92;
      }
      best = std::max(best, value);
    }
    return best;
  }

 private:
  static double distance(int corner, const Place& x, int axis) { return x[axis] - (corner >> axis & 1); }
  // The corner's share, differentiated along i and j (-1: not).
  static double share(int corner, const Place& x, int i, int j) {
    double product = 1;
    for (int axis = 0; axis < dimensions; ++axis) {
      const int order = (axis == i) + (axis == j);
      const bool upper = corner >> axis & 1;
      const double f = order == 0   ? fade(x[axis])
                       : order == 1 ? fade_slope(x[axis])
                                    : fade_curvature(x[axis]);
      product *= upper ? f : order == 0 ? 1 - f : -f;
    }
    return product;
  }
};

// The largest of a derivative over all choices of signs: the supremum of a sum of absolute values.
template <int dimensions>
double over_all_signs(const std::function<bool(int, int)>& counted, int starts) {
  std::vector<std::pair<int, int>> terms;
  for (int i = 0; i < dimensions; ++i)
    for (int j = i; j < dimensions; ++j)
      if (counted(i, j)) terms.push_back({i, j});
  double best = 0;
  for (unsigned signs = 0; signs < (1u << (terms.size() - 1)); ++signs) {  // the opposite of all is the same
    typename Cell<dimensions>::Derivative derivative;
    derivative.order = 2;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const auto [i, j] = terms[k];
      derivative.signs[i][j] = signs >> k & 1 ? -1 : 1;
      // Both (i, j) and (j, i) count in the sum over the whole matrix; one of them in a row.
      if (counted(j, i)) derivative.signs[j][i] = derivative.signs[i][j];
    }
    best = std::max(best, Cell<dimensions>().supremum(derivative, starts));
  }
  return best;
}

template <int dimensions>
void expect(const NoiseConstants& constants, int starts) {
  using Derivative = typename Cell<dimensions>::Derivative;
  const Cell<dimensions> cell;
  const auto check = [](const char* what, double found, float constant) {
    EXPECT_LE(found, static_cast<double>(constant)) << what;
    EXPECT_GE(found, 0.985 * static_cast<double>(constant)) << what << ": looser than need be";
  };
  check("supremum", cell.supremum(Derivative{}, 40 * starts), constants.supremum);
  Derivative slope;
  slope.order = 1;
  slope.signs[0][0] = 1;
  check("slope", cell.supremum(slope, 40 * starts), constants.slope);
  check("curvature", over_all_signs<dimensions>([](int, int) { return true; }, starts), constants.curvature);
  check("row", over_all_signs<dimensions>([](int i, int) { return i == 0; }, 4 * starts),
        constants.curvature_row);
}

TEST(NoiseConstants, AreTheExtremesOverAllGradients) {
  expect<3>(noise_constants3, 60);
  expect<4>(noise_constants4, 6);
}

// The kernel's own noise stays within what its middle, slope and curvature say, at the radii where they are
// used.
TEST(NoiseConstants, HoldForTheKernelsNoise) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-50, 50), unit(-1, 1);
  for (const Op op : {Op::noise3, Op::noise4}) {
    const NoiseConstants& constants = op == Op::noise3 ? noise_constants3 : noise_constants4;
    float closest = 0;
    for (int i = 0; i < 300000; ++i) {
      const std::array<float, 4> x = {place(random), place(random), place(random), place(random)};
      const float radius = 0.004f + 0.2f * std::fabs(unit(random)), sign = unit(random) < 0 ? -1.0f : 1.0f;
      std::array<float, 4> y = x, z = x;
      for (std::size_t k = 0; k < 4; ++k) {
        const float step = unit(random) < 0 ? -radius : radius;
        y[k] += step;
        z[k] -= step * sign;
      }
      const auto n = [&](const std::array<float, 4>& p) {
        return evaluate_lane(op, std::span(p).first(static_cast<std::size_t>(op_info(op).operands)), 0,
                             test_seed);
      };
      // n(x + h) - 2 n(x) + n(x - h) = h^T H h averaged; bounded by the sum of curvatures.
      if (sign > 0) {
        const float second = std::fabs(n(y) - 2 * n(x) + n(z));
        ASSERT_LE(second, constants.curvature * radius * radius + 1e-5f);
        closest = std::max(closest, second / (constants.curvature * radius * radius + 1e-5f));
      }
      ASSERT_LE(std::fabs(n(x)), constants.supremum);
    }
    EXPECT_GT(closest, 0.3f);
  }
}

}  // namespace
}  // namespace tyndall::vm
