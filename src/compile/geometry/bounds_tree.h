// A tree over boxes: which of many things a ray may meet. Embree builds and walks it (in bounds_tree.cpp
// alone); the things themselves are tested by the caller, in double. The boxes may move.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "base/vec.h"
#include "compile/geometry/shape_hit.h"

namespace tyndall::compile {

class BoundsTree {
 public:
  // Index i of the visits is boxes[i], which are not kept.
  explicit BoundsTree(std::span<const Bounds> boxes);
  // So many boxes, asked for one by one, at moments that are evenly apart while the shutter is open: between
  // two of them each side goes evenly. One moment: they stand still.
  using BoxAt = std::function<Bounds(std::uint32_t index, std::uint32_t moment)>;
  static constexpr std::uint32_t most_moments = 129;  // of Embree
  BoundsTree(std::uint32_t count, std::uint32_t moments, const BoxAt& box);
  ~BoundsTree();
  BoundsTree(BoundsTree&&) noexcept;

  // Tells the visitor of every box that the ray may meet in [t_min, t_max), t_min not below 0, nearer ones
  // roughly first; the direction has any length but zero. The visitor returns the t beyond which nothing
  // matters any more: t_max, a hit's t, or a negative number to stop. `time`: a fraction of the time that the
  // shutter is open.
  template <class Visitor>
  void visit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max, Visitor&& visitor,
             double time = 0) const {
    visit_boxes(
        origin, direction, t_min, t_max, time,
        [](void* v, std::uint32_t index) {
          return (*static_cast<std::remove_reference_t<Visitor>*>(v))(index);
        },
        const_cast<void*>(static_cast<const void*>(&visitor)));
  }

 private:
  using Callback = double (*)(void* visitor, std::uint32_t index);
  void visit_boxes(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max, double time,
                   Callback callback, void* visitor) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall::compile
