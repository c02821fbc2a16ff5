// What one operation of the VM costs: the numbers behind the table of vm/cost.cpp.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>
#include <vector>

#include "bench.h"
#include "vm/builder/builder.h"
#include "vm/run/machine.h"

namespace tyndall::vm {

namespace {

constexpr std::array<Input, 4> lane_inputs = {Input::p_x, Input::p_y, Input::p_z, Input::u};

// A chain of `length` operations, each on inputs and the value before it, so that none is dropped.
Program chain_of(Op op, int length) {
  Builder builder(false);
  std::array<NodeId, 4> operands;
  for (std::size_t k = 0; k < 4; ++k) operands[k] = builder.input(lane_inputs[k]);
  const OpInfo& info = op_info(op);
  for (int i = 0; i < length; ++i)
    operands[0] = builder.emit(op, std::span(operands).first(static_cast<std::size_t>(info.operands)), {},
                               info.has(OpTrait::octaves) ? 1 : 0);
  return *builder.finish(std::span(operands).first(1));
}

// 256 voxels a side, all different, as of a dense fog.
VoxelsPointer dense_voxels(int other) {
  constexpr int n = 256;
  VoxelsBuilder builder({n, n, n}, 0);
  builder.mark({1, 1, 1}, {n - 2, n - 2, n - 2});
  return builder.finish("dense", [other](const VoxelCoord& first, float* to) {
    for (int z = 0; z <= 8; ++z)
      for (int y = 0; y <= 8; ++y)
        for (int x = 0; x <= 8; ++x)
          *to++ = static_cast<float>(
              ((first[0] + x) * (31 + other) + (first[1] + y) * 57 + (first[2] + z) * 101) & 255);
  });
}

PlanePointer dense_plane() {
  constexpr int side = 4096;
  std::vector<float> texels;
  for (int i = 0; i < side * side; ++i) texels.push_back(static_cast<float>(i * 31 & 255));
  return make_plane("dense", side, side, std::move(texels));
}

using Columns = std::array<std::vector<float>, 3>;
constexpr std::size_t rays = 512;

// Places along rays through 256 voxels a side, four a voxel or more: what marches ask for.
Columns along_rays() {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(20, 230), way(-0.25f, 0.25f);
  Columns columns;
  for (auto& column : columns)
    for (std::size_t ray = 0; ray < rays; ++ray) {
      const float begin = place(random), step = way(random);
      for (std::size_t i = 0; i < Machine::max_lanes; ++i)
        column.push_back(std::clamp(begin + step * static_cast<float>(i), 2.0f, 253.0f));
    }
  return columns;
}
Columns anywhere() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(2, 253);
  Columns columns;
  for (auto& column : columns)
    for (std::size_t i = 0; i < rays * Machine::max_lanes; ++i) column.push_back(place(random));
  return columns;
}

// That this thread had, whatever else the machine did.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Seconds that a program takes for one lane.
double seconds_a_lane(const Program& program, const Columns& columns, double seconds_a_row) {
  constexpr std::size_t lanes = Machine::max_lanes;
  std::array<std::vector<float>, 3> out;
  std::vector<float*> outputs;
  for (std::size_t k = 0; k < program.outputs.size(); ++k) {
    out[k].resize(lanes);
    outputs.push_back(out[k].data());
  }
  Machine machine;
  std::vector<double> times;
  for (double spent = 0; spent < seconds_a_row || times.size() < 5; spent += times.back()) {
    const double begin = thread_seconds();
    for (std::size_t ray = 0; ray < rays; ++ray) {
      BatchInputs inputs;
      for (std::size_t k = 0; k < 3; ++k) inputs[lane_inputs[k]] = columns[k].data() + ray * lanes;
      machine.run(program, inputs, lanes, outputs);
    }
    times.push_back(thread_seconds() - begin);
  }
  return *std::min_element(times.begin(), times.end()) / (rays * lanes);
}

// `components`: of a value, each in voxels of its own.
Program lookup_of(Op op, std::span<const VoxelsPointer> components) {
  Builder builder;
  const std::array operands{builder.input(Input::p_x), builder.input(Input::p_y), builder.input(Input::p_z)};
  std::vector<NodeId> values;
  for (const VoxelsPointer& voxels : components)
    values.push_back(builder.emit(op, operands, {}, 0, builder.voxels(voxels)));
  return *builder.finish(values);
}

void print_lookups(std::string_view what, std::string_view where, double seconds) {
  fmt::print("{:<14} {:>7.3f}  {:.0f} M lookups a second {}\n", what, seconds * 1e9, 1e-6 / seconds, where);
}

void bench_lookups(double seconds_a_row) {
  const std::array voxels{dense_voxels(0), dense_voxels(1), dense_voxels(2)};
  const Columns coherent = along_rays(), scattered = anywhere();
  const std::span one = std::span(voxels).first(1);
  for (const Op op : {Op::voxels, Op::voxels_nearest, Op::voxels_cubic}) {
    const std::string_view name = op_info(op).name;
    const auto row = [&](std::string_view where, std::span<const VoxelsPointer> components,
                         const Columns& places) {
      print_lookups(name, where, seconds_a_lane(lookup_of(op, components), places, seconds_a_row));
    };
    row("along rays through 256^3 voxels", one, coherent);
    row("along rays through 256^3 vecs, 3 operations", voxels, coherent);
    row("anywhere in 256^3 voxels", one, scattered);
  }
  // 16 texels to a voxel of these places.
  Columns uv = coherent;
  for (auto& column : uv)
    for (float& x : column) x /= 256;
  Builder builder;
  const std::array operands{builder.input(Input::p_x), builder.input(Input::p_y)};
  const NodeId texel = builder.emit(Op::plane, operands, {}, 0, builder.plane(dense_plane()));
  const Program program = *builder.finish(std::span(&texel, 1));
  print_lookups("plane", "along lines, in 4096^2 texels", seconds_a_lane(program, uv, seconds_a_row));
}

}  // namespace

void bench_ops(double seconds_a_row) {
  constexpr std::size_t lanes = Machine::max_lanes;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> range(0.1f, 0.9f);
  std::array<std::vector<float>, 4> columns;
  BatchInputs inputs;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < lanes; ++i) columns[k].push_back(range(random));
    inputs[lane_inputs[k]] = columns[k].data();
  }
  std::vector<float> out(lanes);
  float* const output = out.data();
  Machine machine;
  const auto nanoseconds = [&](const Program& program) {
    machine.run(program, inputs, lanes, std::span(&output, 1));
    std::vector<double> times;
    for (double spent = 0; spent < seconds_a_row || times.size() < 5; spent += times.back()) {
      const auto begin = std::chrono::steady_clock::now();
      for (int i = 0; i < 20; ++i) machine.run(program, inputs, lanes, std::span(&output, 1));
      times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return *std::min_element(times.begin(), times.end()) / 20 / lanes * 1e9;
  };
  fmt::print("SIMD class {}; nanoseconds a lane in batches of {}, an octave of those that have some\n",
             simd_name(), lanes);
  for (int i = 0; i < op_count; ++i) {
    const Op op = static_cast<Op>(i);
    if (op_info(op).looks_up()) continue;  // below
    fmt::print("{:12} {:7.3f}\n", op_info(op).name,
               (nanoseconds(chain_of(op, 9)) - nanoseconds(chain_of(op, 1))) / 8);
  }
  bench_lookups(seconds_a_row);
}

}  // namespace tyndall::vm
