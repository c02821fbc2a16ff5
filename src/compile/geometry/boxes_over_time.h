// Boxes of things of which some move or deform, by parts of the time that the shutter is open: the tree over
// them is about as tight at every moment as if the things stood still.
#pragma once

#include <cstdint>
#include <vector>

#include "base/interval.h"
#include "compile/geometry/bounds_tree.h"
#include "compile/geometry/shape_hit.h"

namespace tyndall::compile {

// The box around both.
Bounds united(const Bounds& a, const Bounds& b);

class BoxesOverTime {
 public:
  static constexpr std::uint32_t parts = 16;
  static Intervald part(std::uint32_t k) { return {k / double{parts}, (k + 1) / double{parts}}; }

  // `box_within(interval)`: around the thing within fractions of the shutter's time.
  template <class BoxWithin>
  void add(bool moves, BoxWithin&& box_within) {
    first_.push_back(static_cast<std::uint32_t>(boxes_.size()));
    if (!moves) return boxes_.push_back(box_within(Intervald{0, 1}));
    for (std::uint32_t k = 0; k < parts; ++k) boxes_.push_back(box_within(part(k)));
  }

  std::size_t size() const { return first_.size(); }
  bool any_moves() const { return boxes_.size() > first_.size(); }
  // Around thing i in a part of the time.
  const Bounds& box(std::uint32_t i, std::uint32_t part) const {
    return boxes_[first_[i] + (moves(i) ? part : 0)];
  }
  // Around all things in a part of the time; there must be some.
  Bounds around(std::uint32_t part) const;
  // Over the things, numbered as they were added.
  BoundsTree tree() const;

 private:
  bool moves(std::uint32_t i) const {
    return (i + 1 < first_.size() ? first_[i + 1] : boxes_.size()) - first_[i] > 1;
  }
  Bounds over_all_time(std::uint32_t i) const;
  bool pays_by_parts() const;

  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> first_;  // of each thing
};

}  // namespace tyndall::compile
