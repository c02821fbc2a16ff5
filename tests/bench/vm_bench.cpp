// The VM against the same shaders in scalar C++ and in hand-written Highway.
//
// The three are run alternately in one process and the medians of the ratios are printed, so that what else
// the machine does cancels out.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <vector>

#include "base/check.h"
#include "bench.h"
#include "vm/builder/builder.h"
#include "vm/run/machine.h"
#include "vm_by_hand.h"
#include "vm_shaders-inl.h"

namespace tyndall::vm {

void run_scalar(BenchShader shader, const float* x, const float* y, const float* z, float* out,
                std::size_t count) {
  const HWY_NAMESPACE::Direct<float> ops;
  switch (shader) {
    case BenchShader::cloud:
      for (std::size_t i = 0; i < count; ++i) out[i] = HWY_NAMESPACE::Cloud()(ops, x[i], y[i], z[i]);
      return;
    case BenchShader::transcendental:
      for (std::size_t i = 0; i < count; ++i) out[i] = HWY_NAMESPACE::Transcendental()(ops, x[i], y[i], z[i]);
      return;
    case BenchShader::sums:
      for (std::size_t i = 0; i < count; ++i) out[i] = HWY_NAMESPACE::Sums()(ops, x[i], y[i], z[i]);
      return;
  }
}

namespace {

// Emits a shader's operations.
struct Emitter {
  using Value = NodeId;
  Builder& builder;
  NodeId constant(float v) const { return builder.constant(v); }
  template <Op op, class... T>
  NodeId call(T... v) const {
    return builder.emit(op, {v...}, {});
  }
  template <Op op, class... T>
  NodeId octaves(int count, T... v) const {
    return builder.emit(op, {v...}, {}, static_cast<std::uint8_t>(count));
  }
};

template <class Shader>
Program program_of() {
  Builder builder;
  const NodeId result = Shader()(Emitter{builder}, builder.input(Input::p_x), builder.input(Input::p_y),
                                 builder.input(Input::p_z));
  return *builder.finish(std::span(&result, 1));
}

constexpr std::size_t points = 4096;

struct Points {
  std::vector<float> x = numbers(1), y = numbers(2), z = numbers(3);
  static std::vector<float> numbers(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> range(-1.5f, 1.5f);
    std::vector<float> v(points);
    for (float& a : v) a = range(random);
    return v;
  }
};

template <class Body>
double seconds(const Body& body) {
  const auto begin = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

// Lanes that differ from the hand-written shader, which has the same kernels and must give the same bits.
std::size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

// What is promised of a shader's rows; 0: nothing.
struct Targets {
  struct Row {
    std::size_t lanes;
    double most_to_hand, least_to_scalar;
  };
  std::vector<Row> rows;
};

// The text behind a row, and whether it keeps what is promised.
bool judge(const Targets& targets, std::size_t lanes, double to_hand, double to_scalar) {
  for (const Targets::Row& row : targets.rows) {
    if (row.lanes != lanes) continue;
    const bool good =
        (row.most_to_hand == 0 || to_hand <= row.most_to_hand) && to_scalar >= row.least_to_scalar;
    fmt::print("  {}: at most {:g} x{}", good ? "good" : "MISSED", row.most_to_hand,
               row.least_to_scalar > 0 ? fmt::format(", at least {:g} x", row.least_to_scalar) : "");
    return good;
  }
  return true;
}

template <class Shader>
bool measure(BenchShader shader, const Targets& targets, double seconds_a_row) {
  bool good = true;
  const Points p;
  const Program program = program_of<Shader>();
  Machine machine;
  std::vector<float> vm_out(points), hand_out(points), scalar_out(points);
  for (const std::size_t lanes : {8u, 16u, 32u, 64u, 128u, 256u}) {
    const auto by_vm = [&] {
      BatchInputs inputs;
      for (std::size_t begin = 0; begin < points; begin += lanes) {
        inputs[Input::p_x] = p.x.data() + begin;
        inputs[Input::p_y] = p.y.data() + begin;
        inputs[Input::p_z] = p.z.data() + begin;
        float* const out = vm_out.data() + begin;
        machine.run(program, inputs, lanes, std::span(&out, 1));
      }
    };
    const auto by_hand = [&] {
      run_by_hand(shader, p.x.data(), p.y.data(), p.z.data(), hand_out.data(), points);
    };
    const auto scalar = [&] {
      run_scalar(shader, p.x.data(), p.y.data(), p.z.data(), scalar_out.data(), points);
    };
    by_vm(), by_hand(), scalar();
    CHECK_EQ(differences(vm_out, hand_out), std::size_t{0});
    std::vector<double> to_hand, to_scalar, nanoseconds;
    for (double spent = 0; spent < seconds_a_row || to_hand.size() < 5;) {
      const double vm = seconds(by_vm), hand = seconds(by_hand), plain = seconds(scalar);
      to_hand.push_back(vm / hand);
      to_scalar.push_back(plain / vm);
      nanoseconds.push_back(vm / static_cast<double>(points) * 1e9);
      spent += vm + hand + plain;
    }
    fmt::print("{:30} {:5} lanes  {:7.2f} ns/lane  {:5.2f} x hand-written  {:6.2f} x faster than scalar",
               Shader::name, lanes, median(nanoseconds), median(to_hand), median(to_scalar));
    good &= judge(targets, lanes, median(to_hand), median(to_scalar));
    fmt::print("\n");
  }
  return good;
}

}  // namespace
}  // namespace tyndall::vm

namespace tyndall::vm {

bool bench(double seconds_a_row) {
  const Targets noise{{{16, 1.5, 0}, {64, 1.25, 3.5}, {128, 1.25, 3.5}, {256, 1.25, 3.5}}};
  const Targets transcendental{{{128, 2.0, 5}, {256, 2.0, 5}}};
  const Targets sums{{{256, 3.5, 0}}};
  fmt::print("SIMD class {}; medians of ratios taken alternately\n", simd_name());
  bool good = measure<HWY_NAMESPACE::Cloud>(BenchShader::cloud, noise, seconds_a_row);
  good &= measure<HWY_NAMESPACE::Transcendental>(BenchShader::transcendental, transcendental, seconds_a_row);
  good &= measure<HWY_NAMESPACE::Sums>(BenchShader::sums, sums, seconds_a_row);
  return good;
}

}  // namespace tyndall::vm
