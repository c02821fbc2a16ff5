// Majorant grids: sound bounds whatever ray or thread comes first, along rays without gaps, in bounded
// memory.
#include "compile/majorant/majorant_grid.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "base/numerics.h"
#include "compile/compiled_scene.h"
#include "compile/majorant/build_majorant_grids.h"
#include "compile/majorant/majorant_dda.h"
#include "compile/majorant/occupancy_walk.h"
#include "scene/motion.h"
#include "support/scene_builder.h"
#include "support/scene_text.h"
#include "vm/run/machine.h"

namespace tyndall::compile {
namespace UNNAMED {

using support::Expression;
using support::Point;
using support::SceneBuilder;

Expression fbm(const Point& p, std::uint8_t octaves) {
  return {p.x.builder, p.x.builder->emit(vm::Op::fbm3, {p.x.node, p.y.node, p.z.node}, {}, octaves)};
}
// A cloud that fills about a tenth of its box, with edges, noise and a jump.
Expression cloud(const Point& p) {
  const Expression shape = max(0.6f - length(p) + fbm({p.x * 3.f, p.y * 3.f, p.z * 3.f}, 4) * 0.5f, 0);
  return shape * 12.f * (less(p.y, 0.35f) * 0.5f + 0.5f);
}

struct Built {
  CompiledScene world;
  const MajorantGrid& grid() const { return *world.grids.at(world.volumes.at(0).grid); }
};
Built built(const support::Density& density, const Transform& placed = {},
            const scene::Shape& shape = scene::Box{{-1, -1, -1}, {1, 1, 1}}) {
  SceneBuilder builder;
  builder.image(640, 360, 1).perspective({0, 0.3, 1.2}, {0, 0, 0}, 60);
  builder.volume(shape, builder.shader({}, density), placed);
  return {compile(builder.scene)};
}

// Extinction at points of p, by the machine.
std::vector<float> extinction(const CompiledScene& world, const std::vector<Vec3d>& points) {
  const vm::Program& program = world.scene.media[0].extinction;
  std::array<std::vector<float>, 3> p;
  for (const Vec3d& point : points)
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis].push_back(static_cast<float>(point[axis]));
  vm::BatchInputs inputs;
  for (std::size_t axis = 0; axis < 3; ++axis) inputs[static_cast<vm::Input>(axis)] = p[axis].data();
  std::vector<std::vector<float>> rows(program.outputs.size(), std::vector<float>(points.size()));
  std::vector<float*> outputs;
  for (auto& row : rows) outputs.push_back(row.data());
  vm::Machine machine;
  machine.run(program, inputs, points.size(), outputs);
  return rows[0];
}

// Artists shape densities by powers: 0 stays 0.
TEST(MajorantGrids, APowerOfNothingIsProvedEmpty) {
  const Built b = built([](const Point& p) {
    vm::Builder& builder = *p.x.builder;
    const Expression ball = max(0.5f - length(p), 0);
    return Expression{&builder, builder.emit(vm::Op::pow, {ball.node, builder.constant(1.5f)}, {})};
  });
  BoundsScratch scratch;
  EXPECT_EQ(b.grid().at({0.9, 0.9, 0.9}, scratch).kind, CellKind::empty);
  const CellBounds middle = b.grid().at({0, 0, 0}, scratch);
  EXPECT_GT(middle.minorant, 0.2f);
  EXPECT_NEAR(middle.majorant, std::pow(0.5f, 1.5f), 1e-3f);
}

// And by mixes: nothing mixed with nothing is nothing, in whatever shares.
TEST(MajorantGrids, AMixOfNothingIsProvedEmpty) {
  const Built b = built([](const Point& p) {
    vm::Builder& builder = *p.x.builder;
    const Expression ball = max(0.5f - length(p), 0), eroded = ball * exp(p.x);
    return Expression{&builder, builder.emit(vm::Op::mix, {ball.node, eroded.node, (p.y * 3.f).node}, {})};
  });
  BoundsScratch scratch;
  EXPECT_EQ(b.grid().at({0.9, 0.9, 0.9}, scratch).kind, CellKind::empty);
  const CellBounds middle = b.grid().at({0, 0, 0}, scratch);
  EXPECT_EQ(middle.kind, CellKind::varying);
  EXPECT_LE(middle.minorant, 0.5f);
  EXPECT_GE(middle.majorant, 0.5f);
}

TEST(MajorantGrids, HoldAtEveryPoint) {
  const Built b = built(cloud);
  BoundsScratch scratch;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3d> points;
  for (int i = 0; i < 200000; ++i) points.push_back({uniform(random), uniform(random), uniform(random)});
  const std::vector<float> sigma = extinction(b.world, points);
  std::size_t zero = 0, proved = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CellBounds cell = b.grid().at(points[i], scratch);
    ASSERT_LE(cell.minorant, sigma[i]) << i;
    ASSERT_GE(cell.majorant, sigma[i]) << i;
    ASSERT_TRUE(cell.kind != CellKind::empty || sigma[i] == 0) << i;
    zero += sigma[i] == 0;
    proved += cell.kind == CellKind::empty;
  }
  EXPECT_GT(static_cast<double>(proved), 0.8 * static_cast<double>(zero));
}

