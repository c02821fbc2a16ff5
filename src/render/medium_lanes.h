// Points inside volumes as lanes of their medium's programs.
#pragma once

#include <cstddef>

#include "compile/compiled_scene.h"
#include "render/march_lanes.h"
#include "render/worker.h"
#include "vm/program.h"

namespace tyndall::render {

// The inputs that a medium's `program` reads, for points of rays through volumes filled with it.
class MediumLanes {
 public:
  MediumLanes(const compile::CompiledScene& world, const vm::Program& program, Worker& worker);

  // Makes room for `capacity` lanes.
  void reserve(std::size_t capacity);
  // Sets the lanes from `first` on to samples of the ray (march_lanes.h) inside the volume. Lanes are set in
  // order: what is behind them may be overwritten.
  template <class Samples>
  void set(const compile::CompiledVolume& volume, const compile::Ray& ray, std::size_t first,
           const Samples& samples) {
    const auto put = [&](vm::Input input, const Vec3d& origin, const Vec3d& direction) {
      auto* const rows = &worker_.inputs[static_cast<std::size_t>(input)];
      put_on_line(samples, origin, direction, rows[0].data() + first, rows[1].data() + first,
                  rows[2].data() + first);
    };
    if (needs_p_) {
      const Transform medium_from_render = volume.medium_from_render_at(ray.time);
      put(vm::Input::p_x, medium_from_render.point(ray.origin), medium_from_render.vector(ray.direction));
    }
    if (needs_world_) put(vm::Input::P_x, ray.origin + world_.origin, ray.direction);
    if (samples.count > 0) set_time(first, ray.time);
  }
  // The same for lanes of a medium that is one value for the whole ray: from `first` on they are of this
  // time.
  void set_time(std::size_t first, double time) {
    if (needs_time_ && (worker_.lane_times.empty() || worker_.lane_times.back().time != time))
      worker_.lane_times.push_back({first, time});
  }
  // Runs the program over `lanes` lanes; output k goes to outputs[k]. Rays of different times are batches of
  // their own when the program reads the time.
  void run(std::size_t lanes, std::span<float* const> outputs);

 private:
  void run(std::size_t first, std::size_t lanes, double time, std::span<float* const> outputs);

  const compile::CompiledScene& world_;
  const vm::Program& program_;
  Worker& worker_;
  bool needs_p_ = false, needs_world_ = false;
  bool needs_time_ = false;  // the ray's
};

// Makes a batch's outputs of a medium's full program what the renderer can take, and counts what is bad: what
// the body gave out of range; where all of that is good, coefficients that are not finite or negative.
// Undefined values count as 0, infinite ones as `largest_value`.
void limit_outputs(const compile::CompiledScene& world, std::uint32_t medium, std::span<float* const> outputs,
                   std::size_t count, Worker& worker);
// The same for the program of extinction alone.
void limit_extinction(const compile::CompiledScene& world, std::uint32_t medium,
                      std::span<float* const> outputs, std::size_t count, Worker& worker);

}  // namespace tyndall::render
