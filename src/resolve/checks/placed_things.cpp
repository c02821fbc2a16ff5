#include "resolve/checks/placed_things.h"

#include <cmath>

#include "base/numerics.h"
#include "base/overloaded.h"

namespace tyndall::resolve {

namespace {

using shapes::Bounds;

// No length grows by more than the root of the sum of the squares of the matrix.
double most_growth(const Transform& t) {
  return std::sqrt(length_squared(t.x) + length_squared(t.y) + length_squared(t.z));
}

Bounds box_around(const std::vector<Vec3d>& points, double more = 0) {
  Bounds box = empty_box;
  for (const Vec3d& p : points) grow(box, p);
  return {box.lo - Vec3d(more), box.hi + Vec3d(more)};
}

// Catmull and Rom's spline between two points leaves their box by no more than a quarter of the ways to
// their neighbours.
double spline_room(const shapes::StrandSet& set) {
  double longest = 0;
  for (std::size_t i = 1; i < set.points.size(); ++i)
    longest = std::max(longest, length(set.points[i] - set.points[i - 1]));
  return longest / 2 + *std::max_element(set.radii.begin(), set.radii.end());
}

}  // namespace

bool is_still(const scene::Animation& a) { return a.first_frame == a.last_frame && !a.shutter.open(); }

void grow(Bounds& box, const Vec3d& p) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::min(box.lo[axis], p[axis]);
    box.hi[axis] = std::max(box.hi[axis], p[axis]);
  }
}

bool overlap(const Bounds& a, const Bounds& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.hi[axis] < b.lo[axis] || b.hi[axis] < a.lo[axis]) return false;
  return true;
}

std::array<Vec3d, 8> PlacedBox::corners() const {
  std::array<Vec3d, 8> out;
  for (std::size_t corner = 0; corner < out.size(); ++corner)
    out[corner] = world_from_box.point({corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                                        corner & 4 ? box.hi.z : box.lo.z});
  return out;
}

Bounds PlacedBox::in_world() const {
  Bounds out = empty_box;
  for (const Vec3d& corner : corners()) grow(out, corner);
  return out;
}

bool PlacedBox::outside(const std::vector<HalfSpace>& spaces) const {
  const std::array<Vec3d, 8> all = corners();
  return std::any_of(spaces.begin(), spaces.end(), [&](const HalfSpace& space) {
    return std::all_of(all.begin(), all.end(), [&](const Vec3d& p) { return space.distance(p) < 0; });
  });
}

std::optional<Bounds> Boxes::of(const scene::Shape& shape) {
  using Result = std::optional<Bounds>;
  return std::visit(Overloaded{
                        [&](const scene::Mesh& m) -> Result {
                          Result& known = meshes_[m.mesh.index];
                          if (!known) known = box_around(scene_.meshes[m.mesh.index]->points);
                          return known;
                        },
                        [&](const scene::Curves& c) -> Result {
                          const shapes::StrandSet& set = scene_.strand_sets[c.strands.index];
                          Result& known = strand_sets_[c.strands.index];
                          if (!known)
                            known = set.points.empty() ? empty_box : box_around(set.points, spline_room(set));
                          return known;
                        },
                        [](const shapes::Analytic auto& s) -> Result {
                          if constexpr (shapes::Bounded<std::decay_t<decltype(s)>>)
                            return s.bounds();
                          else
                            return std::nullopt;
                        },
                    },
                    shape);
}

// False when something in it has no end.
template <class Things>
bool Boxes::grow(Bounds& all, const Things& things) {
  const auto add = [&](const std::optional<Bounds>& box, const Transform& world_from_box) {
    if (!box) return false;
    if (is_void(*box)) return true;
    for (const Vec3d& corner : PlacedBox{*box, world_from_box}.corners()) resolve::grow(all, corner);
    return true;
  };
  for (const scene::ShapeInstance& shape : things.shapes)
    if (shape.visible && !add(of(shape.shape), shape.world_from_object)) return false;
  for (const scene::Volume& volume : things.volumes)
    if (volume.visible && !add(of(volume.shape), volume.world_from_shape)) return false;
  for (const scene::Instance& instance : things.instances)
    if (instance.visible && !add(of(instance.prototype), instance.world_from_object)) return false;
  return true;
}

