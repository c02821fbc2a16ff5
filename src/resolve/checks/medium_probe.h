// What a medium is in a volume, without a ray: bounds of its program over parts of the volume, and its values
// at some places in it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "vm/interval/interval.h"
#include "vm/run/machine.h"

namespace tyndall::resolve {

class Boxes;
class Insides;

class MediumProbe {
 public:
  // The volume must be closed and not turned flat, and `looks` true: see fits().
  MediumProbe(const scene::Scene& scene, const scene::Volume& volume, Boxes& boxes, bool looks);
  // Whether there is anything to be found out: the program reads nothing else than places and time.
  bool fits() const { return world_from_shape_.has_value(); }

  // Bounds of an output of the full program over all of the volume, of the colour `outputs` likewise.
  vm::ValueBounds bounds(std::uint8_t output) const;
  vm::ValueBounds bounds(const scene::RgbOutputs& outputs) const;

  // Its values at some places inside of the volume, in all parts of it, or in those in which bounds leave it
  // open whether an output is within [lowest, highest].
  struct Values {
    std::vector<Vec3d> p;                     // in the medium's space
    std::vector<std::vector<float>> outputs;  // of the full program, one a place
  };
  const Values& values();
  Values values_where(std::uint8_t output, double lowest, double highest);
  // Whether a place of those is inside of the volume: they are but for meshes, of which it takes a while.
  bool is_inside(const Vec3d& p) const;

  // The longest way through the volume's box, and the sides of the box [m of world space].
  double diagonal() const { return length(sides_); }
  const Vec3d& sides() const { return sides_; }

 private:
  static constexpr std::size_t parts_along = 4, part_count = parts_along * parts_along * parts_along;
  static_assert(part_count <= vm::IntervalMachine::max_boxes);

  shapes::Bounds part(std::size_t index) const;
  void find_bounds();
  Values values_in(const std::vector<std::size_t>& parts, std::size_t each);
  void run(Values& values, const std::vector<Vec3d>& world);

  const scene::Scene& scene_;
  const scene::Volume& volume_;
  const scene::Medium& medium_;
  shapes::Bounds box_{};  // of the shape, in its own space
  std::optional<Transform> world_from_shape_;
  Transform medium_from_shape_;
  Vec3d sides_;
  std::vector<vm::ValueBounds> bounds_;  // output k of part i at k * part_count + i
  std::optional<Values> values_;
};

}  // namespace tyndall::resolve
