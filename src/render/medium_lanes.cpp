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

namespace {

struct BadCounts {
  std::uint64_t undefined = 0, below = 0, above = 0;
  void note(float v, float lowest) { ++(std::isnan(v) ? undefined : v < lowest ? below : above); }
  void add_to(BadValueCounts& counts, std::uint32_t medium, std::size_t which) const {
    if (undefined > 0) counts.add_medium(medium, which, BadValue::Kind::undefined, undefined);
    if (below > 0) counts.add_medium(medium, which, BadValue::Kind::below, below);
    if (above > 0) counts.add_medium(medium, which, BadValue::Kind::above, above);
  }
};

bool all_within(const float* values, std::size_t count, float lowest, float highest) {
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) good &= values[i] >= lowest && values[i] <= highest;
  return good;
}

// Counts what lies out of range; whether anything does.
bool count_given(const float* values, std::size_t count, const scene::GivenNumber& given,
                 std::uint32_t medium, std::size_t which, Worker& worker) {
  const auto lowest = static_cast<float>(given.lowest), highest = static_cast<float>(given.highest);
  if (all_within(values, count, lowest, highest)) return false;
  BadCounts bad;
  for (std::size_t i = 0; i < count; ++i)
    if (!(values[i] >= lowest && values[i] <= highest)) bad.note(values[i], lowest);
  bad.add_to(worker.bad_values, medium, which);
  return true;
}

// Replaces what is out of range, undefined values by 0. Counts them where they are not told already.
void limit_output(float* values, std::size_t count, float lowest, bool told, std::uint32_t medium,
                  std::size_t which, Worker& worker) {
  if (all_within(values, count, lowest, largest_value)) return;
  BadCounts bad;
  for (std::size_t i = 0; i < count; ++i) {
    float& v = values[i];
    if (v >= lowest && v <= largest_value) continue;
    bad.note(v, lowest);
    v = std::isnan(v) ? 0.0f : std::clamp(v, lowest, largest_value);
  }
  if (!told) bad.add_to(worker.bad_values, medium, which);
}

}  // namespace

void limit_outputs(const compile::CompiledScene& world, std::uint32_t medium, std::span<float* const> outputs,
                   std::size_t count, Worker& worker) {
  const std::vector<scene::GivenNumber>& given = world.scene.media[medium].given;
  bool told = false;
  for (std::size_t i = 0; i < given.size(); ++i)
    told |= count_given(outputs[given[i].output], count, given[i], medium, i, worker);
  const std::vector<compile::OutputUse>& uses = world.media[medium].uses;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (uses[k] != compile::OutputUse::shown)
      limit_output(outputs[k], count, uses[k] == compile::OutputUse::coefficient ? 0.0f : -largest_value,
                   told, medium, given.size() + k, worker);
}

void limit_extinction(const compile::CompiledScene& world, std::uint32_t medium,
                      std::span<float* const> outputs, std::size_t count, Worker& worker) {
  const scene::Medium& m = world.scene.media[medium];
  bool told = false;
  for (std::size_t i = 0; i < m.given.size(); ++i)
    if (const auto& output = m.given[i].extinction_output)
      told |= count_given(outputs[*output], count, m.given[i], medium, i, worker);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint8_t output = m.extinction_sigma_t[c];
    if (c > 0 && output == m.extinction_sigma_t[c - 1]) continue;
    limit_output(outputs[output], count, 0, told, medium, m.given.size() + m.sigma_t[c], worker);
  }
}

std::vector<BadValue> BadValueCounts::list(const scene::Scene& scene) const {
  std::vector<BadValue> out;
  for (const auto& [key, count] : counts_) {
    if (key.of_material) {
      const scene::Material& material = scene.materials[key.shader];
      const scene::GivenNumber& given = material.given[key.output];
      out.push_back({key.kind, given.span, material.name, count, given.name, given.lowest, given.highest});
      if (std::isinf(given.highest)) out.back().instead = "the shape's own normal";
      continue;
    }
    const scene::Medium& medium = scene.media[key.shader];
    if (key.output < medium.given.size()) {
      const scene::GivenNumber& given = medium.given[key.output];
      out.push_back({key.kind, given.span, medium.name, count, given.name, given.lowest, given.highest});
    } else {
      out.push_back({key.kind,
                     medium.output_spans[key.output - medium.given.size()],
                     medium.name,
                     count,
                     {},
                     0,
                     double{largest_value}});
    }
  }
  return out;
}

}  // namespace tyndall::render
