// What shapes name by a number, ready for rays.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compile/curves.h"
#include "compile/mesh.h"
#include "compile/shape_queries.h"

namespace tyndall::compile {

struct ShapeParts {
  std::span<const CompiledMesh> meshes{};
  std::span<const CompiledCurves> curves{};
};

// The queries of shape_queries.h, for all shapes.
std::optional<ShapeHit> intersect(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin,
                                  const Vec3d& direction, double t_max, const After& after = {});
// Whether anything is met in (0, t_max).
bool blocks(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin, const Vec3d& direction,
            double t_max);
void inside(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin, const Vec3d& direction,
            double t_max, std::vector<Intervald>& out);
// Calls visit(stay) for each of these stays.
template <class Visit>
void for_each_stay(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin,
                   const Vec3d& direction, double t_max, Visit&& visit) {
  if (std::holds_alternative<scene::Mesh>(shape)) {
    std::vector<Intervald> stays;
    inside(shape, parts, origin, direction, t_max, stays);
    for (const Intervald& stay : stays) visit(stay);
    return;
  }
  const Intervald stay = inside(shape, origin, direction, t_max);
  if (!stay.empty()) visit(stay);
}
std::optional<Bounds> bounds(const scene::Shape& shape, const ShapeParts& parts);
// Those of disks and cylinders whichever way they face, so that a box around those of two moments holds what
// turns from one to the other.
std::optional<Bounds> turned_bounds(const scene::Shape& shape, const ShapeParts& parts);
// Whether curves have no strands of their own: others near them have them (strand_groups.h).
bool strands_went_elsewhere(const scene::Shape& shape, const ShapeParts& parts);
// Whether the shape has no inside.
bool is_sheet(const scene::Shape& shape, const ShapeParts& parts);

}  // namespace tyndall::compile
