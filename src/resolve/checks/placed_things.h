// Where the things of a scene are, as far as boxes, balls and depths tell it without rays.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "base/numerics.h"
#include "resolve/motion_error.h"
#include "scene/scene.h"

namespace tyndall::resolve {

// One picture, without motion.
bool is_still(const scene::Animation& animation);

// The side of a plane on which dot(normal, p) + offset >= 0.
struct HalfSpace {
  Vec3d normal;
  double offset;
  double distance(const Vec3d& p) const { return dot(normal, p) + offset; }
};

// A box in a space of its own.
struct PlacedBox {
  shapes::Bounds box;
  Transform world_from_box;

  std::array<Vec3d, 8> corners() const;
  shapes::Bounds in_world() const;
  // Whether all of it is on the far side of one plane.
  bool outside(const std::vector<HalfSpace>& spaces) const;
};

// The boxes around shapes in their own spaces, and around what objects hold; those of meshes are found once.
class Boxes {
 public:
  explicit Boxes(const scene::Scene& scene) : scene_(scene) {}
  // Nothing for what has no end.
  std::optional<shapes::Bounds> of(const scene::Shape& shape);
  // Around all that the camera may see of it: shapes and volumes. An empty one where there is nothing.
  std::optional<shapes::Bounds> of(scene::PrototypeId prototype);

 private:
  template <class Things>
  bool grow(shapes::Bounds& all, const Things& things);

  const scene::Scene& scene_;
  std::map<std::uint32_t, std::optional<shapes::Bounds>> meshes_, strand_sets_, prototypes_;
};

inline constexpr shapes::Bounds empty_box{Vec3d(infinity), Vec3d(-infinity)};
inline bool is_void(const shapes::Bounds& box) { return !(box.lo.x <= box.hi.x); }
void grow(shapes::Bounds& box, const Vec3d& p);
bool overlap(const shapes::Bounds& a, const shapes::Bounds& b);

// Whether balls are inside of closed shapes. What may be asked of meshes has a limit, beyond which nothing is
// known of them.
class Insides {
 public:
  explicit Insides(const scene::Scene& scene) : scene_(scene), boxes_(scene) {}
  // Whether the ball is inside of the shape, or, when its radius is negative, may reach inside; false for
  // shapes of which that is not known.
  bool contains(const scene::Shape& shape, const Transform& object_from_world, const Ball& ball);

 private:
  bool mesh_contains(const scene::Mesh& shape, const Vec3d& c, double r);

  const scene::Scene& scene_;
  Boxes boxes_;
  std::size_t triangles_left_ = 20'000'000;
};

// The ball around a light; nothing for one without a place.
std::optional<Ball> ball_around(const scene::Light& light, const Balls& balls);

// A ball around all places from which the camera looks.
Ball eye_of(const scene::Camera& camera, const scene::RenderSettings& settings);

// Calls visit(shape, world_from_object, material) for the shapes of a scene or prototype and of the objects
// placed in it, `left` of them at most. `inherited`: the material of shapes without one.
template <class Things, class Visit>
void for_placed_shapes(const scene::Scene& scene, const Things& things, const Transform& world_from_things,
                       scene::MaterialId inherited, std::size_t& left, Visit&& visit) {
  for (const scene::ShapeInstance& shape : things.shapes) {
    if (left == 0) return;
    --left;
    visit(shape, world_from_things * shape.world_from_object,
          shape.material.valid() ? shape.material : inherited);
  }
  for (const scene::Instance& instance : things.instances) {
    if (left == 0) return;
    if (!instance.visible) continue;
    for_placed_shapes(scene, scene.prototypes[instance.prototype.index],
                      world_from_things * instance.world_from_object,
                      instance.material.valid() ? instance.material : inherited, left, visit);
  }
}

}  // namespace tyndall::resolve
