// Published truths against what the renderer gives: a row of docs/verification.md and of the law tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/render.h"
#include "support/region_estimate.h"
#include "support/scene_builder.h"
#include "support/text.h"
#include "support/ways.h"

namespace tyndall::support {

struct VerificationRow {
  std::string table, row, way;
  double truth = 0;
  double allowance = 0;  // digits of the truth, and a bias stated beforehand
  std::function<Estimate()> run;
  double power = 0.03;  // the standard error that the row must have at most, in shares of the truth
};

struct Verified {
  Estimate estimate;
  bool passed = false;
};

// Four standard errors from 16 scramblings, and an error small enough to tell anything.
inline Verified verify(const VerificationRow& row) {
  Verified out{row.run(), false};
  const double error = out.estimate.standard_error.y;
  out.passed = std::abs(out.estimate.mean.y - row.truth) <= 4 * error + row.allowance &&
               error <= row.power * std::abs(row.truth) + 1e-12;
  return out;
}

// Of independent values of one thing.
inline Estimate estimate_of(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  return {Vec3d(sum / n), Vec3d(std::sqrt(squares / (n * (n - 1))))};
}

// 16 seeds of a scene.
inline Estimate estimate_scene(scene::Scene scene, const render::RenderOptions& options) {
  std::vector<render::Film> films;
  for (int seed = 1; seed <= 16; ++seed) {
    scene.settings.seed = static_cast<std::uint64_t>(seed);
    films.push_back(render::render(compile::compile(scene), options).film);
  }
  return region_estimate(films, 0, 0, scene.settings.resolution.width, scene.settings.resolution.height);
}

// The ways of these names.
inline std::vector<Way> ways_of(std::initializer_list<const char*> names) {
  std::vector<Way> some;
  for (const char* name : names)
    for (const Way& way : ways())
      if (way.name == name) some.push_back(way);
  return some;
}
// One way of each kind, for long paths.
inline std::vector<Way> free_path_methods() { return ways_of({"Product", "Stochastic", "Tracking"}); }

// A row of a rendered scene's mean.
inline VerificationRow scene_row(std::string table, std::string row, const Way& way, double truth,
                                 double allowance, const SceneBuilder& builder, double power = 0.03) {
  return {std::move(table),
          std::move(row),
          way.name,
          truth,
          allowance,
          [scene = builder.scene, way] { return estimate_scene(scene, way.options()); },
          power};
}

}  // namespace tyndall::support
