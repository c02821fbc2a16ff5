// What `--error` promises, on whole scenes: the error that a picture has, against one of far more samples, is
// what was asked for and what is told. `tyndall-bench errors` prints it for scenes with rare bright paths,
// too.
#include <gtest/gtest.h>

#include "support/error_scenes.h"
#include "support/scene_text.h"

namespace tyndall {
namespace UNNAMED {

// Seeds 1 to 20: at least 19 have an error within [0.5, 1.1] of the goal, and say that they reached it. Some
// say besides that most of their error is in few pixels: of the lit floor about one in twelve seeds, so that
// is no part of the promise.
TEST(AdaptiveLaws, ErrorsOfTameScenesAreAsTold) {
  for (const support::ErrorScene& row : support::error_scenes) {
    if (!row.law) continue;
    const scene::Scene scene = support::scene_of(support::error_scene_text(row));
    const support::ErrorReference truth = support::error_reference(row, scene);
    int kept = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const support::ErrorRun run = support::error_run(row, scene, truth, seed);
      kept += run.told <= 1 && run.kept();
    }
    EXPECT_GE(kept, 19) << row.name;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
