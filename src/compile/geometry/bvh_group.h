// Surfaces and instances of other groups in one space, with a tree over them: a scene's, or a prototype's,
// which all its instances share. Rays are moved into the space of what they may meet, in double.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/geometry/bounds_tree.h"
#include "compile/geometry/boxes_over_time.h"
#include "compile/geometry/shape_dispatch.h"

namespace tyndall::compile {

// How a thing moves that is placed in a group.
template <class T>
struct PlacedMotion {
  explicit PlacedMotion(const scene::Moving<T>& moving)
      : keys(&moving), world_from_object(moving, 0), within(scene::moves_within(moving)) {}

  const scene::Moving<T>* keys;
  scene::MovingTransform world_from_object;
  bool within;  // more moves than its transform
};
// Null where nothing moves.
template <class T>
std::shared_ptr<const PlacedMotion<T>> placed_motion(const scene::Moving<T>* moving) {
  return moving ? std::make_shared<const PlacedMotion<T>>(*moving) : nullptr;
}

// A surface as a group keeps it; the rest stays in the scene.
struct PlacedSurface {
  Transform object_from_group;
  std::uint64_t number = 0;  // in the group: HitOrder's
  const scene::ShapeInstance* surface = nullptr;
  std::uint32_t light = no_index;  // of the surface of an area light
  std::uint32_t glow = no_index;   // the light that its glowing material makes it
  std::shared_ptr<const PlacedMotion<scene::ShapeInstance>> motion;  // null: it stands still
};

// The nearest hit in a group's space.
struct GroupHit {
  double t = 0;
  Vec3d position, normal;                       // normal: outward, of any length but zero
  Vec3d error;                                  // of the position, by axis (hit_error.h)
  Vec3d position_object, normal_object;         // in the shape's own space
  Vec3d shading_normal, shading_normal_object;  // zero: as the normal
  Pair<double> uv;
  std::array<Vec3d, 3> normal_axes{};  // images of normals along the object's axes, where kept
  bool sheet = false;                  // of a shape without an inside
  scene::MaterialId material;          // invalid: that of the instance
  std::uint32_t light = no_index, glow = no_index;
  std::uint64_t number = 0;
  std::uint32_t part = 0;
  const scene::TriangleMesh* mesh = nullptr;  // that `part` is a triangle of
  Pair<double> weights;                       // of its second and third corner
  double priority = 0;
};

// A ray in a group's space; the direction has any length but zero, t is the caller's.
struct GroupRay {
  Vec3d origin, direction;
  double t_max = 0, time = 0;
  HitOrder after{};
};

// A closed shape where it stands, with its number (HitOrder's) and the material that it has there.
struct GroupBody {
  std::uint64_t number = 0;
  double priority = 0;
  scene::MaterialId material;
};
using StayVisitor = std::function<void(const GroupBody&, const Intervald&)>;

class Group {
 public:
  // `parts` are what shapes name. `keeps_axes`: hits tell how normals are mapped.
  Group(const ShapeParts& parts, bool keeps_axes) : parts_(parts), keeps_axes_(keeps_axes) {}

  // Adds things; a group is ready for rays after finish(). The scene's elements must stay where they are.
  // `offset` is the group's zero in the space that the things' transforms lead to.
  // `glows`: for each surface the light that its material makes it, or empty.
  // `moving` tells which of the things move, and how; only what `keeps` is true for is there.
  using Keeps = std::function<bool(const scene::ShapeInstance&)>;
  void add(std::span<const scene::ShapeInstance> surfaces,
           std::span<const scene::Moving<scene::ShapeInstance>> moving, const Vec3d& offset = {},
           std::span<const std::uint32_t> glows = {}, const Keeps& keeps = {});
  void add_light(const scene::ShapeInstance& surface, std::uint32_t light,
                 const scene::Moving<scene::ShapeInstance>* motion = nullptr);
  void add(std::span<const scene::Instance> instances, std::span<const scene::Moving<scene::Instance>> moving,
           std::span<const Group> prototypes, const Vec3d& offset = {});
  void finish();

  // Nothing when the group is empty or reaches to infinity.
  const std::optional<Bounds>& bounds() const { return bounds_; }
  // Likewise, within fractions of the time that the shutter is open; there must be some.
  Bounds bounds_within(const Intervald& time) const;
  bool empty() const { return surfaces_.empty() && instances_.empty(); }

  // How many numbers its surfaces and those of its instances have.
  std::uint64_t numbers() const { return numbers_; }

