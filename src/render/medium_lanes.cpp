#include "render/medium_lanes.h"

#include <algorithm>
#include <cmath>

namespace tyndall::render {

MediumLanes::MediumLanes(const compile::CompiledScene& world, const vm::Program& program, Worker& worker)
    : world_(world), program_(program), worker_(worker), time_(static_cast<float>(world.scene.time)) {
  for (const vm::Input input : program.inputs) {
    needs_p_ |= input <= vm::Input::p_z;
    needs_world_ |= vm::Input::P_x <= input && input <= vm::Input::P_z;
  }
}

void MediumLanes::reserve(std::size_t capacity) {
  const auto grow = [&](vm::Input input) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& lanes = worker_.inputs[static_cast<std::size_t>(input) + axis];
      if (lanes.size() < capacity) lanes.resize(capacity);
    }
  };
  if (needs_p_) grow(vm::Input::p_x);
  if (needs_world_) grow(vm::Input::P_x);
}

void MediumLanes::run(std::size_t lanes, std::span<float* const> outputs) {
  vm::BatchInputs inputs;
  for (const vm::Input input : program_.inputs)
    inputs[input] = vm::is_uniform(input) ? &time_ : worker_.inputs[static_cast<std::size_t>(input)].data();
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
