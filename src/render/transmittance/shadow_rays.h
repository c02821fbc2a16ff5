// Transmittance towards lights: closed form where the medium is homogeneous; where not, by one of the
// estimators of `--transmittance`, the lanes of several shadow rays in one batch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/context/thread_context.h"
#include "render/film/aov.h"
#include "render/march/marched_intervals.h"
#include "render/march/medium_batch.h"
#include "render/transmittance/ratio_tracking.h"
#include "render/transmittance/scattering_octaves.h"
#include "render/transmittance/transmittance.h"

namespace tyndall::render {

struct ShadowRay {
  compile::Ray ray;
  std::uint32_t target_light = compile::no_index;
  Rgb contribution;        // what arrives if nothing is in the way
  std::uint32_t seed = 0;  // of its march's jitter
  LightTarget target{};
  std::uint32_t segments = 0;  // that were evaluated for it
  // What higher orders of scattering bring: each one's, in the batch's list from here, if any; traced, their
  // sum.
  std::uint32_t first_higher = compile::no_index;
  Rgb higher{};
  bool has_higher() const { return first_higher != compile::no_index; }
};

// Shadow rays waiting to be traced together.
class ShadowBatch {
 public:
  // `higher`: what higher orders bring if nothing is in the way, of all that `trace` is given, or none.
  void add(const ShadowRay& ray, const LightTarget& target, std::span<const Rgb> higher = {}) {
    rays_.push_back(ray);
    rays_.back().target = target;
    if (higher.empty()) return;
    rays_.back().first_higher = static_cast<std::uint32_t>(higher_.size());
    higher_.insert(higher_.end(), higher.begin(), higher.end());
  }
  // Leaves in each ray's contribution what arrives: times visibility and transmittance, which an unbiased
  // estimator may make negative.
  // `orders` see their own share of the extinction; not with methods by ratio.
  std::span<const ShadowRay> trace(const compile::CompiledScene& world, Transmittance method,
                                   std::span<const ScatteringOrder> orders, ThreadContext& thread);
  std::size_t size() const { return rays_.size(); }
  void clear() {
    rays_.clear();
    higher_.clear();
  }

 private:
  // Estimates of one ray's optical depth: `count` independent marches, in rows of depth_ from `first`.
  struct Estimates {
    std::uint32_t first = 0, count = 1;
  };
  // One march in a volume: `count` segments from t0 of length dt, its segments from `first`.
  struct ShadowInterval {
    std::uint32_t medium, volume, ray, march, first, count;
    double t0, dt;
  };
  void lay_estimates(std::uint32_t ray, Transmittance method);
  void collect_intervals(const compile::CompiledScene& world, std::uint32_t ray, Transmittance method,
                         ThreadContext& thread);
  void take_intervals(std::uint32_t round);
  // Whether a ray is marched further after so many rounds.
  bool survives(std::uint32_t ray, std::uint32_t round);
  void march_intervals(const compile::CompiledScene& world, ThreadContext& thread);
  // Through `extinction` times the extinction.
  double transmittance(std::uint32_t ray, std::size_t channel, Transmittance method, double extinction);
  Rgb transmittance(const compile::CompiledScene& world, std::uint32_t ray, Transmittance method,
                    double extinction);

  std::vector<ShadowRay> rays_;
  std::vector<Rgb> higher_;
  std::vector<Estimates> estimates_;  // per ray
  std::vector<double> boost_;         // by roulette, per ray
  // Segments of each march, per ray: before chance may end it, and in all.
  std::vector<std::uint32_t> before_roulette_, segments_;
  std::vector<Vec3d> closed_;  // optical depth known in closed form, per ray
  std::vector<Vec3d> depth_;   // estimated optical depth, per march
  MarchedIntervals finder_;
  std::vector<MarchedInterval> marched_;
  std::vector<ShadowInterval> intervals_, rest_;  // to be marched now, and later
  RatioTracking ratio_;
  MediumBatch batch_;
  std::vector<float> values_;
  std::vector<double> one_channel_;
};

}  // namespace tyndall::render
