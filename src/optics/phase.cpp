// Evaluating and sampling the phase functions.
#include "optics/phase.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::optics {

namespace {

constexpr float inv_4pi_f = static_cast<float>(inv_4pi);

constexpr double greatest_g = 0.9999;
constexpr double least_droplet = 5e-6, greatest_droplet = 50e-6;  // [m], of the fit

template <class T>
T clamp_g(T g) {
  return std::clamp(g, T(-greatest_g), T(greatest_g));
}

// |1 - g e^(i theta)|² = (1 - g)² + 2 g m. For g < 0 the peak is at m = 2, and 2 - m is exact there.
template <class T>
T hg_denominator(T g, T m) {
  return g >= 0 ? sqr(1 - g) + 2 * g * m : sqr(1 + g) - 2 * g * (2 - m);
}

// Henyey and Greenstein's 1 - cos whose cumulative probability, counted from straight back, is u; 1 - u is
// given apart because near the peak it holds the digits (transport §7). For g < 0 the mirror image: its peak
// is at m = 2.
template <class T>
T hg_inverse(T g, T u, T one_minus_u) {
  if (g < 0) return 2 - hg_inverse(-g, one_minus_u, u);
  const T denominator = (1 - g) * one_minus_u + (1 + g) * u;
  return std::min(T(2), 2 * sqr(1 - g) * one_minus_u * (1 + g * u) / sqr(denominator));
}

float rayleigh_eval(float m) { return 0.75f * inv_4pi_f * (1 + sqr(1 - m)); }

// Inverts u = 1/2 + 3/8 (c + c³/3), Cardano's form for one real root.
float rayleigh_sample(float u) {
  const double q = 4.0 * u - 2;
  const double root = std::cbrt(std::abs(q) + std::sqrt(q * q + 1));
  const double cosine = std::copysign(root - 1 / root, q);
  return static_cast<float>(std::clamp(1 - cosine, 0.0, 2.0));
}

// The normaliser of Draine's phase function: the mean of 1 + a cos² under Henyey and Greenstein.
float draine_norm(float g, float a) { return 1 + a * (1 + 2 * g * g) / 3; }

// Draine 2003, eq. 6: Henyey and Greenstein times (1 + a cos²).
float draine_eval(float g, float a, float m) {
  return hg_eval(g, m) * (1 + a * sqr(1 - m)) / draine_norm(g, a);
}

// Draws as in Jendersie and d'Eon 2023 by inverting the cumulative distribution, but in the variable s = 2v
// where v is the cumulative probability of Henyey and Greenstein alone. There ∫ cos² ds is
//   s (A³ - A² K s + A K² s²/3 + g E² s³/4) / (A + g s)³,  A = 1 - g, K = 1 - g + g², E = 1 + g²,
// which stays exact for g -> 0, where their root formula divides by zero. Newton's steps, kept in a bracket.
float draine_sample(float g_float, float a_float, float u) {
  const double g = clamp_g<double>(g_float), a = a_float;
  const double A = 1 - g, K = 1 - g + g * g, E = 1 + g * g;
  const double target = 2.0 * u * (1 + a * (1 + 2 * g * g) / 3);
  double low = 0, high = 2, s = 2.0 * u;
  for (int i = 0; i < 60; ++i) {
    const double d = A + g * s;
    const double polynomial = A * A * A + s * (-A * A * K + s * (A * K * K / 3 + s * g * E * E / 4));
    const double error = s + a * s * polynomial / (d * d * d) - target;
    (error < 0 ? low : high) = s;
    const double cosine = 1 - hg_inverse(g, 0.5 * s, 1 - 0.5 * s);
    const double newton = s - error / (1 + a * cosine * cosine);
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    const bool converged = std::abs(next - s) <= 1e-14;
    s = next;
    if (converged) break;
  }
  return static_cast<float>(hg_inverse(g, 0.5 * s, 1 - 0.5 * s));
}

float draine_mean_cosine(float g, float a) { return g * (1 + a * (3 + 2 * g * g) / 5) / draine_norm(g, a); }

// Parameters of the fit to Mie scattering of water droplets, Jendersie and d'Eon 2023, eqs. 4-7.
struct Droplets {
  float g_hg, g_draine, a, weight_draine;

  explicit Droplets(float diameter_metres) {
    const double d = std::clamp(static_cast<double>(diameter_metres), least_droplet, greatest_droplet) * 1e6;
    g_hg = static_cast<float>(std::exp(-0.0990567 / (d - 1.67154)));
    g_draine = static_cast<float>(std::exp(-2.20679 / (d + 3.91029) - 0.428934));
    a = static_cast<float>(std::exp(3.62489 - 8.29288 / (d + 5.52825)));
    weight_draine = static_cast<float>(std::exp(-0.599085 / (d - 0.641583) - 0.665888));
  }
};

}  // namespace

