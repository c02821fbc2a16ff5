#include "render/march/medium_batch.h"

#include <algorithm>
#include <cmath>

namespace tyndall::render {

void MediumBatch::begin(const compile::CompiledScene& world, std::uint32_t medium, MediumProgram program,
                        std::size_t lanes) {
  world_ = &world;
  medium_ = medium;
  which_ = program;
  const compile::CompiledMedium& m = world.media[medium];
  program_ = program == MediumProgram::full ? &m.full : &m.extinction;
  lanes_ = 0;
  times_.clear();
  needs_p_ = needs_world_ = needs_time_ = false;
  for (const vm::Input input : program_->inputs) {
    needs_p_ |= input <= vm::Input::p_z;
    needs_world_ |= vm::Input::P_x <= input && input <= vm::Input::P_z;
    needs_time_ |= input == vm::Input::time && world.features.motion;
  }
  const auto reserve = [&](vm::Input input) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<float>& row = inputs_[static_cast<std::size_t>(input) + axis];
      if (row.size() < lanes + widest_lanes) row.resize(lanes + widest_lanes);
    }
  };
  if (needs_p_) reserve(vm::Input::p_x);
  if (needs_world_) reserve(vm::Input::P_x);
}

void MediumBatch::run(float* values, ThreadContext& thread) {
  if (lanes_ == 0) return;
  outputs_.clear();
  for (std::size_t k = 0; k < output_count(); ++k) outputs_.push_back(values + k * lanes_);
  if (times_.empty()) run_lanes(0, lanes_, 0, thread);
  for (std::size_t i = 0; i < times_.size(); ++i)
    run_lanes(times_[i].first, i + 1 < times_.size() ? times_[i + 1].first : lanes_, times_[i].time, thread);
  if (which_ == MediumProgram::full)
    limit_full(thread.bad_values);
  else
    limit_extinction(thread.bad_values);
}

void MediumBatch::run_lanes(std::size_t first, std::size_t end, double time, ThreadContext& thread) {
  shifted_.clear();
  for (float* output : outputs_) shifted_.push_back(output + first);
  const float seconds = world_->seconds_at(time);
  vm::BatchInputs inputs;
  for (const vm::Input input : program_->inputs)
    inputs[input] =
        vm::is_uniform(input) ? &seconds : inputs_[static_cast<std::size_t>(input)].data() + first;
  thread.machine.run(*program_, inputs, end - first, shifted_);
}

namespace {

BadValue::Kind kind_of(float v, float lowest) {
  return std::isnan(v) ? BadValue::Kind::undefined
         : v < lowest  ? BadValue::Kind::below
                       : BadValue::Kind::above;
}

struct BadCounts {
  std::uint64_t undefined = 0, below = 0, above = 0;
  void note(float v, float lowest) { ++(std::isnan(v) ? undefined : v < lowest ? below : above); }
  void add_to(BadValueCounts& counts, std::uint32_t medium, std::size_t which) const {
    if (undefined > 0) counts.add_medium(medium, which, BadValue::Kind::undefined, undefined);
    if (below > 0) counts.add_medium(medium, which, BadValue::Kind::below, below);
    if (above > 0) counts.add_medium(medium, which, BadValue::Kind::above, above);
  }
};

bool all_within(std::span<const float> values, float lowest, float highest) {
  bool good = true;
  for (const float v : values) good &= v >= lowest && v <= highest;
  return good;
}

// Counts what lies out of the range of what a medium is given as number `which`; whether anything does.
// `branches`: which statement gave each value, where there are several.
bool count_given(std::span<const float> values, const float* branches, const scene::GivenNumber& given,
                 std::uint32_t medium, std::size_t which, BadValueCounts& bad_values) {
  const auto lowest = static_cast<float>(given.lowest), highest = static_cast<float>(given.highest);
  if (all_within(values, lowest, highest)) return false;
  BadCounts bad;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= lowest && values[i] <= highest) continue;
    if (given.branches.empty())
      bad.note(values[i], lowest);
    else
      bad_values.add_medium(medium, which, kind_of(values[i], lowest), 1,
                            static_cast<std::size_t>(branches[i]));
  }
  bad.add_to(bad_values, medium, which);
  return true;
}

// Replaces what is out of [lowest, largest_value], undefined values by 0.
BadCounts limit(std::span<float> values, float lowest) {
  BadCounts bad;
  if (all_within(values, lowest, largest_value)) return bad;
  for (float& v : values) {
    if (v >= lowest && v <= largest_value) continue;
    bad.note(v, lowest);
    v = std::isnan(v) ? 0.0f : std::clamp(v, lowest, largest_value);
  }
  return bad;
}

}  // namespace

void MediumBatch::limit_full(BadValueCounts& bad_values) const {
  const std::vector<scene::GivenNumber>& given = world_->media[medium_].given;
  bool told = false;
  for (std::size_t i = 0; i < given.size(); ++i)
    told |= count_given({outputs_[given[i].output], lanes_}, outputs_[given[i].branch_output], given[i],
                        medium_, i, bad_values);
  const std::vector<compile::OutputUse>& uses = world_->media[medium_].uses;
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    if (uses[k] == compile::OutputUse::shown) continue;
    const BadCounts bad =
        limit({outputs_[k], lanes_}, uses[k] == compile::OutputUse::coefficient ? 0.0f : -largest_value);
    if (!told) bad.add_to(bad_values, medium_, given.size() + k);
  }
}

void MediumBatch::limit_extinction(BadValueCounts& bad_values) const {
  const compile::CompiledMedium& m = world_->media[medium_];
  bool told = false;
  for (std::size_t i = 0; i < m.given.size(); ++i)
    if (const auto& output = m.given[i].extinction_output)
      told |= count_given({outputs_[*output], lanes_}, outputs_[m.given[i].extinction_branch_output],
                          m.given[i], medium_, i, bad_values);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint8_t output = m.extinction_sigma_t[c];
    if (c > 0 && output == m.extinction_sigma_t[c - 1]) continue;
    const BadCounts bad = limit({outputs_[output], lanes_}, 0);
    if (!told) bad.add_to(bad_values, medium_, m.given.size() + m.sigma_t[c]);
  }
}

}  // namespace tyndall::render