// Rays through, beside and along the cells of a volume that is turned, squeezed and mirrored, with their
// stays.
template <class Visit>
void for_rays(const Built& b, Visit&& visit) {
  const CompiledVolume& volume = b.world.volumes[0];
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    const Vec3d towards = volume.render_from_shape.point({uniform(random), uniform(random), uniform(random)});
    const Vec3d from =
        i % 3 == 0 ? towards : Vec3d{3 * uniform(random), 3 * uniform(random), 3 * uniform(random)};
    Vec3d direction = i % 7 == 0 ? Vec3d{0, 0, 1} : towards - from;
    if (i % 3 == 0) direction = {uniform(random), uniform(random), i % 5 == 0 ? 0 : uniform(random)};
    const Ray ray = {from, normalize(direction), i % 4 == 0 ? 2.5 : infinity};
    std::vector<VolumeInterval> intervals_inside;
    b.world.volume_intervals(ray, RayKind::scattered, intervals_inside);
    for (const VolumeInterval& stay : intervals_inside) visit(ray, stay);
  }
}
const Transform awry = Transform::translate({0.2, -0.1, 0}) * Transform::rotate({1, 2, 0}, 0.7) *
                       Transform::scale({1.5, 0.4, -0.8});

TEST(MajorantGrids, WalksCoverTheRayWithoutGapsAndHoldOnIt) {
  const Built b = built(cloud, awry);
  const CompiledVolume& volume = b.world.volumes[0];
  BoundsScratch scratch;
  std::size_t walked = 0;
  for_rays(b, [&](const Ray& ray, const VolumeInterval& stay) {
    MajorantDda walk(b.grid(), volume.medium_from_render, ray, stay.t0, stay.t1, scratch);
    MajorantSegment s;
    double t = stay.t0;
    std::vector<Vec3d> points;
    std::vector<CellBounds> cells;
    while (walk.next(s)) {
      ASSERT_EQ(s.t0, t);
      ASSERT_LT(s.t0, s.t1);
      t = s.t1;
      for (const double part : {0.0, 0.31, 0.77, 1.0}) {
        points.push_back(
            volume.medium_from_render.point(ray.origin + ray.direction * (s.t0 + part * (s.t1 - s.t0))));
        cells.push_back(s.bounds);
      }
    }
    ASSERT_EQ(t, stay.t1);
    const std::vector<float> sigma = extinction(b.world, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      ASSERT_LE(cells[k].minorant, sigma[k]) << k;
      ASSERT_GE(cells[k].majorant, sigma[k]) << k;
    }
    walked += points.size();
  });
  EXPECT_GT(walked, 20000u);
}

