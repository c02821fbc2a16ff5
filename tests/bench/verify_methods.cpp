#include "verify_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "reference/reference.h"
#include "support/method_scenes.h"
#include "support/verification.h"

namespace tyndall {

namespace {

using support::Estimate;

constexpr std::string_view introduction = R"(# All methods compared

Six scenes (`tests/support/method_scenes.h`) are rendered by every method and by a reference renderer that uses nothing of
`src/compile` and `src/render`. `difference` is the largest difference from any other method (`from`), in standard errors, over the three
channels. Ray marching may differ by the stated bias. Two methods agree if their difference is at most 5.3. Over all 990 comparisons together this is a
significance of 0.01 (Šidák; Student's t, 30 degrees of freedom).
)";

constexpr double majorant = 14;  // above the densities of all six scenes
constexpr int reference_samples = 1 << 14;
constexpr double agreement = 5.3;  // standard errors

struct Result {
  std::string name;
  Estimate estimate;
  bool unbiased = false;
};

// How many standard errors two results lie apart beyond an allowance, in the channel where that is most.
double apart(const Estimate& a, const Estimate& b, double allowance) {
  double most = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double error = std::hypot(a.standard_error[c], b.standard_error[c]);
    const double beyond = std::max(0.0, std::abs(a.mean[c] - b.mean[c]) - allowance);
    if (beyond > 0) most = std::max(most, beyond / error);
  }
  return most;
}

Estimate reference(const scene::Scene& scene) {
  reference::ReferenceSettings settings;
  settings.majorant = majorant;
  settings.samples = reference_samples;
  settings.bounces = scene.settings.bounces;
  const auto whole = reference::reference_render(scene, settings).whole();
  return {whole.mean, whole.standard_error};
}

std::vector<Result> results(const scene::Scene& scene) {
  std::vector<Result> list{{"Reference", reference(scene), true}};
  for (const support::Way& way : support::ways()) {
    scene::Scene one = scene;
    if (way.method == render::Method::brute_force)
      one.settings.samples /= 8;  // it takes 20 times as many light samples
    list.push_back({way.name, support::estimate_scene(one, way.options()), way.unbiased});
  }
  return list;
}

}  // namespace

bool print_methods() {
  fmt::print("\n{}", introduction);
  bool good = true;
  for (const support::MethodScene& one : support::method_scenes()) {
    fmt::print(
        "\n## {}\n\nStated bias of ray marching: {:.3g} %.\n\n| method | mean R, G, B | ± | difference | "
        "from | |\n",
        one.name, 100 * one.bias);
    fmt::print("| --- | --- | --- | --- | --- | --- |\n");
    const std::vector<Result> all = results(one.scene);
    for (const Result& a : all) {
      double most = 0;
      std::string from = "-";
      for (const Result& b : all) {
        const double allowance = a.unbiased && b.unbiased ? 0 : one.bias * b.estimate.mean.y;
        const double distance = &a == &b ? 0 : apart(a.estimate, b.estimate, allowance);
        if (distance > most) most = distance, from = b.name;
      }
      const Vec3d &m = a.estimate.mean, &e = a.estimate.standard_error;
      fmt::print("| {} | {:.5g} {:.5g} {:.5g} | {:.1e} {:.1e} {:.1e} | {:.1f} | {} | {} |\n", a.name, m.x,
                 m.y, m.z, e.x, e.y, e.z, most, from, most <= agreement ? "agrees" : "**differs**");
      good &= most <= agreement;
    }
    std::fflush(stdout);
  }
  return good;
}

}  // namespace tyndall
