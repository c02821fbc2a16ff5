#include "compile/parts.h"

#include <algorithm>

namespace tyndall::compile {

std::optional<ShapeHit> intersect(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin,
                                  const Vec3d& direction, double t_max, const After& after) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape))
    return parts.meshes[mesh->mesh.index].intersect(origin, direction, t_max, after);
  if (const auto* curves = std::get_if<scene::Curves>(&shape))
    return parts.curves[curves->strands.index].intersect(origin, direction, t_max, after);
  return intersect(shape, origin, direction, t_max, after);
}

bool blocks(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin, const Vec3d& direction,
            double t_max) {
  if (std::holds_alternative<scene::Mesh>(shape) || std::holds_alternative<scene::Curves>(shape))
    return intersect(shape, parts, origin, direction, t_max).has_value();
  return blocks(shape, origin, direction, t_max);
}

void inside(const scene::Shape& shape, const ShapeParts& parts, const Vec3d& origin, const Vec3d& direction,
            double t_max, std::vector<Intervald>& out) {
  out.clear();
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape))
    return parts.meshes[mesh->mesh.index].inside(origin, direction, t_max, out);
  const Intervald stay = inside(shape, origin, direction, t_max);
  if (!stay.empty()) out.push_back(stay);
}

std::optional<Bounds> bounds(const scene::Shape& shape, const ShapeParts& parts) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape)) return parts.meshes[mesh->mesh.index].bounds();
  if (const auto* curves = std::get_if<scene::Curves>(&shape))
    return parts.curves[curves->strands.index].bounds();
  return bounds(shape);
}

std::optional<Bounds> turned_bounds(const scene::Shape& shape, const ShapeParts& parts) {
  const auto around = [](const Vec3d& a, const Vec3d& b, double radius) {
    Bounds out;
    for (int axis = 0; axis < 3; ++axis) {
      out.lo[axis] = std::min(a[axis], b[axis]) - radius;
      out.hi[axis] = std::max(a[axis], b[axis]) + radius;
    }
    return out;
  };
  if (const auto* disk = std::get_if<scene::Disk>(&shape))
    return around(disk->center, disk->center, disk->radius);
  if (const auto* cylinder = std::get_if<scene::Cylinder>(&shape))
    return around(cylinder->from, cylinder->to, cylinder->radius);
  return bounds(shape, parts);
}

bool strands_went_elsewhere(const scene::Shape& shape, const ShapeParts& parts) {
  const auto* curves = std::get_if<scene::Curves>(&shape);
  return curves && parts.curves[curves->strands.index].pieces() == 0;
}

bool is_sheet(const scene::Shape& shape, const ShapeParts& parts) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape)) return !parts.meshes[mesh->mesh.index].closed();
  return std::holds_alternative<scene::Plane>(shape) || std::holds_alternative<scene::Quad>(shape) ||
         std::holds_alternative<scene::Disk>(shape) || std::holds_alternative<scene::Curves>(shape);
}

}  // namespace tyndall::compile