// A ball of one density in a cloud: all kinds. At steps below and far above a cell's size.
TEST(MajorantGrids, WalksOverKindsSkipOnlyWhatIsEmpty) {
  const Built b = built(
      [](const Point& p) {
        const Expression near = less(length(Point{p.x - 0.4f, p.y, p.z}), 0.3f);
        return near * 2.f + (1.f - near) * cloud(p);
      },
      awry);
  const CompiledVolume& volume = b.world.volumes[0];
  BoundsScratch scratch;
  OccupancyWalk kinds;
  std::array<double, 3> length{};
  for (const double step : {1e-6, 0.05, 0.3, 100.0})
    for_rays(b, [&](const Ray& ray, const VolumeInterval& stay) {
      double t = stay.t0;
      for (const OccupancySegment& s :
           kinds.along(b.grid(), volume.medium_from_render, ray, stay.t0, stay.t1, step, scratch)) {
        ASSERT_EQ(s.t0, t);
        ASSERT_LT(s.t0, s.t1);
        t = s.t1;
        if (step == 1e-6) length[static_cast<std::size_t>(s.kind)] += s.t1 - s.t0;
        if (s.kind == CellKind::varying) continue;
        std::vector<Vec3d> points;
        for (const double part : {0.0, 0.31, 0.77, 1.0})
          points.push_back(
              volume.medium_from_render.point(ray.origin + ray.direction * (s.t0 + part * (s.t1 - s.t0))));
        for (const float sigma : extinction(b.world, points))
          ASSERT_EQ(sigma, s.kind == CellKind::empty ? 0 : 2);
      }
      ASSERT_EQ(t, stay.t1);
    });
  for (const double kind : length) EXPECT_GT(kind, 20);
}

// The kinds along a ray in the medium's space, neighbours of one kind joined, without what is shorter than
// rounding.
std::vector<OccupancySegment> joined(const std::vector<OccupancySegment>& all, double rounding) {
  std::vector<OccupancySegment> out;
  for (const OccupancySegment& s : all) {
    if (s.t1 - s.t0 <= rounding) continue;
    if (!out.empty() && out.back().kind == s.kind)
      out.back().t1 = s.t1;
    else
      out.push_back(s);
  }
  return out;
}
void expect_occupancy_of_dda(const MajorantGrid& grid, const Ray& ray, double t1, double rounding,
                             const std::string& what) {
  BoundsScratch scratch;
  MajorantDda walk(grid, Transform(), ray, 0, t1, scratch);
  std::vector<OccupancySegment> one_by_one;
  for (MajorantSegment s; walk.next(s);) one_by_one.push_back({s.t0, s.t1, s.bounds.kind});
  OccupancyWalk kinds;
  const auto found = kinds.along(grid, Transform(), ray, 0, t1, 1e-6, scratch);
  const auto a = joined(one_by_one, rounding / 2), b = joined({found.begin(), found.end()}, rounding / 2);
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].kind, b[i].kind) << what << ", segment " << i;
    EXPECT_NEAR(a[i].t0, b[i].t0, rounding) << what << ", segment " << i;
    EXPECT_NEAR(a[i].t1, b[i].t1, rounding) << what << ", segment " << i;
  }
}

// Rays through corners and edges of cells cross several planes in one place.
TEST(MajorantGrids, WalksOverKindsGoThroughCornersAsCellByCell) {
  const Built b =
      built([](const Point& p) { return max(0.6f - length(p), 0) + less(p.x + p.y, -0.7f) * 3.f; });
  const MajorantGrid grid(b.world.scene.media[0], {{Vec3d(-1), Vec3d(1)}, {}, {0, 0}, 1u << 15});
  const double cell = grid.cell_size().x;
  for (int dx = -2; dx <= 2; ++dx)
    for (int dy = -2; dy <= 2; ++dy)
      for (int dz = -2; dz <= 2; ++dz) {
        if (dx == 0 && dy == 0 && dz == 0) continue;
        for (const double off : {0.0, 0.5, 1.0 / 3}) {
          const Vec3d d = normalize(Vec3d(dx, dy, dz));
          const Vec3d through = Vec3d(cell * (2 + off), cell * (1 + off), cell * off);
          const Ray ray{through - d * 0.9, d, infinity};
          expect_occupancy_of_dda(grid, ray, 1.8, 3.6e-6, fmt::format("{} {} {} + {}", dx, dy, dz, off));
        }
      }
}

