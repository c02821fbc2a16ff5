#include "compile/geometry/bvh_group.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "compile/geometry/hit_error.h"
#include "shapes/mesh_at.h"

namespace tyndall::compile {

namespace {

// Things closer than this share of their coordinates may touch.
constexpr double closeness = 1e-9;

bool touching(const Bounds& a, const Bounds& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const double near = closeness * std::max({std::abs(a.lo[axis]), std::abs(a.hi[axis]),
                                              std::abs(b.lo[axis]), std::abs(b.hi[axis])});
    if (a.hi[axis] + near < b.lo[axis] || b.hi[axis] + near < a.lo[axis]) return false;
  }
  return true;
}

// Or upon the plane.
bool on_both_sides(const scene::Plane& plane, const Bounds& b) {
  double lowest = infinity, highest = -infinity;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p{corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y, corner & 4 ? b.hi.z : b.lo.z};
    const double height = dot(plane.normal, p - plane.point);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  const double near = closeness * std::max(-lowest, highest);
  return lowest <= near && highest >= -near;
}

// Where a search goes on among `count` surfaces of which the first has this number, as they count themselves.
HitOrder among(const HitOrder& after, std::uint64_t first, std::uint64_t count) {
  if (after.surface < first) return {std::nextafter(after.t, -infinity)};  // all at this t are still to come
  if (after.surface - first < count) return {after.t, after.surface - first, after.part};
  return {after.t};
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
                std::span<const std::uint32_t> glows, const Keeps& keeps) {
  offset_ = offset;
  surfaces_.reserve(surfaces_.size() + surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const bool moves = !moving.empty() && moving.front().index == i;
    if (!strands_went_elsewhere(surfaces[i].shape, parts_) && (!keeps || keeps(surfaces[i])))
      surfaces_.push_back({inverse_of(group_from_object(surfaces[i].world_from_object, no_index)),
                           numbers_ + i, &surfaces[i], no_index, glows.empty() ? no_index : glows[i],
                           placed_motion(moves ? &moving.front() : nullptr)});
    if (moves) moving = moving.subspan(1);
  }
  numbers_ += surfaces.size();
}

void Group::add_light(const scene::ShapeInstance& surface, std::uint32_t light,
                      const scene::Moving<scene::ShapeInstance>* motion) {
  surfaces_.push_back(
      {inverse_of(surface.world_from_object), numbers_++, &surface, light, no_index, placed_motion(motion)});
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
                            numbers_, placed_motion(moves ? &moving.front() : nullptr)});
    if (moves) moving = moving.subspan(1);
    numbers_ += prototype.numbers();
  }
}

template <class Visit>
bool Group::placed(const PlacedSurface& s, double time, Visit&& visit) const {
  if (!s.motion) {
    visit(s.surface->shape, s.object_from_group);
    return true;
  }
  const auto inverse = group_from_object(s.motion->world_from_object.at(time), s.light).inverse();
  if (!inverse) return false;
  if (s.motion->within)
    visit(scene::at(*s.motion->keys, time).shape, *inverse);
  else
    visit(s.surface->shape, *inverse);
  return true;
}

std::optional<Transform> Group::object_from_group(const PlacedInstance& i, double time) const {
  if (!i.motion) return i.object_from_group;
  return group_from_object(i.motion->world_from_object.at(time), no_index).inverse();
}

bool Group::moves(const PlacedSurface& s) const { return s.motion || deforms(s.surface->shape, parts_); }

Bounds Group::box(const PlacedSurface& s, const Intervald& time) const {
  const auto place = [&](const scene::ShapeInstance& at) {
    return group_from_object(at.world_from_object, s.light);
  };
  if (!s.motion) return placed_bounds(*compile::bounds(s.surface->shape, parts_, time), place(*s.surface));
  return swept_bounds(
      *s.motion->keys, 0,
      [&](const scene::ShapeInstance& at) { return *turned_bounds(at.shape, parts_, time); }, place, time);
}
Bounds Group::box(const PlacedInstance& i, const Intervald& time) const {
  const auto place = [&](const scene::Instance& at) {
    return group_from_object(at.world_from_object, no_index);
  };
  const Bounds own = i.prototype->bounds_within(time);
  if (!i.motion) return placed_bounds(own, place(*i.instance));
  return swept_bounds(
      *i.motion->keys, 0, [&](const scene::Instance&) { return own; }, place, time);
}

