// What one thread owns while it renders: machine, scratch and counters. Grown on demand, then reused.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "compile/kind_walk.h"
#include "compile/majorant_grid.h"
#include "render/camera.h"
#include "render/certified.h"
#include "render/direct_light.h"
#include "render/emission_rays.h"
#include "render/flight.h"
#include "render/march.h"
#include "render/product.h"
#include "render/render.h"
#include "render/sunward.h"
#include "render/transmittance.h"
#include "vm/machine.h"

namespace tyndall::render {

// Shaders give no more than this; larger values are taken for infinite.
inline constexpr float largest_value = scene::largest_coefficient;

// Counts of bad values by (shader, output, kind). Of media: the number of what is given
// (scene::GivenNumber), then of outputs.
class BadValueCounts {
 public:
  void add_medium(std::uint32_t medium, std::size_t which, BadValue::Kind kind, std::uint64_t count) {
    counts_[{false, medium, which, kind}] += count;
  }
  void add_material(std::uint32_t material, std::size_t output, BadValue::Kind kind) {
    ++counts_[{true, material, output, kind}];
  }
  void add_all(const BadValueCounts& other) {
    for (const auto& [key, count] : other.counts_) counts_[key] += count;
  }
  std::vector<BadValue> list(const scene::Scene& scene) const;

 private:
  struct Key {
    bool of_material;
    std::uint32_t shader;
    std::size_t output;
    BadValue::Kind kind;
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, std::uint64_t> counts_;
};

struct PathSlot;

struct Worker {
  Worker();
  ~Worker();
  bool skips_empty = true;  // leaves out what is proven to be empty
  vm::Machine machine;
  Statistics statistics;
  BadValueCounts bad_values;
  std::array<std::vector<float>, vm::input_count> inputs;  // lanes of one batch
  std::vector<float*> outputs, shifted_outputs;
  std::vector<double> lane_places;  // [m] along its ray, of a walk's candidates
  struct LaneTime {
    std::size_t first;  // lane
    double time;        // of this and the next ones
  };
  std::vector<LaneTime> lane_times;  // of one batch, when its program reads the time
  std::vector<float> material_outputs;
  std::vector<compile::SurfaceHit> met_together;  // SurfaceWalk's
  std::vector<CameraSample> tile_samples;
  std::vector<Rgb> tile_radiance;
  std::vector<AovSample> tile_aovs;
  std::vector<std::unique_ptr<PathSlot>> slots;  // of paths on their way
  std::vector<MarchRequest> march_requests;
  std::vector<std::uint32_t> marches_going;  // of one call's requests, those that have segments left
  std::vector<MarchBatchEntry> march_batch;
  std::vector<float> march_pool;  // outputs of the media's programs, of the rays that are marched together
  std::size_t march_floats = 0;   // of march_pool, in use
  LightChoice surface_lights;
  PhaseMixture phase;
  SunwardDirections sunward;
  ShadowBatch shadows;
  EmissionBatch emission_rays;
  std::vector<Rgb> higher_contributions;  // of one shadow ray
  std::vector<Intervald> stretches;
  Product product;
  std::vector<FlightRequest> flight_requests;
  compile::BoundsScratch bounds;
  compile::KindWalk kinds;
  std::vector<double> edges, through, reach;  // of the march at work
  std::vector<compile::VolumeInterval> intervals;
  std::vector<std::uint32_t> active;  // stretches
  std::vector<CertifiedCell> certified_cells;
  std::vector<CertifiedStretch> certified_stretches;
  CertifiedScratch certified_scratch;
};

}  // namespace tyndall::render
