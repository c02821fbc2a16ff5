// docs/verification.md: published truths against what the renderer gives.
#include <fmt/format.h>

#include <string>

#include "bench.h"
#include "support/verification_rows.h"
#include "verify_methods.h"

namespace tyndall {

bool print_verification() {
  fmt::print(
      "# Verification\n\n"
      "Published and computed truths against what the renderer gives. Every line is rendered or drawn "
      "with 16 seeds\n"
      "(transmittance: 32,768 estimates along one ray); the error is the standard error of their mean. A "
      "line holds when it is within four of these and an allowance "
      "stated beforehand: the\n"
      "truth's digits, and for the marching ways a bound of their bias. The tables of the truths are in\n"
      "`tests/support/law_scenes.h`; the law tests run the same lines "
      "(`tests/laws/verification_test.cpp`).\n\n"
      "`build/release/tyndall-bench verify > docs/verification.md` makes this file.\n");
  std::string table;
  int failed = 0, rows = 0;
  for (const support::VerificationRow& row : support::verification_rows()) {
    if (row.table != table) {
      table = row.table;
      fmt::print(
          "\n## {}\n\n| case | way | truth | result | ± | off by | |\n"
          "| --- | --- | --- | --- | --- | --- | --- |\n",
          table);
    }
    const support::Verified v = verify(row);
    const double mean = v.estimate.mean.y, error = v.estimate.standard_error.y;
    fmt::print("| {} | {} | {:.8g} | {:.8g} | {:.1e} | {:+.3f} % | {} |\n", row.row, row.way, row.truth, mean,
               error, 100 * (mean / row.truth - 1), v.passed ? "holds" : "**fails**");
    std::fflush(stdout);
    failed += !v.passed;
    ++rows;
  }
  fmt::print("\n{} lines, {} of which fail.\n", rows, failed);
  return print_methods() && failed == 0;
}

}  // namespace tyndall
