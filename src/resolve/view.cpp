// What stands out of the picture, and lights inside of opaque shapes: see view.h.
#include "resolve/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/numerics.h"
#include "base/overloaded.h"
#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

// One picture, without motion.
bool is_still(const scene::Animation& a) { return a.first_frame == a.last_frame && a.shutter.radians == 0; }

struct Bounds {
  Vec3d low, high;
};

// The box around a closed shape in its own space; nothing for open ones.
std::optional<Bounds> bounds(const scene::Scene& scene, const scene::Shape& shape) {
  return std::visit(Overloaded{
                        [](const scene::Sphere& s) -> std::optional<Bounds> {
                          return Bounds{s.center - Vec3d(s.radius), s.center + Vec3d(s.radius)};
                        },
                        [](const scene::Box& b) -> std::optional<Bounds> {
                          return Bounds{b.min, b.max};
                        },
                        [](const scene::Cylinder& c) -> std::optional<Bounds> {
                          Bounds box;
                          for (std::size_t i = 0; i < 3; ++i) {
                            box.low[i] = std::min(c.from[i], c.to[i]) - c.radius;
                            box.high[i] = std::max(c.from[i], c.to[i]) + c.radius;
                          }
                          return box;
                        },
                        [&](const scene::Mesh& m) -> std::optional<Bounds> {
                          Bounds box{Vec3d(infinity), Vec3d(-infinity)};
                          for (const Vec3d& p : scene.meshes[m.mesh.index].points)
                            for (std::size_t i = 0; i < 3; ++i) {
                              box.low[i] = std::min(box.low[i], p[i]);
                              box.high[i] = std::max(box.high[i], p[i]);
                            }
                          return box;
                        },
                        [](const auto&) -> std::optional<Bounds> { return std::nullopt; },
                    },
                    shape);
}

// The side of a plane on which dot(normal, p) + offset >= 0.
struct HalfSpace {
  Vec3d normal;
  double offset;
  double distance(const Vec3d& p) const { return dot(normal, p) + offset; }
};

// Pixels around the picture that a filter may reach.
constexpr double margin_pixels = 2;

// Half-spaces that hold all that the camera sees; none when it sees everything.
std::vector<HalfSpace> seen_by(const scene::PerspectiveCamera& c, const scene::RenderSettings& settings) {
  const auto world_from_camera = Transform::look_at(c.from, c.to, c.up);
  if (!world_from_camera) return {};
  const Vec3d forward = -world_from_camera->z;
  const double focus = c.focus > 0 ? c.focus : length(c.to - c.from);
  const double tan_y = std::tan(c.fov.radians / 2) * (1 + 2 * margin_pixels / settings.height);
  const double tan_x = tan_y * (settings.width + 2 * margin_pixels) / settings.height;
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
  const double half_pixel = c.height / settings.height / 2;
  const double half_height = half_pixel * (settings.height + 2 * margin_pixels),
               half_width = half_pixel * (settings.width + 2 * margin_pixels);
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

// Whether all corners of the box are on the far side of one plane: then it is out of the picture for certain.
bool outside(const Bounds& box, const Transform& world_from_box, const std::vector<HalfSpace>& spaces) {
  return std::any_of(spaces.begin(), spaces.end(), [&](const HalfSpace& space) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d p{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                    corner & 4 ? box.high.z : box.low.z};
      if (!(space.distance(world_from_box.point(p)) < 0)) return false;
    }
    return true;
  });
}

// A ball; a negative radius makes `contains` true for all balls that may reach inside.
struct Ball {
  Vec3d center;
  double radius;
};

// Whether the ball is inside of the shape; false for shapes of which that is not known.
bool contains(const scene::Shape& shape, const Transform& object_from_world, const Ball& ball) {
  const Vec3d c = object_from_world.point(ball.center);
  // No length grows by more than the root of the sum of the squares of the matrix.
  const double r =
      ball.radius * std::sqrt(length_squared(object_from_world.x) + length_squared(object_from_world.y) +
                              length_squared(object_from_world.z));
  return std::visit(Overloaded{
                        [&](const scene::Sphere& s) { return length(c - s.center) + r < s.radius; },
                        [&](const scene::Box& b) {
                          for (std::size_t i = 0; i < 3; ++i)
                            if (!(c[i] - r > b.min[i] && c[i] + r < b.max[i])) return false;
                          return true;
                        },
                        [&](const scene::Cylinder& s) {
                          const double height = length(s.to - s.from);
                          const Vec3d axis = (s.to - s.from) / height;
                          const double along = dot(c - s.from, axis);
                          return along - r > 0 && along + r < height &&
                                 length(c - s.from - axis * along) + r < s.radius;
                        },
                        [](const auto&) { return false; },
                    },
                    shape);
}

