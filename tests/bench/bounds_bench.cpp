// What bounds cost and what they are worth: intervals against points, grids of a cloud, empty space skipped.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <random>
#include <vector>

#include "bench.h"
#include "compile/compiled_scene.h"
#include "compile/majorant/majorant_grid.h"
#include "render/render.h"
#include "support/scene_builder.h"
#include "vm/interval/interval.h"
#include "vm/run/machine.h"
#include "vm_shaders-inl.h"

namespace tyndall {

namespace {

using compile::MajorantGrid;
using support::Expression;
using support::Point;
using support::SceneBuilder;

// Time of this process [s]: what others do to the machine counts less.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
template <class Body>
double seconds_of(const Body& body) {
  const double begin = cpu_seconds();
  body();
  return cpu_seconds() - begin;
}
double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

struct Emitter {
  using Value = vm::NodeId;
  vm::Builder& builder;
  vm::NodeId constant(float v) const { return builder.constant(v); }
  template <vm::Op op, class... T>
  vm::NodeId call(T... v) const {
    return builder.emit(op, {v...}, {});
  }
  template <vm::Op op, class... T>
  vm::NodeId octaves(int count, T... v) const {
    return builder.emit(op, {v...}, {}, static_cast<std::uint8_t>(count));
  }
};
// The noise shader of the VM's benchmark.
Expression noise_shader(const Point& p) {
  return {p.x.builder, vm::HWY_NAMESPACE::Cloud()(Emitter{*p.x.builder}, p.x.node, p.y.node, p.z.node)};
}

// The cloud of the language's first example.
Expression round_cloud(const Point& p) {
  vm::Builder& b = *p.x.builder;
  const Point q = {p.x * 2.3f, p.y * 2.3f, p.z * 2.3f};
  const Expression billow{&b, b.emit(vm::Op::fbm3, {q.x.node, q.y.node, q.z.node}, {}, 6)};
  const Expression edge = length(p) + billow * 0.35f;
  return Expression{&b, b.emit(vm::Op::smoothstep, {b.constant(1), b.constant(0.4f), edge.node}, {})} * 20.f;
}

compile::CompiledScene world_of(const support::Density& density) {
  SceneBuilder builder;
  builder.image(640, 360, 1).perspective({0, 0, 1.1}, {0, 0, 0}, 60);
  builder.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, builder.shader({}, density));
  return compile::compile(builder.scene);
}

// The text behind a figure that has a target.
const char* verdict(bool met) { return met ? "good" : "MISSED"; }

void point_rows(const Vec3d& corner, const Vec3d& extent, std::size_t count, std::mt19937_64& random,
                std::array<std::vector<float>, 3>& rows) {
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rows[axis].resize(count);
    for (float& v : rows[axis]) v = static_cast<float>(corner[axis] + unit(random) * extent[axis]);
  }
}

// One box of a 64³ grid against one point, of the noise shader by itself.
bool bench_boxes(double seconds) {
  vm::Builder builder;
  const vm::NodeId density =
      vm::HWY_NAMESPACE::Cloud()(Emitter{builder}, builder.input(vm::Input::p_x),
                                 builder.input(vm::Input::p_y), builder.input(vm::Input::p_z));
  const vm::Program program = *builder.finish(std::span(&density, 1));
  constexpr std::size_t count = 4096;
  std::mt19937_64 random(1);
  std::array<std::vector<float>, 3> lo;
  point_rows({-1, -1, -1}, {2, 2, 2}, count, random, lo);
  std::array<std::vector<float>, 3> hi = lo;
  for (auto& row : hi)
    for (float& v : row) v += 1.0f / 32;
  vm::Machine machine;
  vm::IntervalMachine intervals;
  vm::BatchInputs points;
  vm::BoxInputs boxes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    points[static_cast<vm::Input>(axis)] = lo[axis].data();
    boxes.set(static_cast<vm::Input>(axis), lo[axis].data(), hi[axis].data());
  }
  std::vector<std::vector<float>> rows(program.outputs.size(), std::vector<float>(count));
  std::vector<float*> outputs;
  for (auto& row : rows) outputs.push_back(row.data());
  std::vector<vm::ValueBounds> bounds(count * program.outputs.size());
  std::vector<double> ratios, nanoseconds;
  for (double spent = 0; spent < seconds || ratios.size() < 5;) {
    const double a = seconds_of([&] {
      for (int i = 0; i < 8; ++i) machine.run(program, points, count, outputs);
    });
    const double b = seconds_of([&] {
      for (int i = 0; i < 8; ++i) intervals.run(program, boxes, count, bounds);
    });
    ratios.push_back(b / a);
    nanoseconds.push_back(b / (8 * count) * 1e9);
    spent += a + b;
  }
  const bool good = median(ratios) <= 2.5;
  fmt::print("one box (noise shader)                  {:6.2f} x a point, {:.0f} ns  {}: at most 2.5 x\n",
             median(ratios), median(nanoseconds), verdict(good));
  return good;
}

