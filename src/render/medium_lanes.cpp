#include "render/medium_lanes.h"

#include <algorithm>
#include <cmath>

namespace tyndall::render {

MediumLanes::MediumLanes(const compile::CompiledScene& world, const vm::Program& program, Worker& worker)
    : world_(world), program_(program), worker_(worker) {
  worker.lane_times.clear();
  for (const vm::Input input : program.inputs) {
    needs_p_ |= input <= vm::Input::p_z;
    needs_world_ |= vm::Input::P_x <= input && input <= vm::Input::P_z;
    needs_time_ |= input == vm::Input::time && world.features.motion;
  }
}

void MediumLanes::reserve(std::size_t capacity) {
  const auto grow = [&](vm::Input input) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& lanes = worker_.inputs[static_cast<std::size_t>(input) + axis];
      if (lanes.size() < capacity + widest_lanes) lanes.resize(capacity + widest_lanes);
    }
  };
  if (needs_p_) grow(vm::Input::p_x);
  if (needs_world_) grow(vm::Input::P_x);
}

void MediumLanes::run(std::size_t lanes, std::span<float* const> outputs) {
  const auto& times = worker_.lane_times;
  if (times.size() <= 1) return run(0, lanes, times.empty() ? 0 : times[0].time, outputs);
  std::vector<float*>& shifted = worker_.shifted_outputs;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::size_t first = times[i].first, end = i + 1 < times.size() ? times[i + 1].first : lanes;
    shifted.clear();
    for (float* output : outputs) shifted.push_back(output + first);
    run(first, end - first, times[i].time, shifted);
  }
}

void MediumLanes::run(std::size_t first, std::size_t lanes, double time, std::span<float* const> outputs) {
  const float seconds = world_.seconds_at(time);
  vm::BatchInputs inputs;
  for (const vm::Input input : program_.inputs)
    inputs[input] =
        vm::is_uniform(input) ? &seconds : worker_.inputs[static_cast<std::size_t>(input)].data() + first;
  worker_.machine.run(program_, inputs, lanes, outputs);
}

void clamp_bad_values(float* values, std::size_t count, bool negative_ok, std::uint32_t medium,
                      std::size_t output, Worker& worker) {
  const float lowest = negative_ok ? -largest_value : 0.0f;
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) good &= values[i] >= lowest && values[i] <= largest_value;
  if (good) return;
  std::uint64_t not_finite = 0, negative = 0;
  for (std::size_t i = 0; i < count; ++i) {
    float& v = values[i];
    if (std::isnan(v) || std::abs(v) > largest_value) {
      ++not_finite;
      v = std::isnan(v) ? 0.0f : std::clamp(v, lowest, largest_value);
    } else if (v < lowest) {
      ++negative;
      v = lowest;
    }
  }
  if (not_finite > 0) worker.bad_values.add_medium(medium, output, BadValue::Kind::not_finite, not_finite);
  if (negative > 0) worker.bad_values.add_medium(medium, output, BadValue::Kind::negative, negative);
}

std::vector<BadValue> BadValueCounts::list(const scene::Scene& scene) const {
  std::vector<BadValue> out;
  for (const auto& [key, count] : counts_) {
    if (key.of_material) {
      const scene::Material& material = scene.materials[key.shader];
      out.push_back({key.kind, material.output_spans[key.output], material.name, count});
    } else {
      const scene::Medium& medium = scene.media[key.shader];
      out.push_back({key.kind, medium.output_spans[key.output], medium.name, count});
    }
  }
  return out;
}

}  // namespace tyndall::render
