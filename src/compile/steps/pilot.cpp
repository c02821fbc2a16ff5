#include "compile/steps/pilot.h"

#include <algorithm>

namespace tyndall::compile {

std::vector<LineProfile> Pilot::profiles(const std::vector<PilotLine>& lines, std::size_t places) {
  std::vector<LineProfile> out;
  for (const PilotLine& line : lines) out.push_back(profile(line, places, number_++));
  return out;
}

LineProfile Pilot::profile(const PilotLine& line, std::size_t places, std::uint64_t number) {
  const CompiledVolume& volume = world_.volumes[line.volume];
  const CompiledMedium& medium = world_.media[volume.medium];
  places_.resize(places);
  const double apart = (line.t1 - line.t0) / static_cast<double>(places);
  for (std::size_t k = 0; k < places; ++k)
    places_[k] = (static_cast<double>(k) + pilot_random(number, k)) * apart;
  evaluate(line, volume, medium);
  values_.resize(places);
  const auto mean_of = [&](const scene::RgbOutputs& which, std::size_t k) {
    float sum = 0;
    for (const std::uint8_t output : which) {
      const float value = outputs_[output * places + k];
      sum += value >= 0 ? std::min(value, scene::largest_coefficient) : 0.0f;
    }
    return sum / 3;
  };
  for (std::size_t k = 0; k < places; ++k)
    values_[k] = {mean_of(medium.sigma_t, k), mean_of(medium.sigma_s, k),
                  medium.emission ? mean_of(*medium.emission, k) : 0};
  return {line.t1 - line.t0, places_, values_};
}

// All outputs at the places, row by row.
void Pilot::evaluate(const PilotLine& line, const CompiledVolume& volume, const CompiledMedium& medium) {
  const std::size_t count = places_.size();
  const Transform medium_from_render = volume.medium_from_render_at(line.ray.time);
  for (auto& row : inputs_) row.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3d place = line.ray.origin + line.ray.direction * (line.t0 + places_[k]);
    const Vec3d p = medium_from_render.point(place), P = place + world_.origin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inputs_[axis][k] = static_cast<float>(p[axis]);
      inputs_[3 + axis][k] = static_cast<float>(P[axis]);
    }
  }
  const float seconds = world_.seconds_at(line.ray.time);
  vm::BatchInputs lanes;
  for (std::size_t i = 0; i < inputs_.size(); ++i) lanes.lanes[i] = inputs_[i].data();
  lanes[vm::Input::time] = &seconds;
  outputs_.resize(medium.full.outputs.size() * count);
  std::vector<float*> rows;
  for (std::size_t k = 0; k < medium.full.outputs.size(); ++k) rows.push_back(&outputs_[k * count]);
  machine_.run(medium.full, lanes, count, rows);
}

}  // namespace tyndall::compile
