// The family of phase functions: their table, and one of them evaluated and sampled.
#include "optics/phase.h"

#include <array>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::optics {

namespace {

template <class Function>
PhaseInfo info_of() {
  PhaseInfo info{phase_kind<Function>, Function::keyword, Function::documentation, Function::example, {}};
  Function::fields([&](auto, const PhaseParameter& parameter) { info.parameters.push_back(parameter); });
  return info;
}

template <class Function>
Phase made(std::span<const float, most_phase_parameters> parameters) {
  Function function;
  std::size_t i = 0;
  Function::fields([&](auto member, const PhaseParameter&) { function.*member = parameters[i++]; });
  return Phase(function);
}

// For each kind.
template <class... All>
std::vector<PhaseInfo> infos(const std::variant<All...>*) {
  return {info_of<All>()...};
}
using Make = Phase (*)(std::span<const float, most_phase_parameters>);
template <class... All>
constexpr std::array<Make, sizeof...(All)> makers(const std::variant<All...>*) {
  return {made<All>...};
}

}  // namespace

std::span<const PhaseInfo> phase_functions() {
  static const std::vector<PhaseInfo> all = infos(static_cast<const PhaseFunction*>(nullptr));
  return all;
}

const PhaseInfo& info(PhaseKind kind) { return phase_functions()[static_cast<std::size_t>(kind)]; }

Phase::Phase(PhaseKind kind, std::span<const float, most_phase_parameters> parameters)
    : Phase(makers(static_cast<const PhaseFunction*>(nullptr))[static_cast<std::size_t>(kind)](parameters)) {}

float Phase::eval(float m) const {
  return std::visit([m](const auto& f) { return f.eval(m); }, function_);
}

float Phase::eval_softened(float m, float anisotropy) const {
  return std::visit(
      [&](const auto& f) {
        if constexpr (requires { f.eval_softened(m, anisotropy); })
          return f.eval_softened(m, anisotropy);
        else
          return (1 - anisotropy) * static_cast<float>(inv_4pi) + anisotropy * f.eval(m);
      },
      function_);
}

float Phase::sample(float u0, float u1) const {
  return std::visit([&](const auto& f) { return f.sample(u0, u1); }, function_);
}

float Phase::mean_cosine() const {
  return std::visit([](const auto& f) { return f.mean_cosine(); }, function_);
}

Vec3f rotate_from(const Vec3f& w, float m, float phi) {
  const Frame<float> frame = Frame<float>::around(w);
  const float sine = safe_sqrt(m * (2 - m));
  const Vec3f sideways = frame.x * (sine * std::cos(phi)) + frame.y * (sine * std::sin(phi));
  return normalize(w - w * m + sideways);
}

float one_minus_cos(const Vec3f& a, const Vec3f& b) { return 0.5f * length_squared(a - b); }

}  // namespace tyndall::optics
