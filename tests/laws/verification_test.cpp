// Every row of docs/verification.md, so that a row that fails there fails here. 4 standard errors each, from
// 16 scramblings: a significance of 0.0012 (support/verification.h).
#include "support/verification_rows.h"

#include <gtest/gtest.h>

namespace tyndall::support {
namespace UNNAMED {

class Verification : public testing::TestWithParam<std::string> {};

std::vector<std::string> tables() {
  std::vector<std::string> names;
  for (const VerificationRow& row : verification_rows())
    if (std::find(names.begin(), names.end(), row.table) == names.end()) names.push_back(row.table);
  return names;
}

TEST_P(Verification, RowsHold) {
  for (const VerificationRow& row : verification_rows()) {
    if (row.table != GetParam()) continue;
    const Verified result = verify(row);
    EXPECT_TRUE(result.passed) << row.table << ", " << row.row << ", " << row.way << ": "
                               << result.estimate.mean.y << " ± " << result.estimate.standard_error.y
                               << " for " << row.truth;
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, Verification, testing::ValuesIn(tables()), [](const auto& table) {
  std::string name;
  for (const char c : table.param)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
});

}  // namespace
}  // namespace tyndall::support
