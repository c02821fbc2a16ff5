// What a render counts, and what it found wrong: summed over its threads at the end.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/source.h"
#include "compile/compiled_scene.h"
#include "render/context/clamped_light.h"
#include "render/context/cut_light.h"

namespace tyndall::render {

struct BadValue {  // of a shader: what, how often, where
  // coarse: a field of a lattice at places as far from 0 as `highest` (compile::CoarseField).
  enum class Kind : std::uint8_t { undefined, below, above, coarse } kind{};
  Span span;           // the output's statement
  std::string shader;  // name of the medium or material
  std::uint64_t count = 0;
  std::string output{};                       // its name, or that of a parameter; empty: a coefficient
  double lowest = 0, highest = 0;             // what it is limited to; undefined ones are 0, limited
  std::optional<std::string_view> instead{};  // what is taken instead, where that is no number
};

// Rays on which something asked for was not reached, and the worst of them.
struct Shortfall {
  std::uint64_t rays = 0;
  double asked = 1, reached = 0;  // reached is greater

  void add(double ray_asked, double ray_reached) { add_all({1, ray_asked, ray_reached}); }
  void add_all(const Shortfall& other) {
    const auto badness = [](const Shortfall& s) { return std::pair(s.reached / s.asked, s.reached); };
    rays += other.rays;
    if (badness(other) > badness(*this)) asked = other.asked, reached = other.reached;
  }
};

// Counters, summed over the threads at the end.
struct Statistics {
  std::uint64_t samples = 0, rays = 0, shadow_rays = 0, marches = 0, segments = 0;
  std::uint64_t vm_runs = 0, lanes_issued = 0, lanes_used = 0, vm_instructions = 0;
  std::uint64_t bad_samples = 0;
  std::uint64_t cut_majorants = 0;  // bounds of extinction too great to track through
  // Rays that wanted more segments than a ray may have (segment_limit.h): given steps [m] that were widened,
  // and tolerances that are not proven to be kept.
  Shortfall widened_steps, missed_tolerances;
  compile::StepBias step_bias;
  std::uint64_t clipped_samples = 0;  // brighter than the film can take
  double light = 0, lost_light = 0;   // of all samples together, and of it what the film's range lost
  std::uint64_t cut_paths = 0;        // paths ended by `bounces` while they still carried light
  double cut_throughput = 0;          // mean over camera samples of the throughput so cut
  CutLight cut_light;
  // The share of the whole light that `bounces` left out: an estimate.
  double cut_share() const {
    const double lost = cut_light.lost();
    return lost > 0 ? lost / (light + lost) : 0;
  }
  ClampedLight clamped_light;  // of a scene with a clamp
  struct BadSample {
    std::uint64_t sample = 0;
    int y = 0, x = 0;
    auto operator<=>(const BadSample&) const = default;
  };
  std::optional<BadSample> first_bad_sample;  // the least: the same for any thread count
  std::vector<BadValue> bad_values;
  // Lanes that each instruction of a program's lane code was run for: of every medium all outputs and
  // extinction alone, in turn; of every material. A program that another one equals has none of its own.
  std::vector<std::vector<std::uint64_t>> medium_lanes, material_lanes;
  double seconds = 0;
  bool stopped = false;      // by RenderOptions::stop
  bool out_of_time = false;  // ended by the time limit
  bool uneven = false;       // ended within a pass: some pixels have more samples than others
  std::uint64_t pixels_without_samples = 0;
  int threads = 0;             // that took part
  int threads_missed = 0;      // that would have, had the system given them
  double estimated_error = 0;  // with RenderOptions::error: of the picture, in its measure
  double outlier_share = 0;    // of its square, in pixels that have more than a hundred times the mean
};

}  // namespace tyndall::render
