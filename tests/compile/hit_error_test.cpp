// Rays that leave a surface do not meet it where it is convex: all shapes, from beads to planets, placed in
// many ways; and the offsets that see to it are small beside what they leave.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "base/numerics.h"
#include "compile/compiled_scene.h"
#include "support/shape_cases.h"

namespace tyndall::compile {
namespace UNNAMED {

using Add = std::function<void(scene::Scene&, const scene::Shape&)>;

struct NamedShape {
  std::string name;
  bool closed;
  // Points of it, in its sizes from its centre: what lies between them is in it too.
  std::vector<Vec3d> points;
  // Of about this size about this centre.
  std::function<scene::Shape(scene::Scene&, double size, const Vec3d& center)> make;
  // Where what leaves it outwards is off it for good; everywhere, but on a torus.
  std::function<bool(const SurfaceHit&)> convex = [](const SurfaceHit&) { return true; };
};

scene::Shape mesh(scene::Scene& s, std::vector<Vec3d> points,
                  std::vector<std::array<std::uint32_t, 3>> triangles) {
  s.meshes.push_back(scene::TriangleMesh{std::move(points), std::move(triangles), {}, {}});
  return scene::Mesh{scene::MeshId(s.meshes.size() - 1)};
}

std::vector<NamedShape> shapes() {
  return {
      {"sphere",
       true,
       {{0.9, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0.2}, {0, 0, -0.9}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Sphere{c, r};
       }},
      {"box",
       true,
       {{0.9, -0.5, 0}, {-0.9, 0.4, 0.6}, {0, 0.4, -0.2}, {0.8, 0.4, 0.6}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Box{c - Vec3d(r, 0.6 * r, 0.3 * r), c + Vec3d(r, 0.5 * r, 0.7 * r)};
       }},
      {"cylinder",
       true,
       {{0.5, 0, 0}, {-0.5, 0.9, 0}, {0, 0.9, 0.5}, {0, 0.1, -0.5}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Cylinder{c, c + Vec3d(0, r, 0), 0.6 * r};
       }},
      {"slanted cylinder",
       true,
       {{0, 0, 0}, {0.5, 1, -0.7}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Cylinder{c, c + Vec3d(0.5 * r, r, -0.7 * r), 0.1 * r};
       }},
      {"cone",
       true,
       {{0.4, 0, 0}, {-0.4, 0, 0.3}, {0, 0.9, 0}, {0, 0.1, -0.5}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Cone{c, c + Vec3d(0, r, 0), 0.6 * r};
       }},
      {"slanted part of a cone",
       true,
       {{0, 0, 0}, {0.5, 1, -0.7}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Cone{c, c + Vec3d(0.5 * r, r, -0.7 * r), 0.1 * r, 0.3 * r};
       }},
      {"torus",
       true,
       {{0.6, 0, 0.2}, {0.7, 0.2, 0}, {0.6, -0.2, 0.1}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Torus{c, {0, 1, 0}, 0.7 * r, 0.28 * r};
       },
       // Its outer half.
       [](const SurfaceHit& hit) { return std::abs(hit.uv.y - 0.5) < 0.24; }},
      {"turned box in a ball",
       true,
       {{0.5, 0, 0.1}, {-0.4, 0.3, 0}, {0, -0.4, -0.4}},
       [](scene::Scene&, double r, const Vec3d& c) {
         const scene::Box box{Vec3d(-0.8 * r), Vec3d(0.7 * r)};
         return support::combined<scene::Intersection>(
             {{scene::Sphere{c, r}, {}},
              {box, Transform::translate(c) * Transform::rotate({1, 2, -1}, 0.7)}});
       }},
      {"plane",
       false,
       {{-2, 0.6, 0}, {4, -0.6, 0}, {1.15, 0.36, 1.3}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Plane{c + Vec3d(r, 0, 0), {0.2, 1, -0.3}};
       }},
      {"quad",
       false,
       {{1, 0.1, 0}, {-1, -0.1, 0}, {0.2, 0, 1}, {-0.2, 0, -1}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Quad{c, Vec3d(r, 0.1 * r, 0), Vec3d(0.2 * r, 0, r)};
       }},
      {"disk",
       false,
       {{0.9, -0.09, 0}, {-0.8, 0.08, 0}, {0, -0.3, 0.75}},
       [](scene::Scene&, double r, const Vec3d& c) {
         return scene::Disk{c, {0.1, 1, 0.4}, r};
       }},
      {"flat mesh",
       false,
       {{0.9, 0, 0.9}, {-0.9, 0, 0.8}, {0.1, 0, -0.9}},
       [](scene::Scene& s, double r, const Vec3d& c) {
         return mesh(s, {c + Vec3d(-r, 0, -r), c + Vec3d(r, 0, -r), c + Vec3d(r, 0, r), c + Vec3d(-r, 0, r)},
                     {{2, 1, 0}, {3, 2, 0}});
       }},
      {"tetrahedron",
       true,
       {{-1, -1, -1}, {1, -1, -1}, {0, -1, 1}, {0, 1, 0}},
       [](scene::Scene& s, double r, const Vec3d& c) {
         return mesh(s,
                     {c + Vec3d(-r, -r, -r), c + Vec3d(r, -r, -r), c + Vec3d(0, -r, r), c + Vec3d(0, r, 0)},
                     {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
       }},
      {"sliver",
       false,
       {{0, 0, 0}, {1, 0.3, 0.1}, {0.9, 0.3, 0.1001}},
       [](scene::Scene& s, double r, const Vec3d& c) {
         return mesh(s, {c, c + Vec3d(r, 0.3 * r, 0.1 * r), c + Vec3d(0.9 * r, 0.3 * r, 0.1001 * r)},
                     {{0, 1, 2}});
       }},
      {"curve",
       false,
       {{0, 0, 0}, {1, 0.5, 0}},
       [](scene::Scene& s, double r, const Vec3d& c) {
         s.strand_sets.push_back({{c, c + Vec3d(r, 0.5 * r, 0)}, {0.2 * r, 0.2 * r}, {0, 2}});
         return scene::Curves{scene::StrandSetId(s.strand_sets.size() - 1)};
       }},
  };
}

scene::ShapeInstance placed(const scene::Shape& shape, const Transform& transform) {
  scene::ShapeInstance s;
  s.shape = shape;
  s.world_from_object = transform;
  s.material = scene::MaterialId(std::size_t{0});
  return s;
}

struct Placement {
  std::string name;
  std::function<Transform(double size)> transform;
  bool in_object = false, moves = false;
};

const Transform turned = Transform::rotate({1, 2, -1}, 0.7);

std::vector<Placement> placements() {
  return {
      {"as it is", [](double) { return Transform{}; }},
      {"moved and turned",
       [](double s) {
         return Transform::translate({3 * s, -2 * s, s}) * turned;
       }},
      {"stretched",
       [](double s) {
         return Transform::translate({s, 0, 0}) * turned * Transform::scale({1, 0.05, -4}) *
                Transform::rotate({0, 1, 1}, 1.1);
       }},
      {"far away",
       [](double s) {
         return Transform::translate({1e3 * s, 1e3 * s, 0}) * turned;
       }},
      {"in an object",
       [](double s) {
         return Transform::translate({s, s, 0}) * turned;
       },
       true},
      {"moving",
       [](double s) {
         return Transform::translate({s, s, 0}) * turned;
       },
       false, true},
  };
}

// Three times the same thing in objects: within one another.
void place(scene::Scene& s, const scene::ShapeInstance& thing, const Placement& how, double size) {
  const Transform transform = how.transform(size);
  if (how.in_object) {
    scene::Prototype inner, outer;
    inner.shapes.push_back(thing);
    outer.instances.push_back({scene::PrototypeId(std::size_t{0}), transform, {}, true, {}});
    s.prototypes = {inner, outer};
    s.instances.push_back(
        {scene::PrototypeId(std::size_t{1}), transform * Transform::scale(Vec3d(0.3)), {}, true, {}});
    return;
  }
  scene::ShapeInstance first = thing, last = thing;
  first.world_from_object = transform;
  last.world_from_object = Transform::translate({size, 0, 0.3 * size}) * transform;
  s.shapes.push_back(first);
  if (!how.moves) return;
  s.animation.shutter.closes.radians = pi;
  s.motion.shapes.push_back({0, {first, last}, {0, 1}, {}});
}

class Random {
 public:
  double operator()() { return uniform_(bits_); }
  Vec3d direction() {
    for (;;) {
      const Vec3d v{(*this)(), (*this)(), (*this)()};
      if (length(v) < 1 && length(v) > 0.01) return normalize(v);
    }
  }
  // About a normal, down to angles of a billionth above the horizon.
  Vec3d leaving(const Vec3d& normal) {
    const Frame<double> frame = Frame<double>::around(normal);
    const double angle = pi * (*this)(), z = std::pow(10.0, -4.5 * ((*this)() + 1));
    const double r = std::sqrt(1 - z * z);
    return frame.world({r * std::cos(angle), r * std::sin(angle), z});
  }

 private:
  std::mt19937_64 bits_{5};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

Transform world_from_thing(const scene::Scene& s, double fraction) {
  if (!s.instances.empty())
    return s.instances[0].world_from_object * s.prototypes[1].instances[0].world_from_object;
  return s.motion.shapes.empty() ? s.shapes[0].world_from_object
                                 : scene::at(s.motion.shapes[0], fraction).world_from_object;
}

struct Counts {
  int rays = 0, met_again = 0, not_left = 0, large_offsets = 0;
};

void leave(const CompiledScene& world, const SurfaceHit& hit, const Vec3d& arriving, const NamedShape& shape,
           double size, Random& random, Counts& counts) {
  const bool closed = shape.closed;
  const Vec3d normal = dot(hit.normal, arriving) > 0 ? -hit.normal : hit.normal;
  const double scale = size + length(hit.position) + length(world.origin);
  counts.large_offsets += !(hit.offset_before <= 1e-12 * scale && hit.offset_before > 0);
  for (int k = 0; k < 4; ++k) {
    ++counts.rays;
    const bool outside = !closed || dot(hit.normal, normal) > 0;
    const Vec3d before = hit.position + normal * hit.offset_before;
    const Vec3d behind = hit.position - normal * hit.offset_behind;
    const Vec3d out = random.leaving(normal);
    if (outside && shape.convex(hit)) counts.met_again += world.occluded({before, out, infinity, hit.time});
    if (!closed) counts.met_again += world.occluded({behind, -out, infinity, hit.time});
    if (!closed || !outside) continue;
    // Into the body: it is left once.
    const Ray in{behind, normalize(-normal + random.direction() * 0.5), infinity, hit.time};
    const auto exit = world.closest_hit(in, RayKind::scattered);
    counts.not_left += !exit || dot(exit->normal, in.direction) < 0;
  }
}

Counts count(const NamedShape& shape, const Placement& placement, double size) {
  scene::Scene s;
  add_diffuse(s, Rgb(0.5f));
  const Vec3d center = shape.name == "sphere" ? Vec3d(0, -size, 0) : Vec3d(0.3 * size, 0, 0);
  place(s, placed(shape.make(s, size, center), {}), placement, size);
  Random random;
  Counts counts;
  const double time = placement.moves ? 0.37 : 0;
  const auto target = [&] {
    Vec3d sum;
    double weights = 0;
    for (const Vec3d& p : shape.points) {
      const double weight = random() + 1;
      sum += p * weight;
      weights += weight;
    }
    return world_from_thing(s, time).point(center + sum * (size / weights));
  };
  // Seen from afar, from as far as its size, and from its very skin.
  for (const double distance : {1e4, 2.0, 1e-3}) {
    s.camera = scene::PerspectiveCamera{{}, target() + random.direction() * (distance * size), {}};
    const CompiledScene world = compile(s);
    for (int i = 0; i < 40; ++i) {
      const Vec3d to = target() - world.origin;
      const Vec3d from = distance > 1 ? Vec3d() : to + random.direction() * (distance * size);
      const auto hit = world.closest_hit({from, normalize(to - from), infinity, time}, RayKind::scattered);
      if (hit) leave(world, *hit, normalize(to - from), shape, size, random, counts);
    }
  }
  return counts;
}

TEST(HitError, RaysThatLeaveAConvexShapeDoNotMeetItAgain) {
  for (const NamedShape& shape : shapes())
    for (const Placement& placement : placements())
      for (const double size : {1e-6, 1e-3, 1.0, 1e3, 6.371e6, 1e7}) {
        const Counts counts = count(shape, placement, size);
        const std::string what = fmt::format("{} of {} m, {}", shape.name, size, placement.name);
        EXPECT_EQ(counts.met_again, 0) << what << " of " << counts.rays;
        EXPECT_EQ(counts.not_left, 0) << what << " of " << counts.rays;
        EXPECT_EQ(counts.large_offsets, 0) << what << " of " << counts.rays;
        EXPECT_GT(counts.rays, 200) << what;
      }
}

}  // namespace UNNAMED
}  // namespace tyndall::compile
