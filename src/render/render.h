// The picture: CompiledScene to Film.
#pragma once

#include <atomic>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/source.h"
#include "compile/compiled_scene.h"
#include "render/film.h"
#include "vm/machine.h"

namespace tyndall::render {

// How a distance along the ray is drawn for direct light.
enum class Distance : std::uint8_t { mis, density, equiangular, product };

// How a path goes through media (transport §2): decoupled keeps a march of each ray and takes light anywhere
// on it; brute_force takes light at every step of it; stochastic goes to a drawn optical depth of it;
// tracking is unbiased, by null collisions.
enum class Method : std::uint8_t { decoupled, brute_force, stochastic, tracking };
// Whether a ray is followed to one point instead of being kept whole.
constexpr bool flies(Method method) { return method == Method::stochastic || method == Method::tracking; }

// How transmittance towards a light is found where it has no closed form (transport §4).
enum class Transmittance : std::uint8_t { march, jackknife, ratio, residual_ratio, series };
// Whether it needs proven bounds instead of steps.
constexpr bool by_ratio(Transmittance method) {
  return method == Transmittance::ratio || method == Transmittance::residual_ratio;
}

struct RenderOptions {
  int threads = 0;         // 0: all
  bool skip_empty = true;  // leave out what is proven to be empty; false to measure what that saves
  vm::RunObserver* shader_observer =
      nullptr;  // of every batch of a shader, by the worker's thread; to measure
  Method method = Method::decoupled;
  Distance distance = Distance::product;  // of the decoupled method; of tracking as far as it has them
  Transmittance transmittance = Transmittance::march;
  bool emission_sampling = true;  // media that emit are sampled as lights; false to measure what that saves
  bool sunward = true;            // rays are sent towards distant lights (sunward.h); the same
  // Half-open pixel rectangle and sample range; defaults: everything.
  std::optional<PixelWindow> crop;
  int first_sample = 0;
  std::optional<int> sample_count;  // default: the scene's
  AovSet aovs;                      // outputs beside the picture
  // Ends once the root of the picture's mean squared relative error is below this (adaptive.h), each block
  // with as many samples as it needs; sample_count is then the most that a pixel gets.
  std::optional<double> error;
  // [s]: ends when it is over, with whole passes as far as can be told from those before. A block of pixels
  // that is at work then is not counted, so that each has all samples of a pass or none.
  std::optional<double> time_limit;
  const std::atomic<bool>* stop = nullptr;  // set to end early with what there is
};

// Called at most a few times a second from one thread at a time; `fraction` in [0, 1].
struct Progress {
  std::function<void(double fraction, double samples_per_second)> report = {};
  // Called after each pass but the last, with the picture so far.
  std::function<void(const Film& film, const struct Statistics& so_far)> pass = {};
};

struct BadValue {  // of a shader: what, how often, where
  // coarse: a field of a lattice at places as far from 0 as `highest` (compile::CoarseField).
  enum class Kind : std::uint8_t { undefined, below, above, coarse } kind{};
  Span span;           // the output's statement
  std::string shader;  // name of the medium or material
  std::uint64_t count = 0;
  std::string output{};                       // its name, or that of a parameter; empty: a coefficient
  double lowest = 0, highest = 0;             // what it is limited to; undefined ones are 0, limited
  std::optional<std::string_view> instead{};  // what is taken instead, where it is no number
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
  std::uint64_t clipped_samples = 0;  // brighter than the film can take
  double light = 0, lost_light = 0;   // of all samples together, and of it what the film's range lost
  std::uint64_t cut_paths = 0;        // paths ended by `bounces` while they still carried light
  double cut_throughput = 0;          // mean over camera samples of the throughput so cut
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

struct RenderResult {
  Film film;
  Statistics statistics;
};

RenderResult render(const compile::CompiledScene& world, const RenderOptions& options,
                    const Progress& progress = {});

// One sample of one pixel, with what happened on its path as text lines: `--pixel x,y --sample N`.
struct Replay {
  Rgb radiance;
  std::string trace;
};
Replay replay(const compile::CompiledScene& world, const RenderOptions& options, int x, int y,
              std::uint64_t sample);

}  // namespace tyndall::render