// A whole grid: time a cell, violations among samples, how tight, and how much of the empty space is proved.
bool bench_grid(const char* name, const support::Density& density, double seconds) {
  fmt::print("a grid of 64^3 cells: {}\n", name);
  const compile::CompiledScene world = world_of(density);
  const scene::Medium& medium = world.scene.media[0];
  compile::BoundsScratch scratch;
  std::vector<double> times;
  std::unique_ptr<MajorantGrid> grid;
  std::size_t cells = 0;
  for (double spent = 0; spent < seconds || times.empty();) {
    grid = std::make_unique<MajorantGrid>(medium, world.grids[0]->domain());
    cells = std::size_t{grid->brick_count()} * MajorantGrid::brick_cells;
    const std::uint64_t before = scratch.machine.boxes_run();
    const double one = seconds_of([&] {
      for (std::uint32_t i = 0; i < grid->brick_count(); ++i)
        grid->brick(i % grid->bricks()[0], i / grid->bricks()[0] % grid->bricks()[1],
                    i / (grid->bricks()[0] * grid->bricks()[1]), scratch);
    });
    if (times.empty())
      fmt::print("boxes run a cell of the grid            {:6.2f}\n",
                 static_cast<double>(scratch.machine.boxes_run() - before) / static_cast<double>(cells));
    times.push_back(one / static_cast<double>(cells));
    spent += one;
  }

  constexpr std::size_t samples = 125;
  vm::Machine machine;
  std::mt19937_64 random(2);
  std::array<std::vector<float>, 3> rows;
  std::vector<std::vector<float>> values(medium.extinction.outputs.size(), std::vector<float>(samples));
  std::vector<float*> outputs;
  for (auto& v : values) outputs.push_back(v.data());
  std::size_t violations = 0, empty = 0, proved = 0;
  double bound = 0, truth = 0;
  const std::array<std::uint32_t, 3>& bricks = grid->bricks();
  for (std::uint32_t z = 0; z < bricks[2] * 8; ++z)
    for (std::uint32_t y = 0; y < bricks[1] * 8; ++y)
      for (std::uint32_t x = 0; x < bricks[0] * 8; ++x) {
        const Vec3d size = grid->cell_size();
        const Vec3d corner = grid->domain().box.lo + Vec3d{x * size.x, y * size.y, z * size.z};
        point_rows(corner, size, samples, random, rows);
        vm::BatchInputs inputs;
        for (std::size_t axis = 0; axis < 3; ++axis) inputs[static_cast<vm::Input>(axis)] = rows[axis].data();
        machine.run(medium.extinction, inputs, samples, outputs);
        const float most = *std::max_element(values[0].begin(), values[0].end());
        const compile::CellBounds cell = grid->at(corner + size * 0.5, scratch);
        for (const float v : values[0]) violations += !(cell.minorant <= v && v <= cell.majorant);
        empty += most == 0;
        proved += cell.kind == compile::CellKind::empty;
        if (most > 0) bound += static_cast<double>(cell.majorant), truth += static_cast<double>(most);
      }
  const double microseconds = median(times) * 1e6, tightness = bound / truth;
  // A few cells may be thin enough for samples to miss what is in them.
  const bool has_empty_space = empty > cells / 100;
  const double share = has_empty_space ? static_cast<double>(proved) / static_cast<double>(empty) : 1.0;
  fmt::print("a cell, refined once where loose        {:6.2f} us  {}: at most 1\n", microseconds,
             verdict(microseconds <= 1));
  fmt::print("violations in {} samples          {:6}  {}: none\n", cells * samples, violations,
             verdict(violations == 0));
  fmt::print("majorant over largest sample            {:6.2f}  {}: at most 2.1\n", tightness,
             verdict(tightness <= 2.1));
  if (has_empty_space)
    fmt::print("empty cells proved                      {:6.1f} %  {}: at least 80\n", 100 * share,
               verdict(share >= 0.8));
  return microseconds <= 1 && violations == 0 && tightness <= 2.1 && share >= 0.8;
}

