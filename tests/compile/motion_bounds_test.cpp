// Boxes around what moves hold all of its way, between keys too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/overloaded.h"
#include "compile/compiled_scene.h"
#include "compile/geometry/bvh_group.h"
#include "compile/geometry/geometry.h"
#include "compile/majorant/majorant_grid.h"
#include "support/scene_text.h"

namespace tyndall::compile {
namespace UNNAMED {

// Points of the surface, some at its ends.
std::vector<Vec3d> points_of(const scene::Shape& shape) {
  std::vector<Vec3d> out;
  const auto rim = [&](const Vec3d& center, const Vec3d& normal, double radius) {
    const Vec3d n = normalize(normal), any = std::abs(n.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const Vec3d u = normalize(cross(n, any)), v = cross(n, u);
    for (int i = 0; i < 32; ++i)
      out.push_back(center + (u * std::cos(i * 0.2) + v * std::sin(i * 0.2)) * radius);
  };
  std::visit(Overloaded{[&](const scene::Sphere& s) {
                          for (const Vec3d& n : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
                            rim(s.center, n, s.radius);
                        },
                        [&](const scene::Box& b) {
                          for (int c = 0; c < 8; ++c)
                            out.push_back({c & 1 ? b.min.x : b.max.x, c & 2 ? b.min.y : b.max.y,
                                           c & 4 ? b.min.z : b.max.z});
                        },
                        [&](const scene::Disk& d) { rim(d.center, d.normal, d.radius); },
                        [&](const scene::Cylinder& c) {
                          rim(c.from, c.to - c.from, c.radius);
                          rim(c.to, c.to - c.from, c.radius);
                        },
                        [&](const scene::Cone& c) {
                          rim(c.from, c.to - c.from, c.radius);
                          rim(c.to, c.to - c.from, c.tip_radius);
                        },
                        [&](const scene::Torus& t) {
                          rim(t.center, t.normal, t.radius + t.tube);
                          const Vec3d up = normalize(t.normal) * t.tube;
                          rim(t.center + up, t.normal, t.radius);
                          rim(t.center - up, t.normal, t.radius);
                        },
                        [](const auto&) {}},
             shape);
  return out;
}

bool holds(const Bounds& b, const Vec3d& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(b.lo[axis] - 1e-9 <= p[axis] && p[axis] <= b.hi[axis] + 1e-9)) return false;
  return true;
}

const std::string open_shutter = R"(
animation { fps: 1  frames: 0..1  shutter: 180deg }
camera perspective { from: (0, 0, 50)  to: (0, 0, 0)  fov: 40deg }
)";

const char* const ways[] = {
    "rotate_z(300deg * time)", "rotate((1, 1, 0), 2000deg * time)",
    "translate((4 * time, 0, 0)) * rotate_y(700deg * time) * translate((1, 0, 0.5))",
    "rotate_x(500deg * time) * scale((1 + 2 * time, 1, -1))",
    "rotate_z(80deg * time) * scale((1, 1 + 3 * time, 1)) * rotate_z(-500deg * time)"};

TEST(MotionBounds, HoldShapesAllTheWay) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  for (const std::string way : ways)
    for (const std::string shape :
         {"sphere { center: (time, 1, 0)  radius: 1 + time  transform: way }",
          "box { min: (-1, 0, 0)  max: (1 + time, 1, 1)  transform: way }",
          "disk { center: (0, 1, 0)  normal: (4 * time - 1, 1, 0)  radius: 1  transform: way }",
          "cylinder { from: (0, 0, 0)  to: (8 * time - 2, 1, 0)  radius: 1  transform: way }",
          "cone { from: (0, 0, 0)  to: (8 * time - 2, 1, 0)  radius: 1  tip_radius: 2 * time  transform: way "
          "}",
          "torus { center: (0, 1, 0)  normal: (4 * time - 1, 1, 0)  radius: 1 + time  tube: 0.3  transform: "
          "way }"}) {
      const scene::Scene s = support::scene_of(open_shutter + fmt::format("let way = {}\n", way) + shape);
      ASSERT_EQ(s.motion.shapes.size(), 1u) << shape << way;
      const auto& moving = s.motion.shapes[0];
      const Bounds all = swept_bounds(
          moving, 0, [](const scene::ShapeInstance& at) { return *turned_bounds(at.shape, ShapeParts{}); },
          [](const scene::ShapeInstance& at) { return at.world_from_object; });
      for (int i = 0; i < 2000; ++i) {
        const scene::ShapeInstance now = scene::at(moving, uniform(random));
        for (const Vec3d& p : points_of(now.shape))
          ASSERT_TRUE(holds(all, now.world_from_object.point(p))) << shape << ' ' << way << " seed 5, " << i;
      }
    }
}

// The boxes of volumes, and the part of the medium's space that is looked into while the shape moves in it.
TEST(MotionBounds, HoldVolumesAndWhatTheyShowOfTheirMedium) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform;
  for (const std::string way : ways)
    for (const std::string text : {R"(
volume { in: box { min: (-1, 0, 0)  max: (1, 1, 1) }  medium: waves  transform: way }
)",
                                   R"(
volume { in: box { min: (-1, 0, 0)  max: (1, 1, 1)  transform: rotate_z(45deg) * way }  medium: waves }
)"}) {
      const std::string names = R"(
medium waves() { density = 1 + sin(p.x)  albedo = 0.5 }
)" + fmt::format("let way = {}\n", way);
      const CompiledScene world = compile(support::scene_of(open_shutter + names + text));
      const CompiledVolume& volume = world.volumes.at(0);
      ASSERT_NE(volume.motion, nullptr);
      const Bounds all = world.geometry->volume_bounds(volume),
                   &seen = world.grids.at(volume.grid)->domain().box;
      for (int i = 0; i < 2000; ++i) {
        const double time = uniform(random);
        const auto render_from_shape = volume.motion->shape_from_render(time).inverse();
        ASSERT_TRUE(render_from_shape.has_value());
        for (const Vec3d& p : points_of(volume.motion->shape(time).value_or(volume.shape))) {
          const Vec3d place = render_from_shape->point(p);
          ASSERT_TRUE(holds(all, place)) << text << " seed 6, " << i;
          ASSERT_TRUE(holds(seen, volume.motion->medium_from_render(time).point(place)))
              << text << " seed 6, " << i;
        }
      }
    }
}

