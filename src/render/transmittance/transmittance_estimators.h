// Transmittance from estimates of optical depth: the formulas behind `--transmittance`, for one channel.
#pragma once

#include <cstdint>
#include <span>

namespace tyndall::render {

// Two independent estimates of one optical depth: e^-mean cos(half their difference). Its mean is e^-τ where
// the estimates are normal, whatever their variance; E[e^-x] alone is greater (Peters, SIGGRAPH Asia 2025).
// May be negative.
double jackknife(double x1, double x2);

// How many further estimates the power series is given: 0 with probability 0.9, else at least 2, each one
// after that with a probability that falls as 2 / k. `seed` names the draw. (Kettunen et al. 2021, section
// 6.2: Bhanot and Kennedy's roulette that stops early nine times in ten.)
std::uint32_t series_order(std::uint32_t seed);

// The power series of the exponential about one of the estimates, in unbiased powers of the others, averaged
// over which one it is about: mean e^-τ exactly, for any distribution of the estimates (Kettunen et al. 2021,
// equations 9 to 12). `x` holds 1 + series_order(…) independent estimates. May be negative.
double power_series(std::span<const double> x);

}  // namespace tyndall::render