// A corridor of thousands of cells, whose far end floats would miss.
TEST(MajorantGrids, WalksOverKindsHoldAlongAThousandCells) {
  const Built b = built([](const Point& p) { return less(fract(p.x * 0.5f), 0.25f) * 3.f; }, {},
                        scene::Box{{0, -1, -1}, {1000, 1, 1}});
  const MajorantGrid grid(b.world.scene.media[0], {{{0, -1, -1}, {1000, 1, 1}}, {}, {0, 0}, max_grid_cells});
  EXPECT_GT(grid.groups(0)[0], 2000u);
  // Cells are bounded with 1e-4 of their size around them.
  const double rounding = 0.5e-4 * grid.cell_size().x;
  for (const Vec3d& d : {Vec3d(1, 0, 0), Vec3d(1, 0.0017, -0.0009), Vec3d(-1, 0.0013, 0.0019)}) {
    const Ray ray{{d.x > 0 ? 0.0 : 1000.0, -0.95, -0.05}, normalize(d), infinity};
    expect_occupancy_of_dda(grid, ray, 999, rounding, fmt::format("{} {}", d.x, d.y));
  }
}

TEST(MajorantGrids, DoNotDependOnWhoComesFirst) {
  const Built one = built(cloud), other = built(cloud);
  const auto visit = [](const MajorantGrid& grid, std::uint32_t first, std::uint32_t step) {
    BoundsScratch scratch;
    const std::uint32_t count = grid.brick_count();
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t i = (first + k * step) % count;
      grid.brick(i % grid.bricks()[0], i / grid.bricks()[0] % grid.bricks()[1],
                 i / (grid.bricks()[0] * grid.bricks()[1]), scratch);
    }
  };
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] { visit(other.grid(), t * 91, 1 + 2 * t); });
  visit(one.grid(), 0, 1);
  for (std::thread& t : threads) t.join();
  BoundsScratch scratch;
  for (std::uint32_t i = 0; i < one.grid().brick_count(); ++i) {
    const auto& bricks = one.grid().bricks();
    const std::uint32_t x = i % bricks[0], y = i / bricks[0] % bricks[1], z = i / (bricks[0] * bricks[1]);
    const MajorantGrid::Brick &a = one.grid().brick(x, y, z, scratch),
                              &b = other.grid().brick(x, y, z, scratch);
    for (std::uint32_t c = 0; c < MajorantGrid::brick_cells; ++c) {
      ASSERT_EQ(a.cell(c).majorant, b.cell(c).majorant);
      ASSERT_EQ(a.cell(c).minorant, b.cell(c).minorant);
      ASSERT_EQ(a.cell(c).kind, b.cell(c).kind);
    }
  }
}

TEST(MajorantGrids, FindWhatIsUniformAndWhatIsEmpty) {
  const Built b = built([](const Point& p) { return less(p.x, 0) * 3.f; });
  BoundsScratch scratch;
  EXPECT_EQ(b.grid().at({0.5, 0, 0}, scratch).kind, CellKind::empty);
  const CellBounds inside = b.grid().at({-0.5, 0, 0}, scratch);
  EXPECT_EQ(inside.kind, CellKind::uniform);
  EXPECT_EQ(inside.minorant, 3);
  EXPECT_EQ(inside.majorant, 3);
  // A negative density is a mistake that the march reports: nothing is skipped.
  const Built negative = built([](const Point& p) { return p.x - 5.f; });
  EXPECT_EQ(negative.grid().at({0.5, 0, 0}, scratch).kind, CellKind::varying);
  EXPECT_EQ(negative.grid().at({0.5, 0, 0}, scratch).majorant, 0);
}

