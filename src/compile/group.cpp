#include "compile/group.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::compile {

namespace {

Transform inverse_of(const Transform& t) {
  const auto inverse = t.inverse();
  CHECK(inverse.has_value());  // resolve refuses transforms that flatten space
  return *inverse;
}

}  // namespace

Bounds placed_bounds(const Bounds& b, const Transform& to) {
  Bounds out{Vec3d(infinity), Vec3d(-infinity)};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p =
        to.point({corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y, corner & 4 ? b.hi.z : b.lo.z});
    for (int axis = 0; axis < 3; ++axis) {
      out.lo[axis] = std::min(out.lo[axis], p[axis]);
      out.hi[axis] = std::max(out.hi[axis], p[axis]);
    }
  }
  return out;
}

Bounds united(const Bounds& a, const Bounds& b) {
  Bounds out;
  for (int axis = 0; axis < 3; ++axis) {
    out.lo[axis] = std::min(a.lo[axis], b.lo[axis]);
    out.hi[axis] = std::max(a.hi[axis], b.hi[axis]);
  }
  return out;
}

Bounds padded(const Bounds& b, double room) { return {b.lo - Vec3d(room), b.hi + Vec3d(room)}; }

double reach(const Bounds& b, const Vec3d& from) {
  Vec3d farthest;
  for (int axis = 0; axis < 3; ++axis)
    farthest[axis] = std::max(std::abs(b.lo[axis] - from[axis]), std::abs(b.hi[axis] - from[axis]));
  return length(farthest);
}

Transform Group::group_from_object(const Transform& placed, std::uint32_t light) const {
  Transform out = placed;
  if (light == no_index) out.t -= offset_;  // the surfaces of lights are in the group's space already
  return out;
}

void Group::add(std::span<const scene::ShapeInstance> surfaces,
                std::span<const scene::Moving<scene::ShapeInstance>> moving, const Vec3d& offset,
                std::span<const std::uint32_t> glows) {
  offset_ = offset;
  surfaces_.reserve(surfaces_.size() + surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const bool moves = !moving.empty() && moving.front().index == i;
    if (!strands_went_elsewhere(surfaces[i].shape, parts_))
      surfaces_.push_back({inverse_of(group_from_object(surfaces[i].world_from_object, no_index)),
                           &surfaces[i], no_index, glows.empty() ? no_index : glows[i],
                           moves ? &moving.front() : nullptr});
    if (moves) moving = moving.subspan(1);
  }
}

void Group::add_light(const scene::ShapeInstance& surface, std::uint32_t light,
                      const scene::Moving<scene::ShapeInstance>* motion) {
  surfaces_.push_back({inverse_of(surface.world_from_object), &surface, light, no_index, motion});
}

void Group::add(std::span<const scene::Instance> instances,
                std::span<const scene::Moving<scene::Instance>> moving, std::span<const Group> prototypes,
                const Vec3d& offset) {
  offset_ = offset;
  instances_.reserve(instances.size());
  for (std::size_t k = 0; k < instances.size(); ++k) {
    const scene::Instance& i = instances[k];
    const Group& prototype = prototypes[i.prototype.index];
    const bool moves = !moving.empty() && moving.front().index == k;
    if (!prototype.empty())
      instances_.push_back({inverse_of(group_from_object(i.world_from_object, no_index)), &i, &prototype,
                            moves ? &moving.front() : nullptr});
    if (moves) moving = moving.subspan(1);
  }
}

template <class Visit>
bool Group::placed(const PlacedSurface& s, double time, Visit&& visit) const {
  if (!s.motion) {
    visit(s.surface->shape, s.object_from_group);
    return true;
  }
  const scene::ShapeInstance now = scene::at(*s.motion, time);
  const auto inverse = group_from_object(now.world_from_object, s.light).inverse();
  if (inverse) visit(now.shape, *inverse);
  return inverse.has_value();
}

std::optional<Transform> Group::object_from_group(const PlacedInstance& i, double time) const {
  if (!i.motion) return i.object_from_group;
  return group_from_object(scene::at(*i.motion, time).world_from_object, no_index).inverse();
}

Bounds Group::box(const PlacedSurface& s) const {
  const auto place = [&](const scene::ShapeInstance& at) {
    return group_from_object(at.world_from_object, s.light);
  };
  if (!s.motion) return placed_bounds(*compile::bounds(s.surface->shape, parts_), place(*s.surface));
  return swept_bounds(
      *s.motion, 0, [&](const scene::ShapeInstance& at) { return *turned_bounds(at.shape, parts_); }, place);
}
Bounds Group::box(const PlacedInstance& i) const {
  const auto place = [&](const scene::Instance& at) {
    return group_from_object(at.world_from_object, no_index);
  };
  const Bounds own = *i.prototype->bounds();
  if (!i.motion) return placed_bounds(own, place(*i.instance));
  return swept_bounds(
      *i.motion, 0, [&](const scene::Instance&) { return own; }, place);
}

void Group::finish() {
  const auto infinite_surfaces = std::stable_partition(
      surfaces_.begin(), surfaces_.end(),
      [&](const PlacedSurface& s) { return compile::bounds(s.surface->shape, parts_).has_value(); });
  bounded_surfaces_ = static_cast<std::size_t>(infinite_surfaces - surfaces_.begin());
  const auto infinite_instances =
      std::stable_partition(instances_.begin(), instances_.end(),
                            [](const PlacedInstance& i) { return i.prototype->bounds().has_value(); });
  bounded_instances_ = static_cast<std::size_t>(infinite_instances - instances_.begin());

  std::vector<Bounds> boxes;
  boxes.reserve(bounded_surfaces_ + bounded_instances_);
  for (std::size_t i = 0; i < bounded_surfaces_; ++i) boxes.push_back(box(surfaces_[i]));
  for (std::size_t i = 0; i < bounded_instances_; ++i) boxes.push_back(box(instances_[i]));
  if (boxes.size() > few_things) tree_.emplace(boxes);
  if (boxes.empty() || bounded_surfaces_ < surfaces_.size() || bounded_instances_ < instances_.size()) return;
  bounds_ = boxes.front();
  for (const Bounds& b : boxes) bounds_ = united(*bounds_, b);
}

