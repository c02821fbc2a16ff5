// Whether two noisy pictures can be of the same light: z-tests of pixels and of means over blocks, for
// pictures that tell the variance of their pixels (channels variance.R, variance.G and variance.B).
//
// The variances are estimates from few groups of samples, so that what is tested is Student's t with the
// degrees of freedom of Welch and Satterthwaite. Where a rare bright sample makes up much of a variance,
// these are few, and more is accepted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "image/image.h"

namespace tyndall::image {

struct ZTest {
  static constexpr double significance_of_pixels = 0.01;  // of all pixels and channels together (Šidák)
  static constexpr double wanted_share = 0.9975;          // of pixels' channels that must be accepted
  static constexpr double significance_of_means = 0.001;  // of the whole and of all blocks together

  std::uint64_t pixels = 0, accepted = 0;  // counted once a channel
  double p_of_means = 1;                   // of the whole and of all blocks together
  // The mean that is least likely, of the whole or of a block.
  struct Mean {
    int x = 0, y = 0, width = 0, height = 0;
    std::string channel;
    double value = 0, reference = 0;
    double standard_error = 0;  // of their difference
    double t() const { return standard_error > 0 ? (value - reference) / standard_error : 0; }
  };
  Mean least_likely{};

  double accepted_share() const {
    return pixels > 0 ? static_cast<double>(accepted) / static_cast<double>(pixels) : 1;
  }
  bool pixels_agree() const { return accepted_share() >= wanted_share; }
  bool means_agree(double significance = significance_of_means) const { return p_of_means >= significance; }
  bool agrees() const { return pixels_agree() && means_agree(); }
};

// Tests R, G and B of two pictures of one size; nothing when they do not both have these, or neither has
// their variance. One that has none is taken as exact. The pictures must come from independent random
// numbers.
std::optional<ZTest> z_test(const Image& x, const Image& reference);

// "at x 8..15, y 0..7", "in the whole picture".
std::string describe_place(const ZTest::Mean& mean, const Image& image);

}  // namespace tyndall::image
