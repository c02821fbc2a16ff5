// What combinations are made of (combination.h).
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/transform.h"
#include "shapes/shape.h"

namespace tyndall::shapes {

// A closed shape that answers by itself, and where it stands.
struct CombinedPart {
  CombinedPart(const Shape& part, const Transform& outer_from_part);

  struct Placed {
    Transform outer_from_part, part_from_outer;
    double growth;  // no length grows by more on the way into the part's space
  };
  Shape shape;
  std::optional<Placed> placed;  // nothing: it stands where its numbers say
  Bounds bounds;                 // of the combination's space, with room for rounding

  Stays inside(const Vec3d& origin, const Vec3d& direction) const;
  ShapeHit hit_at(const Vec3d& origin, const Vec3d& direction, double t) const;
  double depth(const Vec3d& p) const;
};

struct CombinedParts {
  CombinedParts(Combining how_, std::vector<CombinedPart> list_);

  Combining how;
  std::vector<CombinedPart> list;  // at least one
  Bounds bounds;
  // Nothing is at two places at once, as far as its bounds tell: of an intersection.
  bool empty = false;
  double extent = 0;      // the largest coordinate that it reaches
  std::size_t count = 0;  // of the parts, those of its parts in place of these
  std::size_t depth = 1;  // combinations within each other

  bool takes_away(std::size_t part) const { return how == Combining::difference && part > 0; }
};

// The parts of a shape that is a combination; null for others.
const CombinedParts* parts_of(const Shape& shape);

// Whether the two are of one kind, with the same numbers throughout.
bool same(const CombinedParts& a, const CombinedParts& b);

}  // namespace tyndall::shapes
