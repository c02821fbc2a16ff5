#include "tools/measure/accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::tools {
namespace {

// Intervals come from the spread of estimates from disjoint sets of pixels. Of so many pixels in a row each
// set gets one, by chance, so that each is a fair sample of the picture.
constexpr std::size_t pixel_sets = 20;
constexpr double quantile = 2.093;  // Student's t, 19 degrees of freedom, 97.5 %

// SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

using Sets = std::array<std::size_t, pixel_sets>;

// The sets of the pixels of one row of `pixel_sets`: a permutation that depends on the row's number.
Sets sets_of(std::size_t row) {
  Sets sets;
  for (std::size_t i = 0; i < pixel_sets; ++i) sets[i] = i;
  for (std::size_t i = pixel_sets - 1; i > 0; --i)
    std::swap(sets[i], sets[mixed(row * pixel_sets + i) % (i + 1)]);
  return sets;
}

// A mean over all values, and over those of each set.
class SetMeans {
 public:
  explicit SetMeans(std::size_t channels) : channels_(channels) {}
  void add(std::size_t i, double value) {
    const std::size_t pixel = i / channels_, row = pixel / pixel_sets;
    if (row != row_ || count_ == 0) row_ = row, sets_ = sets_of(row);
    const std::size_t set = sets_[pixel % pixel_sets];
    sums_[set] += value;
    ++counts_[set];
    sum_ += value;
    ++count_;
  }
  Estimate estimate() const {
    if (count_ == 0) return {};
    const double mean = sum_ / static_cast<double>(count_);
    double squares = 0, used = 0;
    for (std::size_t s = 0; s < pixel_sets; ++s) {
      if (counts_[s] == 0) continue;
      squares += sqr(sums_[s] / static_cast<double>(counts_[s]) - mean);
      ++used;
    }
    const double error = used > 1 ? quantile * std::sqrt(squares / (used * (used - 1))) : infinity;
    return {mean, mean - error, mean + error};
  }

 private:
  std::size_t channels_, row_ = 0, count_ = 0;
  Sets sets_{};
  std::array<double, pixel_sets> sums_{};
  std::array<std::size_t, pixel_sets> counts_{};
  double sum_ = 0;
};

// A reference of which some parts say how errors are weighted and the others what is true: were they the same
// parts, a part that is too bright by chance would weigh less just where it errs.
struct Split {
  std::vector<std::size_t> weighing, comparing;
};

// Every pair of parts is compared with, and the others weigh. Too few parts do both.
std::vector<Split> splits_of(std::size_t parts) {
  std::vector<Split> splits;
  for (std::size_t k = 0; parts >= 4 && k < parts; ++k)
    for (std::size_t l = k + 1; l < parts; ++l) {
      splits.push_back({{}, {k, l}});
      for (std::size_t j = 0; j < parts; ++j)
        if (j != k && j != l) splits.back().weighing.push_back(j);
    }
  if (!splits.empty()) return splits;
  Split all;
  for (std::size_t k = 0; k < parts; ++k) all.weighing.push_back(k), all.comparing.push_back(k);
  return {all};
}

struct PartMoments {
  double mean = 0, squared_mean = 0, variance_of_part = 0;
};

PartMoments moments(const Reference& reference, const std::vector<std::size_t>& parts, std::size_t i) {
  const auto n = static_cast<double>(parts.size());
  double sum = 0, squares = 0;
  for (const std::size_t k : parts) {
    const double value = reference.parts[k][i];
    sum += value;
    squares += value * value;
  }
  if (parts.size() < 2) return {sum, sum * sum, 0};
  return {sum / n, (sum * sum - squares) / (n * (n - 1)), (squares - sum * sum / n) / (n - 1)};
}

// 1/(r² + ε) of one split, asked value by value. The mean of a function of something noisy is not the
// function of its mean: what that adds in the first order is taken away again by the jackknife (Quenouille
// 1956).
class Weights {
 public:
  Weights(const Reference& reference, const Split& split)
      : reference_(reference), parts_(split.weighing), is_whole_(parts_.size() == reference.parts.size()) {
    double sum = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) sum += moments(reference_, parts_, i).mean;
    floor_ = 0.01 * sqr(sum / static_cast<double>(reference.size()));
  }
  double operator()(std::size_t i) const {
    const double mean = moments(reference_, parts_, i).mean;
    // The weights of compare, where the reference is too little known for better ones.
    if (is_whole_) return weight(mean);
    const auto n = static_cast<double>(parts_.size());
    double others = 0;
    for (const std::size_t k : parts_)
      others += weight((n * mean - double{reference_.parts[k][i]}) / (n - 1)) / n;
    // Where the reference is far too noisy for that, the correction would be larger than what it corrects.
    return std::clamp(n * weight(mean) - (n - 1) * others, weight(mean) / 2, 2 * weight(mean));
  }

