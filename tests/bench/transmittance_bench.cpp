// What the estimators of transmittance give for what they cost, on densities whose optical depth is known.
#include <fmt/format.h>

#include "bench.h"
#include "support/transmittance_measure.h"
#include "support/ways.h"

namespace tyndall {

void bench_transmittance() {
  constexpr int count = 1 << 16;
  fmt::print("{:28} {:>5} {:>14} {:>12} {:>12} {:>14} {:>14}\n", "density", "step", "method", "evaluations",
             "bias/T", "+-", "rmse/T");
  for (const support::KnownDensity& known : support::transmittance_densities())
    for (const double step : {0.4, 0.2, 0.1, 0.05, 0.025})
      for (const auto& [name, method] : support::all_transmittances()) {
        const auto m = support::measure_transmittance(known, method, step, count);
        const double truth = std::exp(-known.tau);
        fmt::print("{:28} {:5} {:>14} {:12.1f} {:11.3f}% {:9.3f}% {:9.2f}%\n", known.name, step, name,
                   m.evaluations, 100 * (m.mean / truth - 1), 100 * m.standard_error / truth,
                   100 * m.rmse / truth);
      }
}

}  // namespace tyndall
