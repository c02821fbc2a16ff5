// The scenes of tests/extremes, whose heads say what they are to give; `tyndall-bench extremes` prints their
// table.
#include "support/extremes.h"

#include <gtest/gtest.h>

#include "support/test_folder.h"

namespace tyndall::test {
namespace UNNAMED {

using support::cases_of, support::ExtremeCase, support::ExtremeOutcome, support::fault_of;

// What only measures is not repeated by instrumented code.
#if !defined(__SANITIZE_ADDRESS__)
class ExtremesSlow : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ExtremesSlow, RendersRightOrExplains) {
  const std::vector<ExtremeCase> cases = cases_of(GetParam());
  EXPECT_FALSE(cases.empty());
  for (const ExtremeCase& one : cases) {
    const ExtremeOutcome out = support::render_extreme(one, test_folder());
    EXPECT_EQ(out.fault, "") << one.options << "\nmean " << out.mean.value_or(0) << " ± "
                             << out.standard_error << '\n'
                             << out.said;
  }
}

std::string name_of_scene(const testing::TestParamInfo<std::filesystem::path>& scene) {
  std::string name = scene.param.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Scenes, ExtremesSlow, testing::ValuesIn(support::extreme_scenes()), name_of_scene);
#endif

TEST(Extremes, FaultsAreFound) {
  ExtremeCase one{"a.tyn", "", 2.0, 0.01, "step"};
  ExtremeOutcome out{.status = 0, .said = "a step", .mean = 2.015, .standard_error = 0.001};
  EXPECT_EQ(fault_of(one, out), "");
  out.mean = 2.03;
  EXPECT_EQ(fault_of(one, out), "is off by 0.03");
  out.mean = std::nan("");
  EXPECT_NE(fault_of(one, out), "");
  out.mean = 2;
  out.standard_error = 0.1;
  EXPECT_EQ(fault_of(one, out), "is too noisy to tell");
  out.standard_error = 0;
  out.said = "nothing";
  EXPECT_EQ(fault_of(one, out), "does not say 'step'");
  out.status = 134;
  EXPECT_EQ(fault_of(one, out), "ended with status 134");
  out = {.status = 1, .said = "no step"};
  EXPECT_EQ(fault_of(one, out), "made no picture");
  one.truth.reset();
  EXPECT_EQ(fault_of(one, out), "");
}

TEST(Extremes, AreMany) {
  const auto scenes = support::extreme_scenes();
  EXPECT_GE(scenes.size(), 30u);
  std::size_t cases = 0;
  for (const auto& scene : scenes) cases += cases_of(scene).size();
  EXPECT_GE(cases, 100u);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
