// How far renders of a setting are from the truth, bias and noise apart, from a few independent renders and
// an unbiased reference whose own noise is accounted for.
//
// Let a_i be independent renders and r_k independent parts of the reference. Products of errors that share
// nothing, (a_i - r_k)(a_j - r_l) with i ≠ j and k ≠ l, have the mean (E a - E r)²: the square of the bias,
// without any noise. Their mean over all i, j, k, l is a U-statistic, of which sums of a_i and a_i² are
// enough.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tyndall::tools {

// Sums of independent renders, for each value of the picture.
class RenderSums {
 public:
  void add(std::span<const float> values);

  int count() const { return count_; }
  std::size_t size() const { return sum_.size(); }
  double mean(std::size_t i) const { return sum_[i] / count_; }
  // Without bias: of the square of the expected value, and of the variance of one render. Two renders or
  // more.
  double squared_mean(std::size_t i) const {
    return (sum_[i] * sum_[i] - squares_[i]) / (static_cast<double>(count_) * (count_ - 1));
  }
  double variance(std::size_t i) const { return (squares_[i] - sum_[i] * sum_[i] / count_) / (count_ - 1); }

 private:
  int count_ = 0;
  std::vector<double> sum_, squares_;
};

// A converged picture as the mean of independent parts of one weight. A single part counts as the truth.
struct Reference {
  std::vector<std::vector<float>> parts{};
  std::size_t size() const { return parts.empty() ? 0 : parts[0].size(); }
};
std::vector<float> mean_of(const Reference& reference);

// With the interval that holds the truth with a probability of 95 %, as far as pixels err independently.
struct Estimate {
  double value = 0, low = 0, high = 0;
};

// Squares are relative as those of compare: mean over the values of the picture of …/(r² + ε), with
// ε = 0.01 mean(r)².
struct Accuracy {
  Estimate squared_bias;  // may be negative: it is estimated without bias
  Estimate noise;         // relative variance of one render
  Estimate relmse;        // of one render, as compare tells it, less the noise of the reference: their sum
  Estimate mean_bias;     // of the mean of the picture, relative, with its sign
};

// The root of an estimated square: what is below 0 is 0.
Estimate root(const Estimate& square);

// A reference made ready to be compared with.
class WeighedReference {
 public:
  // `channels` values a pixel.
  explicit WeighedReference(const Reference& reference, std::size_t channels = 3);

  // Of renders with the same number of values, two or more.
  Accuracy accuracy_of(const RenderSums& renders) const;
  // Of the mean of the reference itself: the root of its relative variance, from the spread of its parts; 0
  // of a single part, for which nothing is known.
  const Estimate& error() const { return error_; }

 private:
  std::size_t channels_;
  // For each value the weight w, the true value r, and w r and w r²: their means over the ways to part the
  // reference.
  std::vector<double> weights_, means_, light_, squares_;
  Estimate error_;
};

}  // namespace tyndall::tools
