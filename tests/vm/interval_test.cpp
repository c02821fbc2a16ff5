// Bounds are sound: every operation and generated programs, sampled densely in boxes of all sizes.
#include "vm/interval/interval.h"

#include "random_graph.h"
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

constexpr float inf = std::numeric_limits<float>::infinity();

// Boxes at ordinary and at awkward places, from points to everything.
class RandomBoxes {
 public:
  explicit RandomBoxes(unsigned seed) : random_(seed) {}

  ValueBounds interval() {
    const float center = random_() % 4 == 0 ? awkward() : uniform(-6, 6) * (random_() % 8 == 0 ? 1e3f : 1.0f);
    switch (random_() % 6) {
      case 0:
        return ordered(center, center);
      case 1:
        return ordered(center, awkward());
      case 2:
        return ordered(std::nextafter(center, -inf), std::nextafter(center, inf));
      default: {
        const float radius = std::exp(uniform(-9, 3));
        return ordered(center - radius, center + radius);
      }
    }
  }
  // A float of the interval: an end, its neighbour, an awkward number, or any.
  float inside(const ValueBounds& b) {
    float v = b.lo;
    switch (random_() % 8) {
      case 0:
        break;
      case 1:
        v = b.hi;
        break;
      case 2:
        v = std::nextafter(b.lo, inf);
        break;
      case 3:
        v = awkward();
        break;
      case 4:
        v = std::round(mixed(b));
        break;
      default:
        v = mixed(b);
    }
    if (std::isnan(v)) v = b.hi;
    return std::clamp(v, b.lo, b.hi);
  }
  float uniform(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random_); }

 private:
  float awkward() {
    const float v = awkward_numbers()[random_() % awkward_numbers().size()];
    return std::isnan(v) ? 1.5f : v;
  }
  float mixed(const ValueBounds& b) {
    const double lo = std::max(b.lo, -3e38f), hi = std::min(b.hi, 3e38f);
    return static_cast<float>(lo + (hi - lo) * static_cast<double>(uniform(0, 1)));
  }
  static ValueBounds ordered(float a, float b) {
    // Without end: maybe NaN, as the machine has it.
    ValueBounds v{std::min(a, b), std::max(a, b), false};
    v.may_be_nan = !(v.hi - v.lo < inf);
    return v;
  }
  std::mt19937 random_;
};

TEST(Intervals, HoldWhatEveryOperationGivesInRandomBoxes) {
  for_each_simd_class([](const std::string&) {
    for (const Op op : all_ops()) {
      RandomBoxes boxes(static_cast<unsigned>(op) + 1);
      const auto operands = static_cast<std::size_t>(op_info(op).operands);
      const bool heavy = op_info(op).has(OpTrait::seed);
      for (int i = 0; i < (heavy ? 1500 : 6000); ++i) {
        std::array<ValueBounds, 4> box;
        for (ValueBounds& b : box) b = boxes.interval();
        const auto octaves = static_cast<std::uint8_t>(op_info(op).has(OpTrait::octaves) ? 1 + i % 6 : 0);
        const ValueBounds bounds = evaluate_bounds(op, std::span(box).first(operands), octaves, seed_of(op));
        ASSERT_FALSE(std::isnan(bounds.lo) || std::isnan(bounds.hi)) << op_info(op).name;
        ASSERT_TRUE(bounds.hi - bounds.lo < inf || bounds.may_be_nan) << op_info(op).name;
        for (int k = 0; k < (heavy ? 16 : 24); ++k) {
          std::array<float, 4> point{};
          for (std::size_t o = 0; o < operands; ++o)
            point[o] = k == 0 && box[o].may_be_nan ? std::nanf("") : boxes.inside(box[o]);
          const float value = evaluate_lane(op, std::span(point).first(operands), octaves, seed_of(op));
          ASSERT_TRUE(bounds.covers(value))
              << op_info(op).name << " of " << ::testing::PrintToString(point) << " is " << value
              << ", out of [" << bounds.lo << ", " << bounds.hi << "]" << (bounds.may_be_nan ? " or NaN" : "")
              << " over [" << box[0].lo << ", " << box[0].hi << "] [" << box[1].lo << ", " << box[1].hi
              << "] [" << box[2].lo << ", " << box[2].hi << "] [" << box[3].lo << ", " << box[3].hi << "]";
        }
      }
    }
  });
}