Bounds Group::bounds_within(const Intervald& time) const {
  if (by_parts_.empty()) return *bounds_;
  const auto [first, end] = shapes::poses_within(time, by_parts_.size());
  Bounds out = by_parts_[first];
  for (std::size_t k = first + 1; k < end; ++k) out = united(out, by_parts_[k]);
  return out;
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

  BoxesOverTime boxes;
  for (std::size_t i = 0; i < bounded_surfaces_; ++i)
    boxes.add(moves(surfaces_[i]), [&](const Intervald& time) { return box(surfaces_[i], time); });
  for (std::size_t i = 0; i < bounded_instances_; ++i) {
    const bool moves = instances_[i].motion || !instances_[i].prototype->by_parts_.empty();
    boxes.add(moves, [&](const Intervald& time) { return box(instances_[i], time); });
  }
  if (boxes.size() > few_things) tree_.emplace(boxes.tree());
  if (boxes.size() == 0 || bounded_surfaces_ < surfaces_.size() || bounded_instances_ < instances_.size())
    return;
  bounds_ = boxes.around(0);
  for (std::uint32_t k = 0; k < BoxesOverTime::parts && boxes.any_moves(); ++k) {
    by_parts_.push_back(boxes.around(k));
    bounds_ = united(*bounds_, by_parts_.back());
  }
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
    return tree_->visit(
        ray.origin, ray.direction, std::max(ray.after.t, 0.0), ray.t_max,
        [&](std::uint32_t i) { return test(number(i)); }, ray.time);
  for (std::uint32_t i = 0; i < bounded_surfaces_ + bounded_instances_; ++i)
    if (test(number(i)) < 0) return;
}

std::optional<Group::Found> Group::nearest(const GroupRay& ray, RayKind kind) const {
  double t_max = ray.t_max;
  Found best;
  visit(ray, [&](std::uint32_t index) {
    // Of two things at the same t the first wins, whatever the order of the visits: let equals through.
    const double limit = best.index == no_index ? t_max : std::nextafter(t_max, infinity);
    const auto loses = [&](double t, std::uint64_t number) { return t >= t_max && number > best.number; };
    if (index < surfaces_.size()) {
      const PlacedSurface& s = surfaces_[index];
      if (kind == RayKind::camera && !s.surface->visible) return t_max;
      const HitOrder after = among(ray.after, s.number, 1);
      std::optional<ShapeHit> hit;
      placed(s, ray.time, [&](const scene::Shape& shape, const Transform& object_from_group) {
        hit = intersect(shape, parts_, object_from_group.point(ray.origin),
                        object_from_group.vector(ray.direction), limit, {after.t, after.part}, ray.time);
      });
      if (!hit || loses(hit->t, s.number)) return t_max;
      best.surface = *hit;
      best.number = s.number;
      t_max = hit->t;
    } else {
      const PlacedInstance& i = instances_[index - surfaces_.size()];
      if (kind == RayKind::camera && !i.instance->visible) return t_max;
      const auto to_object = object_from_group(i, ray.time);
      if (!to_object) return t_max;
      const auto hit =
          i.prototype->closest_hit({to_object->point(ray.origin), to_object->vector(ray.direction), limit,
                                    ray.time, among(ray.after, i.first_number, i.prototype->numbers())},
                                   kind);
      if (!hit || loses(hit->t, i.first_number + hit->number)) return t_max;
      best.instance = *hit;
      best.number = i.first_number + hit->number;
      t_max = hit->t;
    }
    best.index = index;
    return t_max;
  });
  return best.index == no_index ? std::nullopt : std::optional(best);
}

GroupHit Group::hit_of_surface(const Found& found, double time) const {
  const PlacedSurface& s = surfaces_[found.index];
  const ShapeHit& of_shape = found.surface;
  const Transform to_group = group_from_object(
      s.motion ? s.motion->world_from_object.at(time) : s.surface->world_from_object, s.light);
  const Transform from_group = s.motion ? inverse_of(to_group) : s.object_from_group;
  GroupHit hit;
  hit.t = of_shape.t;
  hit.position = to_group.point(of_shape.position);
  hit.normal = to_group.normal(of_shape.normal);
  hit.error = placed_error(to_group, from_group, of_shape.position, hit.position, of_shape.reach * rounding);
  hit.position_object = of_shape.position;
  hit.normal_object = of_shape.normal;
  hit.shading_normal = to_group.normal(of_shape.shading_normal);
  hit.shading_normal_object = of_shape.shading_normal;
  hit.uv = of_shape.uv;
  if (keeps_axes_)
    hit.normal_axes = {to_group.normal({1, 0, 0}), to_group.normal({0, 1, 0}), to_group.normal({0, 0, 1})};
  hit.sheet = is_sheet(s.surface->shape, parts_);
  hit.material = s.surface->material;
  hit.light = s.light;
  hit.glow = s.glow;
  hit.number = found.number;
  hit.part = of_shape.part;
  if (const auto* mesh = std::get_if<scene::Mesh>(&s.surface->shape))
    hit.mesh = &parts_.meshes[mesh->mesh.index].mesh();
  hit.weights = of_shape.weights;
  hit.priority = s.surface->priority;
  return hit;
}

