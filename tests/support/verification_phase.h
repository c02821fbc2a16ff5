// Truths about phase functions: their samplers' draws, and their values.
#pragma once

#include <random>

#include "optics/phase.h"
#include "support/verification.h"

namespace tyndall::support {

// The mean over 16 × 65,536 draws of a function of the cosine.
template <class F>
Estimate drawn(const optics::Phase& phase, F&& f) {
  std::vector<double> means;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> uniform(0.f, 1.f);
    double sum = 0;
    for (int i = 0; i < 65536; ++i) {
      const float u = uniform(random);
      sum += f(1 - static_cast<double>(phase.sample(u, uniform(random))));
    }
    means.push_back(sum / 65536);
  }
  return estimate_of(means);
}

inline void add_phase_rows(std::vector<VerificationRow>& rows) {
  using optics::Phase;
  const auto add = [&rows](std::string row, std::string way, double truth, double digits,
                           std::function<Estimate()> run) {
    rows.push_back({"Phase functions", std::move(row), std::move(way), truth, digits, std::move(run)});
  };
  struct Hg {
    float g;
    std::array<double, 3> cdf;
  };
  for (const Hg& hg : {Hg{0.3f, {.286037, .539717, .878406}}, Hg{0.85f, {.036140, .086520, .283812}}}) {
    const Phase phase = optics::HenyeyGreenstein{hg.g};
    const std::string name = "hg(" + short_number(hg.g) + ") ";
    const std::array<double, 3> cosines{0, 0.5, 0.9};
    for (std::size_t i = 0; i < 3; ++i)
      add(name + "P(cos <= " + short_number(cosines[i]) + ")", "sampled", hg.cdf[i], 5e-7,
          [=] { return drawn(phase, [&](double c) { return c <= cosines[i] ? 1.0 : 0.0; }); });
    add(name + "mean cosine", "sampled", hg.g, 1e-7,
        [=] { return drawn(phase, [](double c) { return c; }); });
    add(name + "second Legendre moment", "sampled", hg.g * hg.g, 1e-7,
        [=] { return drawn(phase, [](double c) { return 1.5 * c * c - 0.5; }); });
  }
  add("Rayleigh mean squared cosine", "sampled", 0.4, 0,
      [] { return drawn(optics::Rayleigh{}, [](double c) { return c * c; }); });
  const Phase droplets = optics::Droplets{10e-6f};
  add("droplets of 10 µm, mean cosine", "sampled", .86416, 5e-6,
      [=] { return drawn(droplets, [](double c) { return c; }); });
  add("droplets of 10 µm, p(90°)", "evaluated", .001726, 5e-7, [=] {
    return Estimate{Vec3d(droplets.eval(1)), {}};
  });
  add("droplets of 10 µm, p(180°)", "evaluated", .01271, 5e-6, [=] {
    return Estimate{Vec3d(droplets.eval(2)), {}};
  });
}

}  // namespace tyndall::support
