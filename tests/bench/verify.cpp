// docs/verification.md: published and computed results compared with those of the renderer.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench.h"
#include "support/verification_rows.h"
#include "verify_methods.h"

namespace tyndall {

namespace {

constexpr std::string_view introduction = R"(# Verification

This page compares the renderer with published and computed results, and its methods with each other.
`scripts/bench verify > docs/verification.md` makes it. The tests run the same rows
(`tests/laws/verification_test.cpp`, `tests/laws/methods_test.cpp`); the reference values are in `tests/support`.

Every row is rendered or sampled with 16 seeds. `result` is the mean and `±` its standard error; for transmittance they are those
of 32,768 estimates along one ray. A row passes if its result differs from the exact value by at most four standard errors
and an allowance. The allowance is stated beforehand: the digits of the exact value, and for ray marching a bound of its bias.

| method | is |
| --- | --- |
| Product, Mis, Density, Equiangular | decoupled ray marching with this `--distance` |
| Jackknife | Product with `--transmittance jackknife` |
| BruteForce, Stochastic | this `--method` |
| Tracking, TrackingDensity, TrackingEquiangular | `--method tracking --transmittance series` with `--distance mis`, `density` and `equiangular` |
| march, jackknife, ratio, residual-ratio, series | this `--transmittance` |
| sampled, evaluated | a phase function's samples, its value |
| Reference | a separate unbiased renderer (`src/reference`) |

| symbol | is |
| --- | --- |
| sigma_t, tau, tau_r | extinction, optical thickness, optical radius |
| c, g | albedo, mean cosine of the phase function |
| D | distance of the light from the ray |
| mu | cosine of the angle of view to the normal |
| R, T, Rd, Td | reflected and transmitted light, of light from straight above and (d) of diffuse light |
| b | distance of the ray from the centre of the density |
| rho | reflectance of the walls |

| table | what it shows |
| --- | --- |
| Emission | the emission of a medium, along a ray: where it is proportional to extinction, and where it grows along the ray |
| Airlight | a point light in homogeneous fog, light scattered once |
| Slab | a plane-parallel medium, lit from above; van de Hulst's tables. With a density of 3x² in depth the results must be the same |
| Half space | a slab too thick for light to pass; Chandrasekhar's H function |
| Mean path | the mean length of paths in a body that only scatters is 4V/S |
| White furnace, Lambertian box | a medium that absorbs nothing in a white environment, or in a box whose walls reflect rho and emit 1 − rho: radiance is 1 everywhere |
)";

// The rows of each table together, the tables in the order of their first rows.
std::vector<support::VerificationRow> rows_by_table() {
  std::vector<support::VerificationRow> rows = support::verification_rows();
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < rows.size(); ++i) first.emplace(rows[i].table, i);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const auto& a, const auto& b) { return first.at(a.table) < first.at(b.table); });
  return rows;
}

}  // namespace

bool print_verification() {
  fmt::print("{}", introduction);
  std::string table;
  int failed = 0, rows = 0;
  for (const support::VerificationRow& row : rows_by_table()) {
    if (row.table != table) {
      table = row.table;
      fmt::print(
          "\n## {}\n\n| case | method | exact | result | ± | difference | |\n"
          "| --- | --- | --- | --- | --- | --- | --- |\n",
          table);
    }
    const support::Verified v = verify(row);
    const double mean = v.estimate.mean.y, error = v.estimate.standard_error.y;
    fmt::print("| {} | {} | {:.8g} | {:.8g} | {:.1e} | {:+.3f} % | {} |\n", row.row, row.way, row.truth, mean,
               error, 100 * (mean / row.truth - 1), v.passed ? "passes" : "**fails**");
    std::fflush(stdout);
    failed += !v.passed;
    ++rows;
  }
  fmt::print("\n{} rows, {} of which fail.\n", rows, failed);
  return print_methods() && failed == 0;
}

}  // namespace tyndall
