#include "render/march/phase_mixture.h"

#include <algorithm>
#include <array>

#include "base/check.h"

namespace tyndall::render {

namespace {

template <class NumberOf>
optics::Phase phase_function(const scene::PhaseLobe& lobe, const NumberOf& number) {
  std::array<float, optics::most_phase_parameters> parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k] = number(lobe.parameters[k]);
  return {lobe.kind, parameters};
}

}  // namespace

PhaseMixture::PhaseMixture(const compile::CompiledScene& world, const March& m, std::uint32_t segment) {
  const compile::CompiledMedium* alone = nullptr;
  int holding = 0;
  for (const Block& b : m.blocks)
    if (b.holds(segment)) alone = holding++ == 0 ? &world.media[world.volumes[b.volume].medium] : nullptr;
  if (alone != nullptr && alone->constant_phase) {
    lobes_.push_back({*alone->constant_phase, Rgb(1), 1});
    return;
  }
  Rgb total;
  for (const Block& b : m.blocks) {
    if (!b.holds(segment)) continue;
    const compile::CompiledMedium& medium = world.media[world.volumes[b.volume].medium];
    const auto output = [&](std::uint8_t k) { return m.output(b, k, segment); };
    const auto number = [&](const scene::PhaseLobe::Number& n) {
      return n.output ? output(*n.output) : n.value;
    };
    const Rgb sigma_s{output(medium.sigma_s[0]), output(medium.sigma_s[1]), output(medium.sigma_s[2])};
    for (const scene::PhaseLobe& lobe : medium.phase) {
      const Lobe out{phase_function(lobe, number), sigma_s * std::max(0.0f, number(lobe.weight)), 0};
      total += out.share;
      lobes_.push_back(out);
    }
  }
  float sum = 0;
  for (Lobe& lobe : lobes_) {
    for (std::size_t c = 0; c < 3; ++c) lobe.share[c] = total[c] > 0 ? lobe.share[c] / total[c] : 0.0f;
    lobe.probability = (lobe.share.x + lobe.share.y + lobe.share.z) / 3;
    sum += lobe.probability;
  }
  if (sum > 0)
    for (Lobe& lobe : lobes_) lobe.probability /= sum;
}

Rgb PhaseMixture::eval(float one_minus_cos) const {
  Rgb sum;
  for (const Lobe& lobe : lobes_) sum += lobe.share * lobe.phase.eval(one_minus_cos);
  return sum;
}

Rgb PhaseMixture::eval_softened(float one_minus_cos, float anisotropy) const {
  Rgb sum;
  for (const Lobe& lobe : lobes_) sum += lobe.share * lobe.phase.eval_softened(one_minus_cos, anisotropy);
  return sum;
}

float PhaseMixture::pdf(float one_minus_cos) const {
  float sum = 0;
  for (const Lobe& lobe : lobes_) sum += lobe.probability * lobe.phase.eval(one_minus_cos);
  return sum;
}

float PhaseMixture::sample(float u_lobe, float u0, float u1) const {
  CHECK(!lobes_.empty());
  std::size_t i = 0;
  while (i + 1 < lobes_.size() && u_lobe >= lobes_[i].probability) u_lobe -= lobes_[i++].probability;
  return lobes_[i].phase.sample(u0, u1);
}

}  // namespace tyndall::render