GroupHit Group::hit_of_instance(const Found& found, double time) const {
  const PlacedInstance& i = instances_[found.index - surfaces_.size()];
  const Transform to_group = group_from_object(
      i.motion ? i.motion->world_from_object.at(time) : i.instance->world_from_object, no_index);
  const Transform from_group = i.motion ? inverse_of(to_group) : i.object_from_group;
  GroupHit hit = found.instance;
  hit.position = to_group.point(hit.position);
  hit.error = placed_error(to_group, from_group, found.instance.position, hit.position, hit.error);
  hit.normal = to_group.normal(hit.normal);
  hit.shading_normal = to_group.normal(hit.shading_normal);
  if (keeps_axes_)
    for (Vec3d& axis : hit.normal_axes) axis = to_group.normal(axis);
  if (!hit.material.valid()) hit.material = i.instance->material;
  hit.number = found.number;
  return hit;
}

std::optional<GroupHit> Group::closest_hit(const GroupRay& ray, RayKind kind) const {
  const auto found = nearest(ray, kind);
  if (!found) return std::nullopt;
  return found->index < surfaces_.size() ? hit_of_surface(*found, ray.time)
                                         : hit_of_instance(*found, ray.time);
}

void Group::for_each_interval(const GroupRay& ray, RayKind kind, scene::MaterialId material,
                              std::uint64_t first_number, const StayVisitor& visitor) const {
  visit(ray, [&](std::uint32_t index) {
    if (index < surfaces_.size()) {
      const PlacedSurface& s = surfaces_[index];
      if (kind == RayKind::camera && !s.surface->visible) return ray.t_max;
      const GroupBody body{first_number + s.number, s.surface->priority,
                           s.surface->material.valid() ? s.surface->material : material};
      placed(s, ray.time, [&](const scene::Shape& shape, const Transform& object_from_group) {
        compile::for_each_interval(shape, parts_, object_from_group.point(ray.origin),
                                   object_from_group.vector(ray.direction), ray.t_max, ray.time,
                                   [&](const Intervald& stay) { visitor(body, stay); });
      });
      return ray.t_max;
    }
    const PlacedInstance& i = instances_[index - surfaces_.size()];
    const auto to_object = object_from_group(i, ray.time);
    if (!to_object || (kind == RayKind::camera && !i.instance->visible)) return ray.t_max;
    i.prototype->for_each_interval(
        {to_object->point(ray.origin), to_object->vector(ray.direction), ray.t_max, ray.time}, kind,
        i.instance->material.valid() ? i.instance->material : material, first_number + i.first_number,
        visitor);
    return ray.t_max;
  });
}

bool Group::touches_another(std::uint64_t surface) const {
  const auto own = std::find_if(surfaces_.begin(), surfaces_.end(),
                                [&](const PlacedSurface& s) { return s.number == surface; });
  CHECK(own != surfaces_.end());
  constexpr Intervald always{0, 1};
  const Bounds b = box(*own, always);
  const auto reaches = [&](std::size_t i) {
    const PlacedSurface& s = surfaces_[i];
    if (s.number == surface || s.light != no_index) return false;
    if (i < bounded_surfaces_) return touching(b, box(s, always));
    const auto* plane = std::get_if<scene::Plane>(&s.surface->shape);
    return !plane || s.motion || on_both_sides(*plane, placed_bounds(b, s.object_from_group));
  };
  for (std::size_t i = 0; i < surfaces_.size(); ++i)
    if (reaches(i)) return true;
  for (std::size_t i = 0; i < instances_.size(); ++i)
    if (i >= bounded_instances_ || touching(b, box(instances_[i], always))) return true;
  return false;
}

bool Group::occluded(const GroupRay& ray, std::uint32_t target_light) const {
  bool blocked = false;
  visit(ray, [&](std::uint32_t index) {
    if (index < surfaces_.size()) {
      const PlacedSurface& s = surfaces_[index];
      if (s.light != no_index && s.light == target_light) return ray.t_max;
      placed(s, ray.time, [&](const scene::Shape& shape, const Transform& object_from_group) {
        blocked = blocks(shape, parts_, object_from_group.point(ray.origin),
                         object_from_group.vector(ray.direction), ray.t_max, ray.time);
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
