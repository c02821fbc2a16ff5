#include "compile/solids.h"

#include <algorithm>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::compile {

Solids::Solids(const scene::Scene& scene, const Vec3d& origin, std::span<const CompiledMaterial> materials,
               const ShapeParts& parts)
    : parts_(parts), origin_(origin) {
  auto moving = scene.motion.shapes.begin();
  const Transform render_from_world = Transform::translate(-origin);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const scene::ShapeInstance& s = scene.shapes[i];
    const scene::Moving<scene::ShapeInstance>* motion = nullptr;
    if (moving != scene.motion.shapes.end() && moving->index == i) motion = &*moving++;
    if (!materials[s.material.index].transmits || is_sheet(s.shape, parts)) continue;
    const auto inverse = (render_from_world * s.world_from_object).inverse();
    CHECK(inverse.has_value());  // resolve refuses transforms that flatten space
    list_.push_back({&s.shape,
                     *inverse,
                     {s.priority, static_cast<std::int64_t>(i)},
                     materials[s.material.index].ior,
                     motion});
  }
}

template <class Visit>
void Solids::placed(const Solid& solid, double time, Visit&& visit) const {
  if (!solid.motion) return visit(*solid.shape, solid.shape_from_render);
  const scene::ShapeInstance s = scene::at(*solid.motion, time);
  const auto inverse = (Transform::translate(-origin_) * s.world_from_object).inverse();
  if (inverse) visit(s.shape, *inverse);  // between two keys it may pass through flatness
}

std::optional<Solids::Holder> Solids::at(const Vec3d& position, double time, std::uint32_t except) const {
  std::optional<Holder> highest;
  std::vector<Intervald> stays;
  for (const Solid& solid : list_) {
    stays.clear();
    if (solid.rank.order == static_cast<std::int64_t>(except) || (highest && solid.rank < highest->rank))
      continue;
    placed(solid, time, [&](const scene::Shape& shape, const Transform& shape_from_render) {
      inside(shape, parts_, shape_from_render.point(position), {0, 0, 1}, infinity, stays);
    });
    // Clipped to [0, ∞): a stay that holds the point begins there.
    if (!stays.empty() && stays.front().lo == 0) highest = {solid.rank, solid.ior};
  }
  return highest;
}

void Solids::cut(const Ray& ray, std::span<const CompiledVolume> volumes,
                 std::vector<VolumeInterval>& intervals) const {
  const bool any = std::any_of(intervals.begin(), intervals.end(),
                               [&](const VolumeInterval& i) { return volumes[i.volume].rank.has_value(); });
  if (!any) return;
  std::vector<Intervald> stays;
  std::vector<VolumeInterval> rest;
  for (const Solid& solid : list_) {
    stays.clear();
    placed(solid, ray.time, [&](const scene::Shape& shape, const Transform& shape_from_render) {
      inside(shape, parts_, shape_from_render.point(ray.origin), shape_from_render.vector(ray.direction),
             ray.t_max, stays);
    });
    for (const Intervald& stay : stays) {
      rest.clear();
      for (const VolumeInterval& i : intervals) {
        const auto& rank = volumes[i.volume].rank;
        if (!rank || !(*rank < solid.rank) || stay.hi <= i.t0 || i.t1 <= stay.lo) {
          rest.push_back(i);
          continue;
        }
        if (i.t0 < stay.lo) rest.push_back({i.t0, stay.lo, i.volume});
        if (stay.hi < i.t1) rest.push_back({stay.hi, i.t1, i.volume});
      }
      intervals.swap(rest);
    }
  }
  std::sort(intervals.begin(), intervals.end(), [](const VolumeInterval& a, const VolumeInterval& b) {
    return a.t0 != b.t0 ? a.t0 < b.t0 : a.volume < b.volume;
  });
}

}  // namespace tyndall::compile
