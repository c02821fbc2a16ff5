// What stands out of the picture, and cameras that see nothing: see view_warnings.h.
#include "resolve/checks/view_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/numerics.h"
#include "resolve/checks/placed_things.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

using shapes::Bounds;

// Pixels around the picture that a filter may reach.
constexpr double margin_pixels = 2;

// Half-spaces that hold all that the camera sees; none when it sees everything.
std::vector<HalfSpace> seen_by(const scene::PerspectiveCamera& c, const scene::RenderSettings& settings) {
  const auto world_from_camera = Transform::look_at(c.from, c.to, c.up);
  if (!world_from_camera) return {};
  const Vec3d forward = -world_from_camera->z;
  const double focus = c.focus > 0 ? c.focus : length(c.to - c.from);
  const double tan_y = std::tan(c.fov.radians / 2) * (1 + 2 * margin_pixels / settings.resolution.height);
  const double tan_x = tan_y * (settings.resolution.width + 2 * margin_pixels) / settings.resolution.height;
  std::vector<HalfSpace> spaces;
  const auto add = [&](const Vec3d& normal, double slack) {
    spaces.push_back({normal, slack - dot(normal, c.from)});
  };
  add(forward, 0);
  // A ray goes from a point of the lens, up to `aperture` beside the axis, through one of the focal plane: it
  // stays within the cone widened by aperture / focus and moved outwards by the aperture.
  for (const double side : {-1.0, 1.0}) {
    add(forward * (tan_x + c.aperture / focus) + world_from_camera->x * side, c.aperture);
    add(forward * (tan_y + c.aperture / focus) + world_from_camera->y * side, c.aperture);
  }
  return spaces;
}

std::vector<HalfSpace> seen_by(const scene::OrthographicCamera& c, const scene::RenderSettings& settings) {
  const auto world_from_camera = Transform::look_at(c.from, c.to, c.up);
  if (!world_from_camera) return {};
  const double half_pixel = c.height / settings.resolution.height / 2;
  const double half_height = half_pixel * (settings.resolution.height + 2 * margin_pixels),
               half_width = half_pixel * (settings.resolution.width + 2 * margin_pixels);
  std::vector<HalfSpace> spaces;
  const auto add = [&](const Vec3d& normal, double slack) {
    spaces.push_back({normal, slack - dot(normal, c.from)});
  };
  add(-world_from_camera->z, 0);
  for (const double side : {-1.0, 1.0}) {
    add(world_from_camera->x * side, half_width);
    add(world_from_camera->y * side, half_height);
  }
  return spaces;
}

std::vector<HalfSpace> seen_by(const scene::SphericalCamera&, const scene::RenderSettings&) { return {}; }

// The box around all that the camera might see, lights among it; nothing where some of it is in the picture,
// or has no end.
std::optional<Bounds> box_of_the_unseen(const scene::Scene& s, const std::vector<HalfSpace>& spaces,
                                        Boxes& boxes) {
  Bounds all = empty_box;
  const auto is_out = [&](const std::optional<Bounds>& box, const Transform& world_from_box) {
    if (!box) return false;
    if (is_void(*box)) return true;
    const PlacedBox placed{*box, world_from_box};
    for (const Vec3d& corner : placed.corners()) grow(all, corner);
    return placed.outside(spaces);
  };
  for (const scene::ShapeInstance& shape : s.shapes)
    if (shape.visible && !is_out(boxes.of(shape.shape), shape.world_from_object)) return std::nullopt;
  for (const scene::Volume& volume : s.volumes)
    if (volume.visible && !is_out(boxes.of(volume.shape), volume.world_from_shape)) return std::nullopt;
  for (const scene::Instance& instance : s.instances)
    if (instance.visible && !is_out(boxes.of(instance.prototype), instance.world_from_object))
      return std::nullopt;
  for (const scene::LightInstance& light : s.lights)
    if (const auto* area = std::get_if<scene::AreaLight>(&light.light); area && area->visible)
      if (!is_out(boxes.of(area->shape), area->world_from_shape.value_or(Transform{}))) return std::nullopt;
  if (is_void(all)) return std::nullopt;
  return all;
}