 private:
  // 0 where all is black: an error of nothing is none.
  double weight(double value) const {
    const double scale = sqr(value) + floor_;
    return scale > 0 ? 1 / scale : 0;
  }

  const Reference& reference_;
  const std::vector<std::size_t>& parts_;
  bool is_whole_;
  double floor_ = 0;
};

}  // namespace

void RenderSums::add(std::span<const float> values) {
  if (count_++ == 0) sum_.assign(values.size(), 0), squares_.assign(values.size(), 0);
  CHECK_EQ(values.size(), sum_.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    sum_[i] += value;
    squares_[i] += value * value;
  }
}

std::vector<float> mean_of(const Reference& reference) {
  std::vector<float> mean(reference.size());
  for (std::size_t i = 0; i < mean.size(); ++i) {
    double sum = 0;
    for (const std::vector<float>& part : reference.parts) sum += part[i];
    mean[i] = static_cast<float>(sum / static_cast<double>(reference.parts.size()));
  }
  return mean;
}

Estimate root(const Estimate& square) {
  return {safe_sqrt(square.value), safe_sqrt(square.low), safe_sqrt(square.high)};
}

WeighedReference::WeighedReference(const Reference& reference, std::size_t channels)
    : channels_(channels),
      weights_(reference.size()),
      means_(reference.size()),
      light_(reference.size()),
      squares_(reference.size()) {
  const std::vector<Split> splits = splits_of(reference.parts.size());
  std::vector<Weights> weights;
  for (const Split& split : splits) weights.emplace_back(reference, split);
  const auto count = static_cast<double>(splits.size()), parts = static_cast<double>(reference.parts.size());
  SetMeans error(channels);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    double variance = 0;
    for (std::size_t s = 0; s < splits.size(); ++s) {
      const double w = weights[s](i) / count;
      const PartMoments r = moments(reference, splits[s].comparing, i);
      weights_[i] += w;
      means_[i] += r.mean / count;
      light_[i] += w * r.mean;
      squares_[i] += w * r.squared_mean;
      variance += w * r.variance_of_part;
    }
    error.add(i, variance / parts);
  }
  if (parts > 1) error_ = root(error.estimate());
}

Accuracy WeighedReference::accuracy_of(const RenderSums& renders) const {
  CHECK_EQ(renders.size(), weights_.size());
  CHECK_GE(renders.count(), 2);
  SetMeans bias(channels_), noise(channels_), both(channels_), difference(channels_);
  double light = 0;
  for (std::size_t i = 0; i < renders.size(); ++i) {
    const double mean = renders.mean(i);
    const double squared_bias = weights_[i] * renders.squared_mean(i) - 2 * mean * light_[i] + squares_[i];
    const double variance = weights_[i] * renders.variance(i);
    bias.add(i, squared_bias);
    noise.add(i, variance);
    both.add(i, squared_bias + variance);
    difference.add(i, mean - means_[i]);
    light += means_[i] / static_cast<double>(renders.size());
  }
  Estimate mean_bias = difference.estimate();
  for (double* end : {&mean_bias.value, &mean_bias.low, &mean_bias.high}) *end = light > 0 ? *end / light : 0;
  return {bias.estimate(), noise.estimate(), both.estimate(), mean_bias};
}

}  // namespace tyndall::tools