// Small boxes at ordinary places are where bounds are used: no operation may give up there.
TEST(Intervals, AreTightInSmallBoxes) {
  struct Case {
    Op op;
    std::array<ValueBounds, 4> box;
    float width;  // at most
  };
  const auto around = [](float v, float radius) { return ValueBounds{v - radius, v + radius}; };
  const auto at = [](float v) { return ValueBounds{v, v}; };
  const Case cases[] = {
      {Op::smoothstep, {at(1), at(0.4f), around(0.7f, 0.03f)}, 0.151f},  // slope 1.5 / 0.6
      {Op::mix, {at(1), at(2), around(0.5f, 0.1f)}, 0.2001f},
      {Op::clamp, {around(2, 0.5f), at(0), at(1)}, 0},
      {Op::limit, {ValueBounds{-inf, inf, true}, at(0), at(1)}, 1},
      {Op::pow, {around(0.5f, 0.1f), at(2)}, 0.2001f},
      {Op::length3, {around(1, 0.01f), around(2, 0.01f), around(2, 0.01f)}, 0.0334f},
      {Op::mul, {around(-1, 0.1f), around(2, 0.1f)}, 0.61f},
      {Op::div, {around(1, 0.1f), around(2, 0.1f)}, 0.155f},
      {Op::fract, {around(2.5f, 0.25f)}, 0.5f},
      {Op::mod, {around(7, 0.25f), at(3)}, 0.5f},
      {Op::sin, {around(0, 0.1f)}, 0.2f},
      {Op::noise3, {around(0.3f, 0.01f), around(0.6f, 0.01f), around(4.2f, 0.01f)}, 0.09f},
      {Op::fbm3, {around(0.3f, 0.01f), around(0.6f, 0.01f), around(4.2f, 0.01f)}, 0.35f},
      {Op::cells3, {around(0.3f, 0.01f), around(0.6f, 0.01f), around(4.2f, 0.01f)}, 0.07f},
      {Op::worley3_first, {around(0.3f, 0.01f), around(0.6f, 0.01f), around(4.2f, 0.01f)}, 0.036f},
      {Op::worley3_second, {around(0.3f, 0.01f), around(0.6f, 0.01f), around(4.2f, 0.01f)}, 0.036f},
      {Op::worley3_id, {around(0.3f, 0.01f), around(0.6f, 0.01f), around(4.2f, 0.01f)}, 0},
      {Op::select, {at(1), around(2, 0.5f), at(9)}, 1},
      {Op::step, {at(0.5f), around(0.7f, 0.1f)}, 0},
  };
  for (const Case& c : cases) {
    const auto operands = static_cast<std::size_t>(op_info(c.op).operands);
    const ValueBounds b =
        evaluate_bounds(c.op, std::span(c.box).first(operands), op_info(c.op).has(OpTrait::octaves) ? 5 : 0);
    EXPECT_LE(b.hi - b.lo, c.width) << op_info(c.op).name << " in [" << b.lo << ", " << b.hi << "]";
    EXPECT_FALSE(b.may_be_nan) << op_info(c.op).name;
  }
}

TEST(Intervals, KnowWhichOperationsMakeNaN) {
  const ValueBounds crossing{-1, 1}, positive{1, 2}, whole{2, 2};
  EXPECT_TRUE(evaluate_bounds(Op::sqrt, std::array{crossing}).may_be_nan);
  EXPECT_EQ(evaluate_bounds(Op::sqrt, std::array{crossing}).hi, 1);
  EXPECT_FALSE(evaluate_bounds(Op::sqrt, std::array{positive}).may_be_nan);
  EXPECT_TRUE(evaluate_bounds(Op::log, std::array{crossing}).may_be_nan);
  EXPECT_TRUE(evaluate_bounds(Op::div, std::array{crossing, crossing}).may_be_nan);
  EXPECT_FALSE(evaluate_bounds(Op::div, std::array{crossing, positive}).may_be_nan);
  EXPECT_TRUE(evaluate_bounds(Op::asin, std::array{positive}).may_be_nan);
  EXPECT_TRUE(evaluate_bounds(Op::pow, std::array{crossing, positive}).may_be_nan);
  EXPECT_FALSE(evaluate_bounds(Op::pow, std::array{crossing, whole}).may_be_nan);
  const ValueBounds maybe{0, 1, true};
  EXPECT_FALSE(evaluate_bounds(Op::less, std::array{maybe, positive}).may_be_nan);
  EXPECT_EQ(evaluate_bounds(Op::less, std::array{maybe, ValueBounds{3, 4}}).lo, 0);
  // The branch not taken may hold anything.
  EXPECT_FALSE(evaluate_bounds(Op::select, std::array{ValueBounds{1, 1}, positive, maybe}).may_be_nan);
}