template <class Test>
void Group::visit(const GroupRay& ray, Test&& test) const {
  // Numbers as the tests know them: all surfaces, then all instances; the tree leaves those to infinity out.
  const auto number = [&](std::uint32_t i) {
    return i < bounded_surfaces_ ? i : static_cast<std::uint32_t>(i - bounded_surfaces_ + surfaces_.size());
  };
  for (std::size_t i = bounded_surfaces_; i < surfaces_.size(); ++i)
    if (test(static_cast<std::uint32_t>(i)) < 0) return;
  for (std::size_t i = bounded_instances_; i < instances_.size(); ++i)
    if (test(static_cast<std::uint32_t>(surfaces_.size() + i)) < 0) return;
  if (tree_)
    return tree_->visit(ray.origin, ray.direction, ray.t_max,
                        [&](std::uint32_t i) { return test(number(i)); });
  for (std::uint32_t i = 0; i < bounded_surfaces_ + bounded_instances_; ++i)
    if (test(number(i)) < 0) return;
}

std::optional<GroupHit> Group::closest_hit(const GroupRay& ray, RayKind kind) const {
  double t_max = ray.t_max;
  std::uint32_t best = no_index;
  ShapeHit surface_hit;
  GroupHit instance_hit;
  visit(ray, [&](std::uint32_t index) {
    // Of two things at the same t the first wins, whatever the order of the visits: let equals through.
    const double limit = best == no_index ? t_max : std::nextafter(t_max, infinity);
    double t = infinity;
    if (index < surfaces_.size()) {
      const PlacedSurface& s = surfaces_[index];
      if (kind == RayKind::camera && !s.surface->visible) return t_max;
      std::optional<ShapeHit> hit;
      placed(s, ray.time, [&](const scene::Shape& shape, const Transform& object_from_group) {
        hit = intersect(shape, parts_, object_from_group.point(ray.origin),
                        object_from_group.vector(ray.direction), limit);
      });
      if (!hit || (hit->t >= t_max && index > best)) return t_max;
      surface_hit = *hit;
      t = hit->t;
    } else {
      const PlacedInstance& i = instances_[index - surfaces_.size()];
      if (kind == RayKind::camera && !i.instance->visible) return t_max;
      const auto to_object = object_from_group(i, ray.time);
      if (!to_object) return t_max;
      const auto hit = i.prototype->closest_hit(
          {to_object->point(ray.origin), to_object->vector(ray.direction), limit, ray.time}, kind);
      if (!hit || (hit->t >= t_max && index > best)) return t_max;
      instance_hit = *hit;
      t = hit->t;
    }
    best = index;
    return t_max = t;
  });
  if (best == no_index) return std::nullopt;
  if (best < surfaces_.size()) {
    const PlacedSurface& s = surfaces_[best];
    const Transform to_group = group_from_object(
        s.motion ? scene::at(*s.motion, ray.time).world_from_object : s.surface->world_from_object, s.light);
    GroupHit hit{surface_hit.t,
                 to_group.point(surface_hit.position),
                 to_group.normal(surface_hit.normal),
                 surface_hit.position,
                 surface_hit.normal,
                 to_group.normal(surface_hit.shading_normal),
                 surface_hit.shading_normal,
                 surface_hit.uv,
                 {},
                 is_sheet(s.surface->shape, parts_),
                 s.surface->material,
                 s.light,
                 s.glow,
                 s.surface};
    if (keeps_axes_)
      hit.normal_axes = {to_group.normal({1, 0, 0}), to_group.normal({0, 1, 0}), to_group.normal({0, 0, 1})};
    return hit;
  }
  const PlacedInstance& i = instances_[best - surfaces_.size()];
  const Transform to_group = group_from_object(
      i.motion ? scene::at(*i.motion, ray.time).world_from_object : i.instance->world_from_object, no_index);
  GroupHit hit = instance_hit;
  hit.position = to_group.point(hit.position);
  hit.normal = to_group.normal(hit.normal);
  hit.shading_normal = to_group.normal(hit.shading_normal);
  if (keeps_axes_)
    for (Vec3d& axis : hit.normal_axes) axis = to_group.normal(axis);
  hit.surface = nullptr;
  if (!hit.material.valid()) hit.material = i.instance->material;
  return hit;
}

bool Group::occluded(const GroupRay& ray, std::uint32_t target_light) const {
  bool blocked = false;
  visit(ray, [&](std::uint32_t index) {
    if (index < surfaces_.size()) {
      const PlacedSurface& s = surfaces_[index];
      if (s.light != no_index && s.light == target_light) return ray.t_max;
      placed(s, ray.time, [&](const scene::Shape& shape, const Transform& object_from_group) {
        blocked = blocks(shape, parts_, object_from_group.point(ray.origin),
                         object_from_group.vector(ray.direction), ray.t_max);
      });
    } else {
      const PlacedInstance& i = instances_[index - surfaces_.size()];
      const auto to_object = object_from_group(i, ray.time);
      blocked = to_object && i.prototype->occluded({to_object->point(ray.origin),
                                                    to_object->vector(ray.direction), ray.t_max, ray.time},
                                                   target_light);
    }
    return blocked ? -1.0 : ray.t_max;
  });
  return blocked;
}

}  // namespace tyndall::compile
