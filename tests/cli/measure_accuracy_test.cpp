// Bias and noise apart: estimators with known errors, against what is estimated of them.
#include "tools/measure/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "image/compare.h"

namespace tyndall::test {
namespace UNNAMED {

using tools::Accuracy, tools::Estimate, tools::Reference, tools::RenderSums, tools::WeighedReference;

constexpr int columns = 48, lines = 27;
constexpr std::size_t value_count = 3 * columns * lines;

// A picture with dark and bright parts.
std::vector<double> true_picture() {
  std::vector<double> values(value_count);
  for (std::size_t i = 0; i < value_count; ++i)
    values[i] = 0.05 + std::pow(std::sin(0.011 * static_cast<double>(i)), 2.0);
  return values;
}

// Renders of it that are wrong by `bias` times a pattern, and whose noise is that of few bright paths:
// exponentially distributed around the value.
struct Renderer {
  double bias = 0, noise = 0;

  double expected(std::size_t i, double truth) const {
    return truth * (1 + bias * (1 + std::cos(0.003 * static_cast<double>(i))));
  }
  std::vector<float> render(const std::vector<double>& truth, std::mt19937_64& random) const {
    std::exponential_distribution<double> bright(1);
    std::vector<float> values(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double mean = expected(i, truth[i]);
      values[i] = static_cast<float>(mean * (1 + noise * (bright(random) - 1)));
    }
    return values;
  }
};

Accuracy truth_of(const Renderer& renderer, const std::vector<double>& truth) {
  double mean = 0, bias = 0, noise = 0, difference = 0;
  for (const double value : truth) mean += value / value_count;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double scale = truth[i] * truth[i] + 0.01 * mean * mean, expected = renderer.expected(i, truth[i]);
    bias += std::pow(expected - truth[i], 2) / scale / value_count;
    noise += std::pow(expected * renderer.noise, 2) / scale / value_count;
    difference += (expected - truth[i]) / mean / value_count;
  }
  return {{bias}, {noise}, {bias + noise}, {difference}};
}

Accuracy estimated(const Renderer& renderer, int renders, double reference_noise, std::uint64_t seed) {
  const std::vector<double> truth = true_picture();
  std::mt19937_64 random(seed);
  RenderSums sums;
  for (int i = 0; i < renders; ++i) sums.add(renderer.render(truth, random));
  Reference reference;
  for (int k = 0; k < 6; ++k) reference.parts.push_back(Renderer{0, reference_noise}.render(truth, random));
  return WeighedReference(reference).accuracy_of(sums);
}

// 95 of 100 intervals are expected to hold the truth; fewer than 90 happen once in 75 times, and here the
// seeds are given.
TEST(MeasuredAccuracy, IntervalsHoldTheTruth) {
  const struct {
    Renderer renderer;
    int renders;
    double reference_noise;
  } rows[] = {{{0.03, 0.2}, 4, 0.1}, {{0, 0.3}, 4, 0.2}, {{0.1, 0.5}, 2, 0.02}, {{-0.02, 0.05}, 8, 0.05}};
  for (const auto& row : rows) {
    const Accuracy truth = truth_of(row.renderer, true_picture());
    Accuracy mean{};
    int held[4] = {};
    constexpr int trials = 100;
    for (std::uint64_t seed = 1; seed <= trials; ++seed) {
      const Accuracy found = estimated(row.renderer, row.renders, row.reference_noise, seed);
      int k = 0;
      for (const auto part :
           {&Accuracy::squared_bias, &Accuracy::noise, &Accuracy::relmse, &Accuracy::mean_bias}) {
        const Estimate& e = found.*part;
        held[k++] += e.low <= (truth.*part).value && (truth.*part).value <= e.high;
        (mean.*part).value += e.value / trials;
        (mean.*part).high += (e.high - e.low) / 2 / trials;
      }
    }
    for (const int count : held) EXPECT_GE(count, 90) << row.renderer.bias << " " << row.renderer.noise;
    // The mean of a hundred is ten times as sure.
    EXPECT_NEAR(mean.squared_bias.value, truth.squared_bias.value, 0.2 * mean.squared_bias.high);
    EXPECT_NEAR(mean.noise.value, truth.noise.value, 0.2 * mean.noise.high);
  }
}

// Otherwise noise would count as bias: the square of the error of a mean of four is a quarter of the noise.
TEST(MeasuredAccuracy, NoiseIsNoBias) {
  const Accuracy found = estimated({0, 0.4}, 4, 0.4, 7);
  EXPECT_LT(found.squared_bias.low, 0);
  EXPECT_LT(found.squared_bias.high, found.noise.value / 20);
}

TEST(MeasuredAccuracy, OfACertainReferenceItIsWhatCompareTells) {
  const std::vector<double> truth = true_picture();
  std::mt19937_64 random(3);
  const auto picture = [](const std::vector<float>& values) {
    return image::Image{columns, lines, {"R", "G", "B"}, values};
  };
  const std::vector<float> reference(truth.begin(), truth.end());
  RenderSums sums;
  double compared = 0, mean = 0, reference_mean = 0;
  for (int i = 0; i < 5; ++i) {
    const std::vector<float> render = Renderer{0.05, 0.3}.render(truth, random);
    sums.add(render);
    const image::Comparison comparison = image::compare(picture(render), picture(reference));
    compared += comparison.relative_mse / 5;
    mean += comparison.mean / 5;
    reference_mean = comparison.reference_mean;
  }
  const Accuracy found = WeighedReference({{reference}}).accuracy_of(sums);
  EXPECT_NEAR(found.relmse.value, compared, 1e-9 * compared);
  EXPECT_NEAR(found.mean_bias.value, mean / reference_mean - 1, 1e-9);
  EXPECT_EQ(WeighedReference({{reference}}).error().value, 0);
}

TEST(MeasuredAccuracy, TheErrorOfAReferenceFollowsFromItsParts) {
  const std::vector<double> truth = true_picture();
  std::mt19937_64 random(5);
  for (const int parts : {4, 6}) {
    Reference reference;
    for (int k = 0; k < parts; ++k) reference.parts.push_back(Renderer{0, 0.1}.render(truth, random));
    const double expected = std::sqrt(truth_of({0, 0.1}, truth).noise.value / parts);
    const Estimate found = WeighedReference(reference).error();
    EXPECT_NEAR(found.value, expected, 0.05 * expected) << parts;
    EXPECT_LT(found.low, found.value);
    EXPECT_GT(found.high, found.value);
  }
}

// What is black has no light to be relative to, and no error.
TEST(MeasuredAccuracy, BlackPicturesHaveNoError) {
  const std::vector<float> black(60, 0.0f);
  RenderSums sums;
  sums.add(black);
  sums.add(black);
  const Accuracy found = WeighedReference({{black, black, black}}).accuracy_of(sums);
  EXPECT_EQ(found.relmse.value, 0);
  EXPECT_EQ(found.mean_bias.value, 0);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
