// Transmittance towards lights: closed form where the medium is homogeneous; where not, by one of the
// estimators of `--transmittance`, the lanes of several shadow rays in one batch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/aov.h"
#include "render/higher_orders.h"
#include "render/ratio_tracking.h"
#include "render/render.h"
#include "render/stretches.h"

namespace tyndall::render {

struct Worker;

struct ShadowRay {
  compile::Ray ray;
  std::uint32_t target_light = compile::no_index;
  Rgb contribution;          // what arrives if nothing is in the way
  std::uint32_t seed = 0;    // of its march's jitter
  std::uint32_t sample = 0;  // whose light it is: the caller's number
  LightPart part{}, higher_part{};
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
  // The rays added from now on bring light to this sample.
  void set_sample(std::uint32_t sample, LightPart part, LightPart higher_part = LightPart::volume_indirect) {
    sample_ = sample;
    part_ = part;
    higher_part_ = higher_part;
  }
  // `higher`: what higher orders bring if nothing is in the way, of all that `trace` is given, or none.
  void add(const ShadowRay& ray, std::span<const Rgb> higher = {}) {
    rays_.push_back(ray);
    rays_.back().sample = sample_;
    rays_.back().part = part_;
    rays_.back().higher_part = higher_part_;
    if (higher.empty()) return;
    rays_.back().first_higher = static_cast<std::uint32_t>(higher_.size());
    higher_.insert(higher_.end(), higher.begin(), higher.end());
  }
  // Leaves in each ray's contribution what arrives: times visibility and transmittance, which an unbiased
  // estimator may make negative.
  // `orders` see their own share of the extinction; not with methods by ratio.
  std::span<const ShadowRay> trace(const compile::CompiledScene& world, Transmittance method,
                                   std::span<const ScatteringOrder> orders, Worker& worker);
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
  // One march's stay in a volume: `count` segments from t0 of length dt, its segments from `first`.
  struct Stay {
    std::uint32_t medium, volume, ray, march, first, count;
    double t0, dt;
  };
  void lay_estimates(std::uint32_t ray, Transmittance method);
  void collect_stays(const compile::CompiledScene& world, std::uint32_t ray, Transmittance method,
                     Worker& worker);
  void take_stays(std::uint32_t round);
  // Whether a ray is marched further after so many rounds.
  bool survives(std::uint32_t ray, std::uint32_t round);
  void march_stays(const compile::CompiledScene& world, Worker& worker);
  // Through `extinction` times the extinction.
  double transmittance(std::uint32_t ray, std::size_t channel, Transmittance method, double extinction);
  Rgb transmittance(const compile::CompiledScene& world, std::uint32_t ray, Transmittance method,
                    double extinction);

  std::uint32_t sample_ = 0;
  LightPart part_{}, higher_part_{};
  std::vector<ShadowRay> rays_;
  std::vector<Rgb> higher_;
  std::vector<Estimates> estimates_;  // per ray
  std::vector<double> boost_;         // by roulette, per ray
  // Segments of each march, per ray: before chance may end it, and in all.
  std::vector<std::uint32_t> before_dark_, segments_;
  std::vector<Vec3d> closed_;  // optical depth known in closed form, per ray
  std::vector<Vec3d> depth_;   // estimated optical depth, per march
  std::vector<Stretch> stretches_;
  std::vector<Stay> stays_, rest_;  // to be marched now, and later
  RatioTracking ratio_;
  std::vector<float> values_;
  std::vector<double> one_channel_;
};

}  // namespace tyndall::render