// The ball around a light; nothing for one without a place.
std::optional<Ball> ball_around(const optics::Light& light) {
  return std::visit(Overloaded{
                        [](const optics::PointLight& l) -> std::optional<Ball> {
                          return Ball{l.position, 0};
                        },
                        [](const optics::SpotLight& l) -> std::optional<Ball> {
                          return Ball{l.position, 0};
                        },
                        [](const optics::SphereLight& l) -> std::optional<Ball> {
                          return Ball{l.center, l.radius};
                        },
                        [](const optics::DiskLight& l) -> std::optional<Ball> {
                          return Ball{l.center, l.radius};
                        },
                        [](const optics::QuadLight& l) -> std::optional<Ball> {
                          return Ball{l.center, length(l.u) + length(l.v)};
                        },
                        [](const auto&) -> std::optional<Ball> { return std::nullopt; },
                    },
                    light);
}

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

// A ball around all places from which the camera looks.
Ball eye(const scene::Scene& scene) {
  return std::visit(Overloaded{
                        [](const scene::PerspectiveCamera& c) {
                          return Ball{c.from, c.aperture};
                        },
                        [&](const scene::OrthographicCamera& c) {
                          const double aspect = double(scene.settings.width) / scene.settings.height;
                          return Ball{c.from, c.height * std::hypot(1, aspect)};
                        },
                        [](const scene::SphericalCamera& c) {
                          return Ball{c.from, 0};
                        },
                    },
                    scene.camera);
}

}  // namespace

void warn_of_volumes_out_of_view(Run& run) {
  const scene::Scene& s = run.scene;
  if (!is_still(s.animation)) return;
  const std::vector<HalfSpace> spaces =
      std::visit([&](const auto& camera) { return seen_by(camera, s.settings); }, s.camera);
  if (spaces.empty()) return;
  // By statement: a loop or an object may place some of its volumes in the picture.
  struct Seen {
    Span definition;
    bool perhaps = false;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Seen> statements;
  for (const scene::Volume& volume : scene::all_volumes(s)) {
    Seen& seen = statements[{volume.definition.source.index, volume.definition.begin}];
    seen.definition = volume.definition;
    const std::optional<Bounds> box = seen.perhaps ? std::nullopt : bounds(s, volume.shape);
    // What gives light shows itself on other things.
    const bool shines = s.media[volume.medium.index].emission.has_value();
    seen.perhaps = !volume.visible || shines || !box || !outside(*box, volume.world_from_shape, spaces);
  }
  for (const auto& [place, seen] : statements)
    if (!seen.perhaps)
      run.diagnostics.warning(seen.definition, "nothing of this volume is in the picture",
                              "it can only shade other things; where that is meant, say `visible: false`");
}

void warn_of_lights_shut_in(Run& run) {
  const scene::Scene& s = run.scene;
  // Of lights and shapes: a warning is not to take seconds.
  constexpr std::size_t most_pairs = 1'000'000;
  if (!is_still(s.animation) || s.lights.empty()) return;
  const Ball camera = eye(s);
  const auto look = [&](const scene::ShapeInstance& shape, const Transform& world_from_object,
                        scene::MaterialId material) {
    if (!shape.visible || run.bodies.may_let_through.contains(material.index)) return;
    const auto object_from_world = world_from_object.inverse();
    if (!object_from_world || contains(shape.shape, *object_from_world, {camera.center, -camera.radius}))
      return;
    for (const scene::LightInstance& light : s.lights) {
      const std::optional<Ball> ball = ball_around(light.light);
      if (ball && contains(shape.shape, *object_from_world, *ball))
        run.diagnostics.warning(light.definition, "this light is inside an opaque shape: it lights nothing",
                                "move it out, or make the shape a volume",
                                {{shape.definition, "the shape is here"}});
    }
  };
  std::size_t left = most_pairs / s.lights.size();
  for_placed_shapes(s, s, {}, {}, left, look);
}

}  // namespace tyndall::resolve
