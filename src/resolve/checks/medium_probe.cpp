#include "resolve/checks/medium_probe.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/numerics.h"
#include "resolve/checks/placed_things.h"

namespace tyndall::resolve {

namespace {

using shapes::Bounds;

bool reads_places_and_time_alone(const vm::Program& program) {
  return std::all_of(program.inputs.begin(), program.inputs.end(),
                     [](vm::Input input) { return input <= vm::Input::P_z || input == vm::Input::time; });
}

bool is_within(const vm::ValueBounds& b, double lowest, double highest) {
  return !b.may_be_nan && b.lo >= lowest && b.hi <= highest;
}

// The box with room for what rounding makes of places in it.
Bounds with_room(const Bounds& box) {
  Vec3d room;
  for (std::size_t axis = 0; axis < 3; ++axis)
    room[axis] = 1e-6 * std::max(std::abs(box.lo[axis]), std::abs(box.hi[axis]));
  return {box.lo - room, box.hi + room};
}

// Even over the unit cube: Roberts's sequence, by the powers of the root of x^4 = x + 1.
Vec3d even_point(std::size_t index) {
  const auto part = [](double x) { return x - std::floor(x); };
  const double i = static_cast<double>(index) + 0.5;
  return {part(i * 0.8191725133961645), part(i * 0.6710436067037893), part(i * 0.5497004779019703)};
}

}  // namespace

MediumProbe::MediumProbe(const scene::Scene& scene, const scene::Volume& volume, Boxes& boxes, bool looks)
    : scene_(scene), volume_(volume), medium_(scene.media[volume.medium.index]) {
  if (!looks) return;
  const std::optional<Bounds> box = boxes.of(volume.shape);
  const auto medium_from_world = volume.world_from_medium.inverse();
  if (!box || is_void(*box) || !medium_from_world || !reads_places_and_time_alone(medium_.full)) return;
  box_ = *box;
  world_from_shape_ = volume.world_from_shape;
  medium_from_shape_ = *medium_from_world * volume.world_from_shape;
  const Bounds world = PlacedBox{box_, *world_from_shape_}.in_world();
  sides_ = world.hi - world.lo;
  find_bounds();
}

Bounds MediumProbe::part(std::size_t index) const {
  Bounds out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::size_t i) {
      return box_.lo[axis] + (box_.hi[axis] - box_.lo[axis]) * static_cast<double>(i) / parts_along;
    };
    out.lo[axis] = at(index % parts_along);
    out.hi[axis] = at(index % parts_along + 1);
    index /= parts_along;
  }
  return out;
}

void MediumProbe::find_bounds() {
  // The ends of p and P in each part: lowest, then highest, by axis.
  std::array<std::array<std::vector<float>, 6>, 2> ends;
  for (std::size_t i = 0; i < part_count; ++i) {
    const Bounds boxes[2] = {with_room(PlacedBox{part(i), medium_from_shape_}.in_world()),
                             with_room(PlacedBox{part(i), *world_from_shape_}.in_world())};
    for (std::size_t k = 0; k < 6; ++k) {
      ends[0][k].push_back(static_cast<float>(boxes[k / 3].lo[k % 3]));
      ends[1][k].push_back(static_cast<float>(boxes[k / 3].hi[k % 3]));
    }
  }
  const auto time = static_cast<float>(scene_.time);
  vm::BoxInputs inputs;
  for (const vm::Input input : medium_.full.inputs) {
    const auto k = static_cast<std::size_t>(input);
    if (vm::is_uniform(input))
      inputs.set(input, &time, &time);
    else
      inputs.set(input, ends[0][k].data(), ends[1][k].data());
  }
  bounds_.resize(medium_.full.outputs.size() * part_count);
  vm::IntervalMachine().run(medium_.full, inputs, part_count, bounds_);
}

vm::ValueBounds MediumProbe::bounds(std::uint8_t output) const {
  const auto first = bounds_.begin() + static_cast<std::ptrdiff_t>(output * part_count);
  vm::ValueBounds all = *first;
  std::for_each(first, first + part_count, [&](const vm::ValueBounds& b) {
    all = {std::min(all.lo, b.lo), std::max(all.hi, b.hi), all.may_be_nan || b.may_be_nan};
  });
  return all;
}

vm::ValueBounds MediumProbe::bounds(const scene::RgbOutputs& outputs) const {
  vm::ValueBounds all = bounds(outputs[0]);
  for (const std::uint8_t output : outputs) {
    const vm::ValueBounds b = bounds(output);
    all = {std::min(all.lo, b.lo), std::max(all.hi, b.hi), all.may_be_nan || b.may_be_nan};
  }
  return all;
}

const MediumProbe::Values& MediumProbe::values() {
  if (!values_) {
    std::vector<std::size_t> all(part_count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    values_ = values_in(all, 2);
  }
  return *values_;
}

MediumProbe::Values MediumProbe::values_where(std::uint8_t output, double lowest, double highest) {
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < part_count; ++i)
    if (!is_within(bounds_[output * part_count + i], lowest, highest)) parts.push_back(i);
  return values_in(parts, parts.empty() ? 0 : std::max<std::size_t>(8, 256 / parts.size()));
}

bool MediumProbe::is_inside(const Vec3d& p) const {
  const auto shape_from_medium = medium_from_shape_.inverse();
  return shape_from_medium && Insides(scene_).contains(volume_.shape, *shape_from_medium, {p, 0});
}

MediumProbe::Values MediumProbe::values_in(const std::vector<std::size_t>& parts, std::size_t each) {
  Insides insides(scene_);
  Values values;
  std::vector<Vec3d> world;
  const bool is_mesh = std::holds_alternative<scene::Mesh>(volume_.shape);
  for (const std::size_t index : parts) {
    const Bounds box = part(index);
    for (std::size_t k = 0; k < each; ++k) {
      const Vec3d u = even_point(index * each + k), size = box.hi - box.lo;
      const Vec3d q = box.lo + Vec3d{u.x * size.x, u.y * size.y, u.z * size.z};
      if (!is_mesh && !insides.contains(volume_.shape, {}, {q, 0})) continue;
      values.p.push_back(medium_from_shape_.point(q));
      world.push_back(world_from_shape_->point(q));
    }
  }
  run(values, world);
  return values;
}

void MediumProbe::run(Values& values, const std::vector<Vec3d>& world) {
  const std::size_t lanes = values.p.size();
  values.outputs.assign(medium_.full.outputs.size(), std::vector<float>(lanes));
  if (lanes == 0) return;
  std::array<std::vector<float>, 6> rows;
  for (std::size_t i = 0; i < lanes; ++i)
    for (std::size_t k = 0; k < 6; ++k)
      rows[k].push_back(static_cast<float>(k < 3 ? values.p[i][k] : world[i][k - 3]));
  const auto time = static_cast<float>(scene_.time);
  vm::BatchInputs inputs;
  for (const vm::Input input : medium_.full.inputs)
    inputs[input] = vm::is_uniform(input) ? &time : rows[static_cast<std::size_t>(input)].data();
  std::vector<float*> outputs;
  for (std::vector<float>& output : values.outputs) outputs.push_back(output.data());
  vm::Machine().run(medium_.full, inputs, lanes, outputs);
}

}  // namespace tyndall::resolve
