// Any scene without errors compiles, and rays through it meet intervals that are in order.
#include "base/check.h"
#include "compile/compiled_scene.h"
#include "input.h"
#include "resolve/resolve.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  resolve::Options few_rounds;
  few_rounds.max_repetitions = 2000;  // a mutation is not to run for minutes
  fuzz::Input input(data, size);
  input.parse();
  if (input.includes() || input.diagnostics.has_errors()) return 0;
  scene::Scene scene =
      resolve::resolve(input.tree, input.sources, input.symbols, few_rounds, input.diagnostics);
  if (input.diagnostics.has_errors()) return 0;
  const compile::CompiledScene world = compile::compile(std::move(scene));
  std::vector<compile::VolumeInterval> intervals;
  for (const Vec3d& direction : {Vec3d{0, 0, -1}, Vec3d{0.6, -0.8, 0}}) {
    const compile::Ray ray{{}, direction, 1000};
    world.closest_hit(ray, compile::RayKind::camera);
    world.occluded(ray);
    world.volume_intervals(ray, compile::RayKind::camera, intervals);
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      CHECK_LE(intervals[i].t0, intervals[i].t1);
      if (i > 0) CHECK_LE(intervals[i - 1].t0, intervals[i].t0);
    }
  }
  return 0;
}