std::optional<Bounds> Boxes::of(scene::PrototypeId prototype) {
  const auto known = prototypes_.find(prototype.index);
  if (known != prototypes_.end()) return known->second;
  Bounds all = empty_box;
  const bool ends = grow(all, scene_.prototypes[prototype.index]);
  return prototypes_[prototype.index] = ends ? std::optional(all) : std::nullopt;
}

// By the number of triangles that a line from the point crosses; its direction lies in no plane that anyone
// writes down.
bool Insides::mesh_contains(const scene::Mesh& shape, const Vec3d& c, double r) {
  const scene::SharedMesh& mesh = scene_.meshes[shape.mesh.index];
  const Vec3d reach(std::max(-r, 0.0));
  if (!overlap(*boxes_.of(shape), {c - reach, c + reach})) return false;
  if (mesh->thin || mesh->triangles.size() > triangles_left_) return false;
  triangles_left_ -= mesh->triangles.size();
  const Vec3d direction{0.5412318, 0.3217719, 0.7768431};
  bool inside = false;
  for (const auto& triangle : mesh->triangles) {
    const Vec3d &a = mesh->points[triangle[0]], &b = mesh->points[triangle[1]],
                &d = mesh->points[triangle[2]];
    // The ball touches no triangle whose box it does not reach.
    double gap2 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double lo = std::min({a[axis], b[axis], d[axis]}), hi = std::max({a[axis], b[axis], d[axis]});
      gap2 += sqr(std::max({lo - c[axis], c[axis] - hi, 0.0}));
    }
    const Vec3d e1 = b - a, e2 = d - a, to = c - a, normal = cross(e1, e2);
    // … nor one whose plane it does not reach.
    const bool beyond = sqr(dot(normal, to)) >= sqr(r) * length_squared(normal);
    if (gap2 < sqr(r) && !beyond) return r < 0;
    const Vec3d p = cross(direction, e2), q = cross(to, e1);
    const double determinant = dot(e1, p), u = dot(to, p) / determinant, v = dot(direction, q) / determinant;
    if (u >= 0 && v >= 0 && u + v < 1 && dot(e2, q) / determinant > 0) inside = !inside;
  }
  return inside && scene::open_edges(mesh) == 0;
}

bool Insides::contains(const scene::Shape& shape, const Transform& object_from_world, const Ball& ball) {
  const Vec3d c = object_from_world.point(ball.center);
  const double r = ball.radius * most_growth(object_from_world);
  return std::visit(Overloaded{
                        [&](const scene::Mesh& m) { return mesh_contains(m, c, r); },
                        [](const scene::Curves&) { return false; },
                        [&](const shapes::Analytic auto& s) {
                          if constexpr (shapes::Closed<std::decay_t<decltype(s)>>)
                            return s.depth(c) > r;
                          else
                            return false;
                        },
                    },
                    shape);
}

std::optional<Ball> ball_around(const scene::Light& light, const Balls& balls) {
  if (const auto place = std::visit([](const auto& l) { return l.point(); }, light)) return Ball{*place, 0};
  const auto* area = std::get_if<scene::AreaLight>(&light);
  if (!area) return std::nullopt;
  const Ball ball = balls.of(area->shape);
  if (!area->world_from_shape) return ball;
  const Transform& t = *area->world_from_shape;
  return Ball{t.point(ball.center), ball.radius * most_growth(t)};
}

Ball eye_of(const scene::Camera& camera, const scene::RenderSettings& settings) {
  return std::visit(Overloaded{
                        [](const scene::PerspectiveCamera& c) {
                          return Ball{c.from, c.aperture};
                        },
                        [&](const scene::OrthographicCamera& c) {
                          const double aspect =
                              double(settings.resolution.width) / settings.resolution.height;
                          return Ball{c.from, c.height * std::hypot(1, aspect)};
                        },
                        [](const scene::SphericalCamera& c) {
                          return Ball{c.from, 0};
                        },
                    },
                    camera);
}

}  // namespace tyndall::resolve