void warn_of_volumes(Run& run, const std::vector<HalfSpace>& spaces, Boxes& boxes) {
  const scene::Scene& s = run.scene;
  // By statement: a loop or an object may place some of its volumes in the picture.
  struct Seen {
    Span definition;
    bool perhaps = false;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Seen> statements;
  for (const scene::Volume& volume : scene::all_volumes(s)) {
    Seen& seen = statements[{volume.definition.source.index, volume.definition.begin}];
    seen.definition = volume.definition;
    if (seen.perhaps) continue;
    const std::optional<Bounds> box = boxes.of(volume.shape);
    // What gives light shows itself on other things.
    const bool shines = s.media[volume.medium.index].emission.has_value();
    seen.perhaps =
        !volume.visible || shines || !box || !PlacedBox{*box, volume.world_from_shape}.outside(spaces);
  }
  for (const auto& [place, seen] : statements)
    if (!seen.perhaps)
      run.diagnostics.warning(seen.definition, "nothing of this volume is in the picture",
                              "it can only shade other things; where that is meant, say `visible: false`");
}

// Whether any light may be inside of the shape, which itself gives none.
bool may_be_lit_inside(const scene::Scene& s, const scene::Shape& shape, const Transform& object_from_world,
                       const Bounds& in_world, const Balls& balls, Boxes& boxes, Insides& insides) {
  for (const scene::LightInstance& light : s.lights)
    if (const std::optional<Ball> ball = ball_around(light.light, balls))
      if (insides.contains(shape, object_from_world, {ball->center, -std::max(ball->radius, 1e-300)}))
        return true;
  for (const scene::Volume& volume : scene::all_volumes(s)) {
    if (!s.media[volume.medium.index].emission) continue;
    const std::optional<Bounds> box = boxes.of(volume.shape);
    if (!box || overlap(PlacedBox{*box, volume.world_from_shape}.in_world(), in_world)) return true;
  }
  bool lit = false;
  std::size_t left = 100'000;
  for_placed_shapes(
      s, s, {}, {}, left,
      [&](const scene::ShapeInstance& other, const Transform& world_from_object, scene::MaterialId material) {
        if (lit || !material.valid() || !s.materials[material.index].emission) return;
        const std::optional<Bounds> box = boxes.of(other.shape);
        lit = !box || overlap(PlacedBox{*box, world_from_object}.in_world(), in_world);
      });
  return lit || left == 0;
}

void warn_of_camera_in_shapes(Run& run, const Ball& eye, Boxes& boxes) {
  const scene::Scene& s = run.scene;
  const Balls balls(s);
  Insides insides(s);
  bool told = false;
  std::size_t left = 1'000'000;
  const auto look = [&](const scene::ShapeInstance& shape, const Transform& world_from_object,
                        scene::MaterialId material) {
    if (told || !shape.visible || !material.valid() || run.bodies.may_let_through.contains(material.index))
      return;
    const auto object_from_world = world_from_object.inverse();
    if (!object_from_world || !insides.contains(shape.shape, *object_from_world, eye)) return;
    const Bounds in_world = PlacedBox{*boxes.of(shape.shape), world_from_object}.in_world();
    if (may_be_lit_inside(s, shape.shape, *object_from_world, in_world, balls, boxes, insides)) return;
    told = true;
    run.diagnostics.warning(run.camera,
                            "the camera is inside an opaque shape without a light in it: it sees black",
                            "move the camera out, put a light in, or make the shape a volume",
                            {{shape.definition, "the shape is here"}});
  };
  for_placed_shapes(s, s, {}, {}, left, look);
}

void warn_of_camera_in_lights(Run& run, const Ball& eye) {
  Insides insides(run.scene);
  for (const scene::LightInstance& light : run.scene.lights) {
    const auto* area = std::get_if<scene::AreaLight>(&light.light);
    if (!area || !area->visible) continue;
    const auto shape_from_world = area->world_from_shape.value_or(Transform{}).inverse();
    if (!shape_from_world || !insides.contains(area->shape, *shape_from_world, eye)) continue;
    return run.diagnostics.warning(run.camera, "the camera is inside a light, which shines outwards alone",
                                   "move the camera out, or say `visible: false` of the light",
                                   {{light.definition, "the light is here"}});
  }
}

}  // namespace

void warn_of_what_is_out_of_view(Run& run, const scene::RenderSettings& settings) {
  const scene::Scene& s = run.scene;
  if (!is_still(s.animation)) return;
  const std::vector<HalfSpace> spaces =
      std::visit([&](const auto& camera) { return seen_by(camera, settings); }, s.camera);
  if (spaces.empty()) return;
  Boxes boxes(s);
  const std::optional<Bounds> unseen = box_of_the_unseen(s, spaces, boxes);
  if (!unseen) return warn_of_volumes(run, spaces, boxes);
  const Vec3d middle = (unseen->lo + unseen->hi) * 0.5;
  run.diagnostics.warning(run.camera, "nothing of the scene is in the picture: the camera looks past it all",
                          fmt::format("the middle of all there is: `to: ({:.3g}, {:.3g}, {:.3g})`", middle.x,
                                      middle.y, middle.z));
}

void warn_of_camera_shut_in(Run& run, const scene::RenderSettings& settings) {
  if (!is_still(run.scene.animation)) return;
  const Ball eye = eye_of(run.scene.camera, settings);
  Boxes boxes(run.scene);
  warn_of_camera_in_shapes(run, eye, boxes);
  warn_of_camera_in_lights(run, eye);
}

}  // namespace tyndall::resolve