// What rays are asked of a transform alone is what the whole thing has at that moment.
TEST(MotionBounds, OneTransformMovesAsTheThingDoes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  for (const std::string way : ways) {
    const CompiledScene world =
        compile(support::scene_of(open_shutter + fmt::format("let way = {}\n", way) + R"(
sphere { center: (time, 0, 0)  transform: way }
volume { in: box { min: (-1, 0, 0)  max: (1, 1 + time, 1) }  medium: { density = 1  albedo = 0.5 }  transform: way }
)"));
    const auto same = [&](const auto& moving, std::size_t which) {
      const scene::MovingTransform alone(moving, which);
      for (int i = 0; i < 200; ++i) {
        const double time = i == 0 ? 0 : i == 1 ? 1 : uniform(random);
        const Transform a = alone.at(time), b = scene::transforms_of(scene::at(moving, time))[which];
        ASSERT_EQ(a.x, b.x) << way;
        ASSERT_EQ(a.y, b.y) << way;
        ASSERT_EQ(a.z, b.z) << way;
        ASSERT_EQ(a.t, b.t) << way;
      }
    };
    const scene::Motion& motion = world.scene.motion;
    ASSERT_EQ(motion.shapes.size(), 1u);
    ASSERT_EQ(motion.volumes.size(), 1u);
    same(motion.shapes[0], 0);
    same(motion.volumes[0], 0);
    same(motion.volumes[0], 1);
    EXPECT_TRUE(scene::moves_within(motion.volumes[0]));
  }
}

// Rays meet a turning thing where a still one is at their time; there are enough of them for a tree.
TEST(MotionBounds, RaysMeetWhatTurnsWhereItIs) {
  const auto scene_at = [&](const std::string& now) {
    return compile(support::scene_of(open_shutter + fmt::format("let now = {}\n", now) + R"(
object bar { box { min: (-1, -0.2, -0.3)  max: (1, 0.2, 0.3) } }
let way = rotate_z(2000deg * now) * translate((2, 0, 0)) * rotate_x(40deg)
for i in 0..5 {
  box { min: (-1, -0.2, -0.3)  max: (1, 0.2, 0.3)  transform: translate((0, 0, 4 * i - 12)) * way }
  place bar { transform: translate((0, 0, 4 * i - 10)) * way }
}
)"));
  };
  const CompiledScene moving = scene_at("time");
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int hits = 0;
  for (const double fraction : {0.03, 0.21, 0.48, 0.66, 0.97}) {
    const CompiledScene still = scene_at(fmt::format("{}", 0.5 * fraction));
    for (int i = 0; i < 400; ++i) {
      const Vec3d to = Vec3d{3 * uniform(random), 3 * uniform(random), 14 * uniform(random)} - moving.origin;
      const Vec3d from =
          Vec3d{8 * uniform(random), 8 * uniform(random), 20 * uniform(random)} - moving.origin;
      const auto a = moving.closest_hit({from, normalize(to - from), 1e9, fraction}, RayKind::scattered);
      const auto b = still.closest_hit({from, normalize(to - from), 1e9, 0}, RayKind::scattered);
      ASSERT_EQ(a.has_value(), b.has_value()) << "seed 8, " << i;
      if (a) {
        EXPECT_NEAR(a->t, b->t, 1e-6);
      }
      hits += a.has_value();
    }
  }
  EXPECT_GT(hits, 200);
}

}  // namespace UNNAMED
}  // namespace tyndall::compile