  // The first hit in (ray.after, ray.t_max); of two at the same t that of the earlier surface.
  std::optional<GroupHit> closest_hit(const GroupRay& ray, RayKind kind) const;
  // The ray's intervals in [0, ray.t_max) within each closed surface that rays of this kind meet.
  void for_each_interval(const GroupRay& ray, RayKind kind, const StayVisitor& visitor) const {
    for_each_interval(ray, kind, {}, 0, visitor);
  }
  // Whether the box of a surface of its own touches that of anything else but a light.
  bool touches_another(std::uint64_t surface) const;
  // True when anything but the surface of `target_light` is hit in (0, ray.t_max).
  bool occluded(const GroupRay& ray, std::uint32_t target_light) const;

 private:
  struct PlacedInstance {
    Transform object_from_group;
    const scene::Instance* instance = nullptr;
    const Group* prototype = nullptr;
    std::uint64_t first_number = 0;
    std::shared_ptr<const PlacedMotion<scene::Instance>> motion;
  };
  // A hit as the test of the thing alone tells it, with the thing's index.
  struct Found {
    std::uint32_t index = no_index;
    std::uint64_t number = 0;
    ShapeHit surface;
    GroupHit instance;
  };
  std::optional<Found> nearest(const GroupRay& ray, RayKind kind) const;
  GroupHit hit_of_surface(const Found& found, double time) const;
  GroupHit hit_of_instance(const Found& found, double time) const;
  // In an instance of it whose surfaces have this first number, and this material where they name none.
  void for_each_interval(const GroupRay& ray, RayKind kind, scene::MaterialId material,
                         std::uint64_t first_number, const StayVisitor& visitor) const;
  // Whether it moves or deforms.
  bool moves(const PlacedSurface& s) const;
  // Within fractions of the time that the shutter is open.
  Bounds box(const PlacedSurface& s, const Intervald& time) const;
  Bounds box(const PlacedInstance& i, const Intervald& time) const;
  Transform group_from_object(const Transform& placed, std::uint32_t light) const;
  // Calls visit(shape, object_from_group) for a surface as it is at a ray's time; false where it is flat
  // then.
  template <class Visit>
  bool placed(const PlacedSurface& s, double time, Visit&& visit) const;
  std::optional<Transform> object_from_group(const PlacedInstance& i, double time) const;
  // Calls test(index) for what the ray may meet: surfaces first, then instances, as numbered; test returns
  // the t beyond which nothing matters, or a negative number to stop.
  template <class Test>
  void visit(const GroupRay& ray, Test&& test) const;

  ShapeParts parts_;
  bool keeps_axes_;
  // Each: bounded ones first, in the tree's order; then those that reach to infinity.
  std::vector<PlacedSurface> surfaces_;
  std::vector<PlacedInstance> instances_;
  std::size_t bounded_surfaces_ = 0, bounded_instances_ = 0;
  std::uint64_t numbers_ = 0;
  Vec3d offset_;
  std::optional<BoundsTree> tree_;
  std::optional<Bounds> bounds_;
  std::vector<Bounds> by_parts_;  // of the time, as BoxesOverTime has them; none when nothing moves
};

// The box around a shape's own box where a transform puts it.
Bounds placed_bounds(const Bounds& b, const Transform& to);
// The box, and as much room on each side.
Bounds padded(const Bounds& b, double room);
// The distance from a point to the farthest corner of a box.
double reach(const Bounds& b, const Vec3d& from);

// The box around all places of a thing that moves, within fractions of the time that the shutter is open,
// where own_box(thing) is its box at a moment in the space of its transform number `transform`, which
// place(thing) gives. Between two moments every point of it is within the bend of a mixture of four such
// boxes: with the shape of one moment and the place of the other, too (a product of two straight ways).
template <class T, class Box, class Place>
Bounds swept_bounds(const scene::Moving<T>& moving, std::size_t transform, Box&& own_box, Place&& place,
                    const Intervald& time = {0, 1}) {
  std::optional<Bounds> all;
  Bounds box_before{};
  Transform place_before;
  double farthest = 0;
  const Vec3d pivot = moving.turnings.empty() ? Vec3d{} : moving.turnings[transform].pivot;
  for (const double moment : scene::moments(moving, time.lo, time.hi)) {
    const T now = scene::at(moving, moment);
    const Bounds box_now = own_box(now);
    const Transform place_now = place(now);
    const Bounds here = placed_bounds(box_now, place_now);
    all = all ? united(united(*all, here),
                       united(placed_bounds(box_before, place_now), placed_bounds(box_now, place_before)))
              : here;
    farthest = std::max(farthest, reach(box_now, pivot));
    box_before = box_now;
    place_before = place_now;
  }
  return padded(*all, scene::bend(moving, transform) * farthest);
}

// Up to this many things a plain loop is faster than a tree.
inline constexpr std::size_t few_things = 8;

}  // namespace tyndall::compile