std::string_view keyword(PhaseKind kind) {
  switch (kind) {
    case PhaseKind::isotropic:
      return "isotropic";
    case PhaseKind::rayleigh:
      return "rayleigh";
    case PhaseKind::hg:
      return "hg";
    case PhaseKind::draine:
      return "draine";
    case PhaseKind::droplets:
      return "droplets";
  }
  return {};
}

std::span<const PhaseParameter> parameters(PhaseKind kind) {
  static constexpr PhaseParameter of_hg[] = {{"g", -greatest_g, greatest_g}};
  static constexpr PhaseParameter of_draine[] = {{"g", -greatest_g, greatest_g}, {"a", 0, 1e6}};
  static constexpr PhaseParameter of_droplets[] = {{"diameter", least_droplet, greatest_droplet}};
  switch (kind) {
    case PhaseKind::isotropic:
    case PhaseKind::rayleigh:
      return {};
    case PhaseKind::hg:
      return of_hg;
    case PhaseKind::draine:
      return of_draine;
    case PhaseKind::droplets:
      return of_droplets;
  }
  return {};
}

float hg_eval(float g, float m) {
  g = clamp_g(g);
  const float denominator = hg_denominator(g, m);
  return inv_4pi_f * (1 - g) * (1 + g) / (denominator * std::sqrt(denominator));
}

float hg_sample(float g, float u) { return hg_inverse(clamp_g(g), u, 1 - u); }

float Phase::eval(float m) const {
  switch (kind) {
    case PhaseKind::isotropic:
      return inv_4pi_f;
    case PhaseKind::rayleigh:
      return rayleigh_eval(m);
    case PhaseKind::hg:
      return hg_eval(parameters[0], m);
    case PhaseKind::draine:
      return draine_eval(clamp_g(parameters[0]), parameters[1], m);
    case PhaseKind::droplets: {
      const Droplets fit(parameters[0]);
      return lerp(hg_eval(fit.g_hg, m), draine_eval(fit.g_draine, fit.a, m), fit.weight_draine);
    }
  }
  return 0;
}

float Phase::eval_softened(float m, float anisotropy) const {
  switch (kind) {
    case PhaseKind::isotropic:
      return inv_4pi_f;
    case PhaseKind::rayleigh:
      return draine_eval(0, anisotropy, m);
    case PhaseKind::hg:
      return hg_eval(anisotropy * parameters[0], m);
    case PhaseKind::draine:
      return draine_eval(clamp_g(anisotropy * parameters[0]), anisotropy * parameters[1], m);
    case PhaseKind::droplets: {
      const Droplets fit(parameters[0]);
      return lerp(hg_eval(anisotropy * fit.g_hg, m),
                  draine_eval(anisotropy * fit.g_draine, anisotropy * fit.a, m), fit.weight_draine);
    }
  }
  return 0;
}

float Phase::sample(float u0, float u1) const {
  switch (kind) {
    case PhaseKind::isotropic:
      return 2 - 2 * u0;
    case PhaseKind::rayleigh:
      return rayleigh_sample(u0);
    case PhaseKind::hg:
      return hg_sample(parameters[0], u0);
    case PhaseKind::draine:
      return draine_sample(parameters[0], parameters[1], u0);
    case PhaseKind::droplets: {
      const Droplets fit(parameters[0]);
      return u1 < fit.weight_draine ? draine_sample(fit.g_draine, fit.a, u0) : hg_sample(fit.g_hg, u0);
    }
  }
  return 0;
}

float Phase::mean_cosine() const {
  switch (kind) {
    case PhaseKind::isotropic:
    case PhaseKind::rayleigh:
      return 0;
    case PhaseKind::hg:
      return clamp_g(parameters[0]);
    case PhaseKind::draine:
      return draine_mean_cosine(clamp_g(parameters[0]), parameters[1]);
    case PhaseKind::droplets: {
      const Droplets fit(parameters[0]);
      return lerp(fit.g_hg, draine_mean_cosine(fit.g_draine, fit.a), fit.weight_draine);
    }
  }
  return 0;
}

Vec3f rotate_from(const Vec3f& w, float m, float phi) {
  const Frame<float> frame = Frame<float>::around(w);
  const float sine = safe_sqrt(m * (2 - m));
  const Vec3f sideways = frame.x * (sine * std::cos(phi)) + frame.y * (sine * std::sin(phi));
  return normalize(w - w * m + sideways);
}

float one_minus_cos(const Vec3f& a, const Vec3f& b) { return 0.5f * length_squared(a - b); }

}  // namespace tyndall::optics
