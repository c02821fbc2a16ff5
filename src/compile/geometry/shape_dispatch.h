// Any shape asked, those among them that are numbers of the scene's meshes and strands: in double and in the
// shape's own space. Directions need not have unit length: t is the caller's.
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "base/overloaded.h"
#include "compile/geometry/curves.h"
#include "compile/geometry/mesh.h"
#include "compile/geometry/shape_hit.h"

namespace tyndall::compile {

// What shapes name by a number, ready for rays.
struct ShapeParts {
  std::span<const CompiledMesh> meshes{};
  std::span<const CompiledCurves> curves{};
};

// The nearest crossing of the surface in (after, t_max). A ray that starts on the surface to rounding is kept
// off it by the caller's offset (hit_error.h). `time`, a fraction of the time that the shutter is open, is
// for what deforms.
std::optional<ShapeHit> intersect(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin,
                                  const Vec3d& direction, double t_max, const After& after, double time);
// Whether anything is hit in (0, t_max).
bool blocks(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin, const Vec3d& direction,
            double t_max, double time);
// Calls visit(interval) for those inside a closed shape, clipped to [0, t_max), in order. Open shapes have
// none.
template <class Visit>
void for_each_interval(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin,
                       const Vec3d& direction, double t_max, double time, Visit&& visit) {
  std::visit(Overloaded{[&](const scene::Mesh& mesh) {
                          std::vector<Intervald> inside;
                          parts.meshes[mesh.mesh.index].inside(origin, direction, t_max, inside, time);
                          for (const Intervald& interval : inside) visit(interval);
                        },
                        [](const scene::Curves&) {},
                        [&](const shapes::Analytic auto& s) {
                          if constexpr (shapes::Closed<std::decay_t<decltype(s)>>)
                            shapes::for_each_interval(s.inside(origin, direction), t_max, visit);
                        }},
             shape);
}
// Axis-aligned bounds in the shape's space. An infinite plane has none.
// Of what deforms within fractions of the time that the shutter is open.
std::optional<Bounds> bounds(const scene::Shape& shape, const ShapeParts& parts,
                             const Intervald& time = {0, 1});
// Those of shapes that their numbers turn whichever way they face, so that a box around those of two moments
// holds what turns from one to the other.
std::optional<Bounds> turned_bounds(const scene::Shape& shape, const ShapeParts& parts,
                                    const Intervald& time = {0, 1});
// Whether the shape has later poses.
bool deforms(const scene::Shape& shape, const ShapeParts& parts);
// Whether curves have no strands of their own: others near them have them (merge_curves.h).
bool strands_went_elsewhere(const scene::Shape& shape, const ShapeParts& parts);
// Whether the shape has no inside.
bool is_sheet(const scene::Shape& shape, const ShapeParts& parts);

}  // namespace tyndall::compile
