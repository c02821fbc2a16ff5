// Media evaluated at points of rays: points of many rays are the lanes of one run of a medium's program.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/context/thread_context.h"
#include "render/march/segment_kernels.h"
#include "vm/program/program.h"

namespace tyndall::render {

// Which program of a medium: of all its outputs, or of extinction alone.
enum class MediumProgram : std::uint8_t { full, extinction };

// One batch after another; keeps its memory between them.
class MediumBatch {
 public:
  // Starts a batch of at most `lanes` lanes of the medium's program.
  void begin(const compile::CompiledScene& world, std::uint32_t medium, MediumProgram program,
             std::size_t lanes);
  // The next lanes: samples of the ray (segment_kernels.h) inside a volume that is filled with the medium.
  template <class Samples>
  void add(const compile::CompiledVolume& volume, const compile::Ray& ray, const Samples& samples) {
    const auto put = [&](vm::Input input, const Vec3d& origin, const Vec3d& direction) {
      auto* const rows = &inputs_[static_cast<std::size_t>(input)];
      put_on_line(samples, origin, direction, rows[0].data() + lanes_, rows[1].data() + lanes_,
                  rows[2].data() + lanes_);
    };
    if (needs_p_) {
      const Transform medium_from_render = volume.medium_from_render_at(ray.time);
      put(vm::Input::p_x, medium_from_render.point(ray.origin), medium_from_render.vector(ray.direction));
    }
    if (needs_world_) put(vm::Input::P_x, ray.origin + world_->origin, ray.direction);
    if (samples.count > 0) add_at_time(ray.time, samples.count);
  }
  // The next `count` lanes, of a medium that has one value for the whole ray of this time.
  void add_at_time(double time, std::size_t count) {
    if (needs_time_ && (times_.empty() || times_.back().time != time)) times_.push_back({lanes_, time});
    lanes_ += count;
  }
  std::size_t lanes() const { return lanes_; }
  std::size_t output_count() const { return program_->outputs.size(); }
  // Runs the program over all lanes: output k of lane i goes to values[k * lanes() + i], which must have
  // room. Values that the renderer cannot take are limited and counted: what the body gave out of range;
  // where all of that is good, coefficients that are not finite or negative. Undefined values count as 0,
  // infinite ones as `largest_value`.
  void run(float* values, ThreadContext& thread);

 private:
  void run_lanes(std::size_t first, std::size_t end, double time, ThreadContext& thread);
  void limit_full(BadValueCounts& bad_values) const;
  void limit_extinction(BadValueCounts& bad_values) const;

  struct Time {
    std::size_t first;  // lane
    double time;        // of this and the next ones
  };
  const compile::CompiledScene* world_ = nullptr;
  std::uint32_t medium_ = 0;
  MediumProgram which_{};
  const vm::Program* program_ = nullptr;
  std::size_t lanes_ = 0;
  bool needs_p_ = false, needs_world_ = false;
  bool needs_time_ = false;  // the ray's: rays of different times are runs of their own
  std::array<std::vector<float>, vm::input_count> inputs_;
  std::vector<Time> times_;
  std::vector<float*> outputs_, shifted_;
};

}  // namespace tyndall::render
