// Phase functions: the distribution of the direction after a scattering, per steradian.
//
// cos_theta is between propagation directions: +1 is straight on. Every `eval` integrates to 1 over the
// sphere, and `sample` draws from exactly that density (so value / pdf = 1).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/vec.h"

namespace tyndall::optics {

enum class PhaseKind : std::uint8_t { isotropic, rayleigh, hg, draine, droplets };
std::string_view keyword(PhaseKind kind);

// A parameter and its range, both ends included.
struct PhaseParameter {
  std::string_view name;
  double lowest, highest;
};
// In the order of Phase::parameters.
std::span<const PhaseParameter> parameters(PhaseKind kind);

// Henyey and Greenstein 1941. g in [-0.9999, 0.9999], and clamped to it: nearer to 1 the peak is narrower
// than directions in floats are fine. Written in m = 1 - cos_theta, which keeps full precision for forward
// peaks (transport §7).
float hg_eval(float g, float one_minus_cos);
// Draws m = 1 - cos_theta in [0, 2] for u in [0, 1).
float hg_sample(float g, float u);

// One lobe with its parameters settled: a phase function.
struct Phase {
  PhaseKind kind = PhaseKind::isotropic;
  std::array<float, 2> parameters{};  // hg: g; draine: g, a; droplets: diameter [m]

  // Density per steradian at m = 1 - cos_theta.
  float eval(float one_minus_cos) const;
  // Draws m = 1 - cos_theta; two uniform numbers (mixtures need the second).
  float sample(float u0, float u1) const;
  float mean_cosine() const;
  // This function nearer to the isotropic one: its mean cosines and the like times `anisotropy`, in [0, 1].
  float eval_softened(float one_minus_cos, float anisotropy) const;
};

// The direction at 1 - cos = m and azimuth phi from the unit direction w.
Vec3f rotate_from(const Vec3f& w, float one_minus_cos, float phi);
// 1 - cos of the angle between two unit directions, from |a - b|^2 / 2: no cancellation for small angles.
float one_minus_cos(const Vec3f& a, const Vec3f& b);

}  // namespace tyndall::optics
