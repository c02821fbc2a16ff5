#include "compile/geometry/shape_dispatch.h"

namespace tyndall::compile {

std::optional<ShapeHit> intersect(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin,
                                  const Vec3d& direction, double t_max, const After& after, double time) {
  return std::visit(
      Overloaded{[&](const scene::Mesh& mesh) {
                   return parts.meshes[mesh.mesh.index].intersect(origin, direction, t_max, after, time);
                 },
                 [&](const scene::Curves& curves) {
                   return parts.curves[curves.strands.index].intersect(origin, direction, t_max, after, time);
                 },
                 [&](const shapes::Analytic auto& s) { return s.hit(origin, direction, after.t, t_max); }},
      shape);
}

bool blocks(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin, const Vec3d& direction,
            double t_max, double time) {
  return std::visit(
      Overloaded{
          [&](const scene::Mesh& mesh) {
            return parts.meshes[mesh.mesh.index].intersect(origin, direction, t_max, {}, time).has_value();
          },
          [&](const scene::Curves& curves) {
            return parts.curves[curves.strands.index]
                .intersect(origin, direction, t_max, {}, time)
                .has_value();
          },
          [&](const shapes::Analytic auto& s) {
            // Of a closed shape where it is hit tells enough: no place, normal or coordinates.
            if constexpr (shapes::Closed<std::decay_t<decltype(s)>>)
              return shapes::crosses(s.inside(origin, direction), 0, t_max);
            else
              return s.hit(origin, direction, 0, t_max).has_value();
          }},
      shape);
}

std::optional<Bounds> bounds(const scene::Shape& shape, const ShapeParts& parts, const Intervald& time) {
  using Result = std::optional<Bounds>;
  const auto within = [&](const auto& part) {
    return part.deforms() ? part.bounds_within(time) : part.bounds();
  };
  return std::visit(
      Overloaded{[&](const scene::Mesh& mesh) -> Result { return within(parts.meshes[mesh.mesh.index]); },
                 [&](const scene::Curves& c) -> Result { return within(parts.curves[c.strands.index]); },
                 [](const shapes::Analytic auto& s) -> Result {
                   if constexpr (shapes::Bounded<std::decay_t<decltype(s)>>)
                     return s.bounds();
                   else
                     return std::nullopt;
                 }},
      shape);
}

bool deforms(const scene::Shape& shape, const ShapeParts& parts) {
  return std::visit(
      Overloaded{[&](const scene::Mesh& mesh) { return parts.meshes[mesh.mesh.index].deforms(); },
                 [&](const scene::Curves& c) { return parts.curves[c.strands.index].deforms(); },
                 [](const auto&) { return false; }},
      shape);
}

std::optional<Bounds> turned_bounds(const scene::Shape& shape, const ShapeParts& parts,
                                    const Intervald& time) {
  return std::visit(
      [&](const auto& s) -> std::optional<Bounds> {
        if constexpr (requires { s.turned_bounds(); })
          return s.turned_bounds();
        else
          return bounds(shape, parts, time);
      },
      shape);
}

bool strands_went_elsewhere(const scene::Shape& shape, const ShapeParts& parts) {
  const auto* curves = std::get_if<scene::Curves>(&shape);
  return curves && parts.curves[curves->strands.index].pieces() == 0;
}

bool is_sheet(const scene::Shape& shape, const ShapeParts& parts) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape)) return !parts.meshes[mesh->mesh.index].closed();
  return std::visit([](const auto& s) { return !s.closed; }, shape);
}

}  // namespace tyndall::compile
