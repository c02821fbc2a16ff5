// Boxes around what moves hold all of its way, between keys too.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/overloaded.h"
#include "compile/compiled_scene.h"
#include "compile/geometry.h"
#include "compile/group.h"
#include "compile/majorant_grid.h"
#include "support/scene_text.h"

namespace tyndall::compile {
namespace {

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
                        [](const auto&) {}},
             shape);
  return out;
}

bool holds(const Bounds& b, const Vec3d& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(b.lo[axis] - 1e-9 <= p[axis] && p[axis] <= b.hi[axis] + 1e-9)) return false;
  return true;
}

const std::string open_shutter =
    "animation { fps: 1  frames: 0..1  shutter: 180deg }\n"
    "camera perspective { from: (0, 0, 50)  to: (0, 0, 0)  fov: 40deg }\n";

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
         {"sphere { center: (time, 1, 0)  radius: 1 + time", "box { min: (-1, 0, 0)  max: (1 + time, 1, 1)",
          "disk { center: (0, 1, 0)  normal: (4 * time - 1, 1, 0)  radius: 1",
          "cylinder { from: (0, 0, 0)  to: (8 * time - 2, 1, 0)  radius: 1"}) {
      const scene::Scene s = support::scene_of(open_shutter + shape + "  transform: " + way + " }\n");
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
    for (const std::string& text :
         {"in: box { min: (-1, 0, 0)  max: (1, 1, 1) }  transform: " + way,
          "in: box { min: (-1, 0, 0)  max: (1, 1, 1)  transform: rotate_z(45deg) * " + way + " }"}) {
      const CompiledScene world = compile(support::scene_of(
          open_shutter + "volume { " + text + "  medium: { density = 1 + sin(p.x)  albedo = 0.5 } }\n"));
      const CompiledVolume& volume = world.volumes.at(0);
      ASSERT_NE(volume.motion, nullptr);
      const Bounds all = world.geometry->volume_bounds(volume),
                   &seen = world.grids.at(volume.grid)->domain().box;
      for (int i = 0; i < 2000; ++i) {
        const CompiledVolume::Place now = volume.moved(uniform(random));
        const auto render_from_shape = now.shape_from_render.inverse();
        ASSERT_TRUE(render_from_shape.has_value());
        for (const Vec3d& p : points_of(now.shape)) {
          const Vec3d place = render_from_shape->point(p);
          ASSERT_TRUE(holds(all, place)) << text << " seed 6, " << i;
          ASSERT_TRUE(holds(seen, now.medium_from_render.point(place))) << text << " seed 6, " << i;
        }
      }
    }
}

// Rays meet a turning thing where a still one is at their time; there are enough of them for a tree.
TEST(MotionBounds, RaysMeetWhatTurnsWhereItIs) {
  const std::string way = "rotate_z(2000deg * TIME) * translate((2, 0, 0)) * rotate_x(40deg)";
  const auto scene_at = [&](const std::string& time) {
    std::string transform = way;
    for (std::size_t at = transform.find("TIME"); at != std::string::npos; at = transform.find("TIME"))
      transform.replace(at, 4, time);
    std::string text = open_shutter + "object bar { box { min: (-1, -0.2, -0.3)  max: (1, 0.2, 0.3) } }\n";
    for (int i = 0; i < 12; ++i) {
      const std::string placed =
          "transform: translate((0, 0, " + std::to_string(2 * i - 12) + ")) * " + transform;
      text += i % 2 ? "place bar { " + placed + " }\n"
                    : "box { min: (-1, -0.2, -0.3)  max: (1, 0.2, 0.3)  " + placed + " }\n";
    }
    return compile(support::scene_of(text));
  };
  const CompiledScene moving = scene_at("time");
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int hits = 0;
  for (const double fraction : {0.03, 0.21, 0.48, 0.66, 0.97}) {
    const CompiledScene still = scene_at("(" + std::to_string(0.5 * fraction) + ")");
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

}  // namespace
}  // namespace tyndall::compile
