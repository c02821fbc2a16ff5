// A tree over boxes: which of many things a ray may meet. Embree builds and walks it (in bounds_tree.cpp
// alone); the things themselves are tested by the caller, in double.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/vec.h"
#include "compile/shape_queries.h"

namespace tyndall::compile {

class BoundsTree {
 public:
  // Index i of the visits is boxes[i], which are not kept.
  explicit BoundsTree(std::span<const Bounds> boxes);
  ~BoundsTree();
  BoundsTree(BoundsTree&&) noexcept;

  // Tells the visitor of every box that the ray may meet in [t_min, t_max), t_min not below 0, nearer ones
  // roughly first; the direction has any length but zero. The visitor returns the t beyond which nothing
  // matters any more: t_max, a hit's t, or a negative number to stop.
  template <class Visitor>
  void visit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max,
             Visitor&& visitor) const {
    visit_boxes(
        origin, direction, t_min, t_max,
        [](void* v, std::uint32_t index) {
          return (*static_cast<std::remove_reference_t<Visitor>*>(v))(index);
        },
        const_cast<void*>(static_cast<const void*>(&visitor)));
  }

 private:
  using Callback = double (*)(void* visitor, std::uint32_t index);
  void visit_boxes(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max, Callback callback,
                   void* visitor) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall::compile