TEST(MajorantGrids, BoundWhatReadsTheWorldInTheWorld) {
  SceneBuilder builder;
  builder.image(640, 360, 1).perspective({0, 0, 4}, {0, 0, 0}, 60);
  vm::Builder shader(false);
  const Expression x{&shader, shader.input(vm::Input::P_x)};
  scene::Medium medium;
  const vm::NodeId output = (max(x, 0) * 2.f).node;
  medium.full = *shader.finish(std::span(&output, 1));
  medium.extinction = medium.full;
  medium.output_spans.resize(1);
  medium.phase = {support::isotropic()};
  builder.scene.media.push_back(medium);
  const Transform turned = Transform::translate({0.5, 0, 0}) * Transform::rotate({0, 0, 1}, pi / 2);
  builder.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, scene::MediumId(std::size_t{0}), turned);
  const CompiledScene world = compile(builder.scene);
  const MajorantGrid& grid = *world.grids[0];
  BoundsScratch scratch;
  const Vec3d p = {0.2, -0.7, 0.1};
  const double sigma = 2 * turned.point(p).x;
  const CellBounds cell = grid.at(p, scratch);
  EXPECT_LE(cell.minorant, sigma);
  EXPECT_GE(cell.majorant, sigma);
  EXPECT_LT(cell.majorant - cell.minorant, 0.2);
  EXPECT_EQ(grid.at({0, 0.9, 0}, scratch).kind, CellKind::empty);
}

TEST(MajorantGrids, AreSharedByEqualVolumesAndBoundedInMemory) {
  SceneBuilder builder;
  builder.perspective({0, 0, 30}, {0, 0, 0}, 60);
  const scene::MediumId medium = builder.shader({}, cloud);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-9, 9);
  for (int i = 0; i < 300; ++i)
    builder.volume(scene::Sphere{{}, 1}, medium,
                   Transform::translate({uniform(random), uniform(random), uniform(random)}) *
                       Transform::rotate({uniform(random), 1, 0}, uniform(random)));
  EXPECT_EQ(compile(builder.scene).grids.size(), 1u);

  for (int i = 0; i < 300; ++i)
    builder.volume(scene::Box{{-1, -1, -1}, {1, 1, 1 + 0.1 * i}}, medium, Transform::translate({0, 0, 28}));
  const CompiledScene world = compile(builder.scene);
  EXPECT_EQ(world.grids.size(), 300u);  // the first box is the spheres'
  std::size_t bytes = 0;
  for (const auto& grid : world.grids) {
    const std::size_t one =
        std::size_t{grid->brick_count()} * (sizeof(MajorantGrid::Brick::Cells) + 64 + 512 + 64 + 8 + 1);
    EXPECT_LE(one, std::size_t{4} << 20);
    bytes += one;
  }
  EXPECT_LE(bytes, std::size_t{256} << 20);
}

TEST(MajorantGrids, AreNotMadeForWhatDoesNotVary) {
  SceneBuilder builder;
  builder.volume(scene::Sphere{{}, 1}, builder.constant({}));
  EXPECT_TRUE(compile(builder.scene).grids.empty());
}