Expression fbm(const Point& p, float scale, float offset) {
  vm::Builder& b = *p.x.builder;
  const Point q = {p.x * scale + offset, p.y * scale, p.z * scale};
  return {&b, b.emit(vm::Op::fbm3, {q.x.node, q.y.node, q.z.node}, {}, 6)};
}
// A cloud in 5 % of its box.
Expression small_cloud(const Point& p) { return max(0.44f - length(p) + fbm(p, 2.3f, 0) * 0.2f, 0) * 40.f; }
// The same with its places moved by two more fbm.
Expression small_warped_cloud(const Point& p) {
  const Point q = {p.x + fbm(p, 3.1f, 5) * 0.05f, p.y + fbm(p, 3.1f, 9) * 0.05f, p.z};
  return small_cloud(q);
}

// Rendered with and without skipping, alternately. What the shader costs is counted in points, as each costs
// the same; the whole picture pays for rays and lights, too.
bool bench_skipping(const char* name, const support::Density& density, const Vec3d& from, double seconds) {
  SceneBuilder builder;
  builder.image(160, 90, 1).bounces(4).step(0.01).perspective(from, {0, 0, 0}, 40);
  builder.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, builder.shader({Rgb(1), Rgb(0.9f)}, density))
      .distant_light({0.3, -1, 0.2}, Rgb(3));
  const compile::CompiledScene world = compile::compile(builder.scene);
  std::vector<double> ratios;
  double lanes[2] = {}, least[2] = {1e9, 1e9};
  constexpr int samples = 8;  // a pixel, as renders take many: what a render costs once counts little
  int sample = 0;
  for (double spent = 0; spent < seconds * 4 || ratios.size() < 5;) {
    double times[2] = {};
    for (const int skip : {0, 1}) {
      render::RenderOptions options;
      options.threads = 1;
      options.skip_empty = skip == 1;
      options.sample_count = samples;
      options.first_sample = sample;
      times[skip] = seconds_of(
          [&] { lanes[skip] += static_cast<double>(render::render(world, options).statistics.lanes_used); });
    }
    sample += samples;
    for (const int skip : {0, 1}) least[skip] = std::min(least[skip], times[skip]);
    ratios.push_back(times[1] / times[0]);
    spent += times[0] + times[1];
  }
  const double points = lanes[1] / lanes[0];
  fmt::print("{:<38}  {:6.2f} x the points  {}: at most 0.3 x; {:.2f} x the picture's time\n", name, points,
             verdict(points <= 0.3), median(ratios));
  fmt::print("  at best {:.2f} and {:.2f} us a sample\n", least[1] / (160 * 90 * samples) * 1e6,
             least[0] / (160 * 90 * samples) * 1e6);
  return points <= 0.3;
}

}  // namespace

bool bench_bounds(double seconds) {
  fmt::print("SIMD class {}; medians, ratios taken alternately\n", vm::simd_name());
  bool good = bench_boxes(seconds);
  good &= bench_grid("cloud, 20 smoothstep(1, 0.4, length(p) + 0.35 fbm(2.3 p, octaves: 6))", round_cloud,
                     seconds);
  good &=
      bench_grid("the noise shader, which is empty outside of a ball and above y = 0", noise_shader, seconds);
  good &= bench_skipping("cloud in 5 % of its box, whole box", small_cloud, {0, 1.2, 5}, seconds);
  good &= bench_skipping("cloud in 5 % of its box, from near", small_cloud, {0, 0.2, 1.9}, seconds);
  good &= bench_skipping("warped, whole box", small_warped_cloud, {0, 1.2, 5}, seconds);
  good &= bench_skipping("warped, from near", small_warped_cloud, {0, 0.2, 1.9}, seconds);
  return good;
}

}  // namespace tyndall
