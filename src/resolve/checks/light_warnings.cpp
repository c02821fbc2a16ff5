// Lights inside of opaque shapes, and lights that are turned away: see light_warnings.h.
#include "resolve/checks/light_warnings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numerics.h"
#include "base/overloaded.h"
#include "resolve/checks/placed_things.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

using shapes::Bounds;

// Of lights and shapes: a warning is not to take seconds.
constexpr std::size_t most_pairs = 1'000'000;

// All boxes in which the scene has something that light may fall on; nothing where something has no end.
std::optional<std::vector<PlacedBox>> boxes_of_all(const scene::Scene& s) {
  Boxes boxes(s);
  std::vector<PlacedBox> all;
  const auto add = [&](const std::optional<Bounds>& box, const Transform& world_from_box) {
    if (box && !is_void(*box)) all.push_back({*box, world_from_box});
    return box.has_value();
  };
  for (const scene::ShapeInstance& shape : s.shapes)
    if (!add(boxes.of(shape.shape), shape.world_from_object)) return std::nullopt;
  for (const scene::Volume& volume : s.volumes)
    if (!add(boxes.of(volume.shape), volume.world_from_shape)) return std::nullopt;
  for (const scene::Instance& instance : s.instances)
    // What is in it and not visible has no place in its box.
    if (!instance.visible || !add(boxes.of(instance.prototype), instance.world_from_object))
      return std::nullopt;
  for (const scene::Prototype& prototype : s.prototypes) {
    const auto hidden = [](const auto& thing) { return !thing.visible; };
    if (std::any_of(prototype.shapes.begin(), prototype.shapes.end(), hidden) ||
        std::any_of(prototype.volumes.begin(), prototype.volumes.end(), hidden) ||
        std::any_of(prototype.instances.begin(), prototype.instances.end(), hidden))
      return std::nullopt;
  }
  return all;
}

// How a light says where it shines to, and how that is changed.
struct Reach {
  HalfSpace front;
  std::optional<std::pair<Vec3d, double>> cone{};  // the axis, and the angle from it; front passes its tip
  std::string_view help;

  // Whether a box is out of it for certain.
  bool misses(const PlacedBox& box, const Vec3d& tip) const {
    if (!cone) return box.outside({front});
    const Bounds world = box.in_world();
    const Vec3d to = (world.lo + world.hi) * 0.5 - tip;
    const double radius = length(world.hi - world.lo) / 2, distance = length(to);
    if (!(distance > radius)) return false;
    const double off = std::acos(std::clamp(dot(to, cone->first) / distance, -1.0, 1.0));
    return off - std::asin(radius / distance) > cone->second;
  }
};

std::optional<Reach> shines_towards(const scene::Light& light) {
  const auto in_front_of = [](const Vec3d& point, const Vec3d& normal, std::string_view help) {
    return Reach{{normal, -dot(normal, point)}, {}, help};
  };
  if (const auto* spot = std::get_if<scene::SpotLight>(&light)) {
    const Vec3d axis = normalize(spot->to - spot->position);
    Reach reach = in_front_of(spot->position, axis, "turn it: its axis goes through `to`");
    reach.cone = std::pair(axis, spot->angle.radians);
    return reach;
  }
  const auto* area = std::get_if<scene::AreaLight>(&light);
  if (!area || area->world_from_shape) return std::nullopt;
  if (const auto* quad = std::get_if<shapes::Quad>(&area->shape))
    return in_front_of(quad->center, cross(quad->u, quad->v),
                       "it shines to the side of u × v: exchange `u` and `v`");
  if (const auto* disk = std::get_if<shapes::Disk>(&area->shape))
    return in_front_of(disk->center, disk->normal, "it shines to the side of its `normal`: turn that");
  return std::nullopt;
}

}  // namespace

void warn_of_lights_shut_in(Run& run, const scene::RenderSettings& settings) {
  const scene::Scene& s = run.scene;
  if (!is_still(s.animation) || s.lights.empty()) return;
  const Ball camera = eye_of(s.camera, settings);
  const Balls balls(s);
  Insides insides(s);
  const auto look = [&](const scene::ShapeInstance& shape, const Transform& world_from_object,
                        scene::MaterialId material) {
    if (!shape.visible || run.bodies.may_let_through.contains(material.index)) return;
    const auto object_from_world = world_from_object.inverse();
    if (!object_from_world) return;
    for (const scene::LightInstance& light : s.lights) {
      const std::optional<Ball> ball = ball_around(light.light, balls);
      if (!ball || !insides.contains(shape.shape, *object_from_world, *ball)) continue;
      if (insides.contains(shape.shape, *object_from_world, {camera.center, -camera.radius})) return;
      run.diagnostics.warning(light.definition, "this light is inside an opaque shape: it lights nothing",
                              "move it out, or make the shape a volume",
                              {{shape.definition, "the shape is here"}});
    }
  };
  std::size_t left = most_pairs / s.lights.size();
  for_placed_shapes(s, s, {}, {}, left, look);
}

void warn_of_lights_turned_away(Run& run, const scene::RenderSettings& settings) {
  const scene::Scene& s = run.scene;
  if (!is_still(s.animation)) return;
  std::optional<std::vector<PlacedBox>> boxes;
  const Ball eye = eye_of(s.camera, settings);
  for (const scene::LightInstance& light : s.lights) {
    const std::optional<Reach> reach = shines_towards(light.light);
    if (!reach) continue;
    if (!boxes) boxes = boxes_of_all(s);
    if (!boxes || boxes->empty() || boxes->size() * s.lights.size() > most_pairs) return;
    // Who looks at its front sees it shine.
    const auto* area = std::get_if<scene::AreaLight>(&light.light);
    if (area && area->visible &&
        reach->front.distance(eye.center) > -eye.radius * length(reach->front.normal))
      continue;
    const Vec3d tip = std::visit([](const auto& l) { return l.point(); }, light.light).value_or(Vec3d{});
    if (std::all_of(boxes->begin(), boxes->end(), [&](const PlacedBox& b) { return reach->misses(b, tip); }))
      run.diagnostics.warning(light.definition,
                              "this light is turned away from all there is: it lights nothing",
                              std::string(reach->help));
  }
}

}  // namespace tyndall::resolve