// A blob that crosses its box while the shutter is open: by its own shader, and by reading P in a volume that
// moves. Each part of the shutter has a grid, which holds then, and proves what no grid of all that time can.
TEST(MajorantGrids, PartsOfTheShutterHaveGridsOfTheirOwn) {
  const std::string settings =
      "animation { fps: 1  frames: 0..0  shutter: 360deg }\nrender { resolution: (64, 64) }\n"
      "camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 40deg }\n";
  for (const std::string volume : {R"(
volume {
  in: box { min: (-2, -1, -1)  max: (2, 1, 1) }
  medium: { density = 5 * max(0, 0.5 - length(p - (4 * time - 2, 0, 0)))  albedo = 0.5 }
}
)",
                                   R"(
volume {
  transform: translate((2 * time, 0, 0))
  in: box { min: (-2, -1, -1)  max: (2, 1, 1) }
  medium: { density = 5 * max(0, 0.5 - length(P))  albedo = 0.5 }
}
)"}) {
    const CompiledScene world = compile(support::scene_of(settings + volume));
    const CompiledVolume& v = world.volumes.at(0);
    ASSERT_GE(v.time_slabs, 4u);
    ASSERT_EQ(world.grids.size(), v.time_slabs);
    MajorantGrid::Domain all_the_time = world.grids[0]->domain();
    all_the_time.time.hi = world.grids.back()->domain().time.hi;
    if (v.motion) {
      all_the_time.world_from_medium.clear();
      for (const scene::Volume& key : v.motion->keys().keys)
        all_the_time.world_from_medium.push_back(key.world_from_medium);
    }
    const MajorantGrid whole(world.scene.media[0], all_the_time);

    const vm::Program& program = world.scene.media[0].extinction;
    BoundsScratch scratch;
    vm::Machine machine;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int zero = 0, proved = 0, proved_of_whole = 0;
    constexpr int points = 50000;
    for (int i = 0; i < points; ++i) {
      const double fraction = i % 100 == 0 ? (i / 100 % 9) / 8.0 : 0.5 + 0.5 * uniform(random);
      const Vec3d p{2 * uniform(random), uniform(random), uniform(random)};
      const Vec3d in_world = v.motion ? scene::at(v.motion->keys(), fraction).world_from_medium.point(p) : p;
      const float seconds = world.seconds_at(fraction);
      std::array<float, 3> medium_place, world_place;
      vm::BatchInputs inputs;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        medium_place[axis] = static_cast<float>(p[axis]);
        world_place[axis] = static_cast<float>(in_world[axis]);
        inputs.lanes[static_cast<std::size_t>(vm::Input::p_x) + axis] = &medium_place[axis];
        inputs.lanes[static_cast<std::size_t>(vm::Input::P_x) + axis] = &world_place[axis];
      }
      inputs[vm::Input::time] = &seconds;
      std::vector<float> values(program.outputs.size());
      std::vector<float*> outputs;
      for (float& value : values) outputs.push_back(&value);
      machine.run(program, inputs, 1, outputs);
      const float sigma = values[world.scene.media[0].extinction_sigma_t[0]];
      const CellBounds cell = world.grids[v.grid_at(fraction)]->at(p, scratch);
      ASSERT_LE(cell.minorant, sigma) << i;
      ASSERT_GE(cell.majorant, sigma) << i;
      ASSERT_TRUE(cell.kind != CellKind::empty || sigma == 0) << i;
      zero += sigma == 0;
      proved += cell.kind == CellKind::empty;
      proved_of_whole += whole.at(p, scratch).kind == CellKind::empty;
    }
    EXPECT_GT(proved, 0.9 * zero) << volume;
    EXPECT_GT(points - proved_of_whole, 1.5 * (points - proved)) << volume;
  }
}

// A still medium has one grid however long the shutter is open.
TEST(MajorantGrids, WhatStaysTheSameHasOneGrid) {
  const CompiledScene world = compile(support::scene_of(
      R"(
animation { fps: 1  frames: 0..0  shutter: 360deg }
render { resolution: (64, 64) }
camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 40deg }
sphere { center: (5 * time, 0, 0)  radius: 0.1 }
volume {
  transform: translate((2 * time, 0, 0))
  in: sphere {}
  medium: { density = max(0, p.x)  albedo = 0.5 }
}
)"));
  EXPECT_EQ(world.grids.size(), 1u);
}

}  // namespace UNNAMED
}  // namespace tyndall::compile