// Runs a program over boxes and over points inside of them.
class BoxedProgram {
 public:
  BoxedProgram(const Program& program, std::size_t boxes, RandomBoxes& random)
      : program_(program), boxes_(boxes), bounds_(program.outputs.size() * boxes) {
    BoxInputs inputs;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < boxes; ++i) {
        box_[k].push_back(random.interval());
        lo_[k].push_back(box_[k].back().lo);
        hi_[k].push_back(box_[k].back().hi);
      }
      inputs.set(lane_inputs[k], lo_[k].data(), hi_[k].data());
    }
    time_ = {1, 1.25f};
    inputs.set(Input::time, &time_.lo, &time_.hi);
    IntervalMachine machine;
    machine.run(program, inputs, boxes, bounds_);
  }

  // The first violation among `points` points a box, in words.
  std::string violation(Machine& machine, std::size_t points, RandomBoxes& random) const {
    std::vector<std::array<float, 4>> rows;
    for (std::size_t i = 0; i < boxes_; ++i)
      for (std::size_t p = 0; p < points; ++p)
        rows.push_back({random.inside(box_[0][i]), random.inside(box_[1][i]), random.inside(box_[2][i]),
                        random.inside(box_[3][i])});
    const Lanes lanes(rows);
    BatchInputs inputs = lanes.from(0);
    const float time = random.uniform(time_.lo, time_.hi);
    inputs[Input::time] = &time;
    std::vector<std::vector<float>> results(program_.outputs.size(), std::vector<float>(rows.size()));
    std::vector<float*> pointers;
    for (auto& r : results) pointers.push_back(r.data());
    machine.run(program_, inputs, rows.size(), pointers);
    for (std::size_t k = 0; k < results.size(); ++k)
      for (std::size_t lane = 0; lane < rows.size(); ++lane) {
        const ValueBounds& b = bounds_[k * boxes_ + lane / points];
        if (!b.covers(results[k][lane]))
          return ::testing::PrintToString(results[k][lane]) + " out of " + ::testing::PrintToString(b.lo) +
                 " to " + ::testing::PrintToString(b.hi) + " at " + ::testing::PrintToString(rows[lane]) +
                 "\n" + print(program_);
      }
    return {};
  }

 private:
  const Program& program_;
  std::size_t boxes_;
  std::array<std::vector<ValueBounds>, 4> box_;
  std::array<std::vector<float>, 4> lo_, hi_;
  ValueBounds time_;
  std::vector<ValueBounds> bounds_;
};

TEST(Intervals, HoldWhatAThousandGeneratedProgramsGive) {
  Machine machine;
  std::size_t bounded = 0, values = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    Builder builder;
    const std::vector<NodeId> outputs = random_graph(builder, seed + 50000, seed % 2 == 0 ? 12 : 64);
    const Program program = *builder.finish(outputs);
    RandomBoxes random(seed);
    const BoxedProgram boxed(program, 21, random);
    ASSERT_EQ(boxed.violation(machine, 60, random), "") << "seed " << seed;
    ++values;
    bounded += program.lane_code.size() > 0;
  }
  EXPECT_GT(bounded, values / 2);
}

TEST(Intervals, ABoxDoesNotDependOnItsPlaceInTheBatch) {
  Builder builder;
  const std::vector<NodeId> outputs = random_graph(builder, 77);
  const Program program = *builder.finish(outputs);
  RandomBoxes random(5);
  const std::size_t count = 131;
  std::array<std::vector<float>, 4> lo, hi;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < count; ++i) {
      const ValueBounds b = random.interval();
      lo[k].push_back(b.lo);
      hi[k].push_back(b.hi);
    }
  const float early = 0, late = 0.5f;
  IntervalMachine machine;
  const auto run = [&](std::size_t first, std::size_t boxes) {
    BoxInputs inputs;
    for (std::size_t k = 0; k < 4; ++k)
      inputs.set(lane_inputs[k], lo[k].data() + first, hi[k].data() + first);
    inputs.set(Input::time, &early, &late);
    std::vector<ValueBounds> bounds(program.outputs.size() * boxes);
    machine.run(program, inputs, boxes, bounds);
    return bounds;
  };
  const std::vector<ValueBounds> all = run(0, count);
  for (std::size_t i = 0; i < count; i += 13) {
    const std::vector<ValueBounds> alone = run(i, 1);
    for (std::size_t k = 0; k < program.outputs.size(); ++k) EXPECT_EQ(alone[k], all[k * count + i]);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::vm
