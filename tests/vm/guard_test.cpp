// Guards: what only one side of a choice needs is skipped where no lane takes that side, and nothing changes.
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

struct Graph {
  Builder builder;
  NodeId x = builder.input(Input::p_x), y = builder.input(Input::p_y), z = builder.input(Input::p_z);

  explicit Graph(bool fold = true, bool guards = true) : builder(fold, guards) {}
  NodeId constant(float v) { return builder.constant(v); }
  NodeId emit(Op op, std::initializer_list<NodeId> operands) {
    return builder.emit(op, operands, {}, octaves_of(op));
  }
  NodeId fbm(NodeId at) { return emit(Op::fbm3, {at, y, z}); }
  Program program(std::initializer_list<NodeId> outputs) {
    return *builder.finish(std::vector<NodeId>(outputs));
  }
};

TEST(Guards, StandAroundWhatOneBranchNeeds) {
  Graph g;
  const NodeId inside = g.emit(Op::less, {g.x, g.constant(1)});
  const NodeId shared = g.emit(Op::mul, {g.y, g.constant(3)});
  const NodeId cloud = g.emit(Op::max, {g.fbm(shared), g.constant(0)});
  const NodeId haze = g.emit(Op::exp, {g.emit(Op::neg, {g.x})});
  const NodeId density = g.emit(Op::select, {inside, cloud, g.emit(Op::mul, {haze, haze})});
  EXPECT_EQ(print(g.program({density, shared})),
            "constants\n  c0 = 1\n  c1 = 3\n  c2 = 0\n"
            "inputs\n  p.x p.y p.z\n"
            "every lane, 4 rows\n"
            "  r0 = less p.x c0\n"
            "  r1 = mul p.y c1\n"
            "  where r0 {\n"
            "    r2 = fbm3 r1 p.y p.z  octaves 3  seed 0\n"
            "    r2 = max r2 c2\n"
            "  }\n"
            "  where not r0 {\n"
            "    r3 = neg p.x\n"
            "    r3 = exp r3\n"
            "    r3 = mul r3 r3\n"
            "  }\n"
            "  r0 = select r0 r2 r3\n"
            "outputs\n  r0 r1\n");
}

TEST(Guards, AreNotWorthAFewSums) {
  Graph g;
  const NodeId c = g.emit(Op::less, {g.x, g.y});
  const NodeId result = g.emit(Op::select, {c, g.emit(Op::add, {g.x, g.z}), g.emit(Op::mul, {g.y, g.z})});
  EXPECT_TRUE(g.program({result}).guards.empty());
}

TEST(Guards, HoldWhatSeveralSelectsOfOneConditionNeed) {
  Graph g;
  const NodeId c = g.emit(Op::less, {g.x, g.y});
  const NodeId noise = g.fbm(g.x), finer = g.fbm(g.z);
  const NodeId a = g.emit(Op::select, {c, noise, g.constant(0)});
  const NodeId b = g.emit(Op::select, {c, g.emit(Op::add, {noise, finer}), g.constant(1)});
  const Program program = g.program({a, b});
  ASSERT_EQ(program.guards.size(), 1u);
  EXPECT_EQ(program.guards[0].last - program.guards[0].first, 3u);
  // What is needed elsewhere, too, is computed everywhere.
  EXPECT_EQ(g.program({a, b, noise}).guards[0].last - g.program({a, b, noise}).guards[0].first, 2u);
}

TEST(Guards, NestAsChoicesDo) {
  Graph g;
  const NodeId outer = g.emit(Op::less, {g.x, g.y}), inner = g.emit(Op::less, {g.fbm(g.x), g.z});
  const NodeId detail = g.emit(Op::select, {inner, g.fbm(g.z), g.constant(2)});
  const Program program = g.program({g.emit(Op::select, {outer, detail, g.constant(0)})});
  ASSERT_EQ(program.guards.size(), 2u);
  EXPECT_LT(program.guards[0].first, program.guards[1].first);
  EXPECT_GE(program.guards[0].last, program.guards[1].last);
}

TEST(Guards, SkipGroupsOfLanesAndChangeNothing) {
  Graph g, plain(true, false);
  const auto build = [](Graph& graph) {
    const NodeId c = graph.emit(Op::less, {graph.x, graph.constant(0)});
    const NodeId bad = graph.emit(Op::log, {graph.x});  // NaN for the lanes that take the other branch
    return graph.program(
        {graph.emit(Op::select, {c, graph.fbm(graph.x), graph.emit(Op::add, {bad, graph.fbm(bad)})})});
  };
  const Program guarded = build(g), all = build(plain);
  ASSERT_EQ(guarded.guards.size(), 2u);
  ASSERT_TRUE(all.guards.empty());
  for_each_simd_class([&](const std::string&) {
    Machine machine;
    std::mt19937 random(4);
    std::vector<std::array<float, 4>> rows(256);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = {i < 100      ? -1.0f
                 : i < 200    ? 2.0f
                 : i % 2 == 0 ? -0.5f
                              : 0.5f,
                 static_cast<float>(random() % 100), 0.3f, 0};
    const Lanes lanes(rows);
    const auto expected = run(machine, all, lanes.from(0), 256);
    const auto found = run(machine, guarded, lanes.from(0), 256);
    for (std::size_t i = 0; i < 256; ++i) ASSERT_TRUE(same(found[i], expected[i])) << i;
    // Groups of 16: lanes 0 … 111 and 192 … 255 hold a negative x, 96 … 255 another.
    const auto counts = machine.lanes_run(guarded);
    EXPECT_EQ(counts.front(), 256u);
    for (const Guard& guard : guarded.guards)
      EXPECT_EQ(counts[guard.first], guard.when ? 112u + 64 : 160u) << guard.when;
    for (std::size_t i = 0; i < 256; ++i) {
      const auto alone = run(machine, guarded, lanes.from(i), 1);
      ASSERT_TRUE(same(alone[0], expected[i])) << i;
    }
  });
}

TEST(Guards, MayHangOnAnInputOrOnAnOutput) {
  Graph g, plain(true, false);
  const auto build = [](Graph& graph) {
    const NodeId c = graph.emit(Op::less, {graph.y, graph.constant(2)});
    const NodeId a = graph.emit(Op::select, {graph.x, graph.fbm(graph.z), graph.y});
    const NodeId b = graph.emit(Op::select, {c, graph.fbm(a), graph.z});
    return graph.program({b, c, graph.x});
  };
  const Program guarded = build(g), all = build(plain);
  EXPECT_EQ(guarded.guards.size(), 2u);
  std::vector<std::array<float, 4>> rows(300);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = {i % 100 < 50 ? 0.0f : 1.0f, static_cast<float>(i / 40), 0.1f * static_cast<float>(i), 0};
  const Lanes lanes(rows);
  Machine machine;
  for (const std::size_t count : {1u, 16u, 64u, 255u, 256u, 288u, 300u}) {
    std::array<std::array<std::vector<float>, 3>, 2> results;
    for (std::size_t way = 0; way < 2; ++way) {
      std::array<float*, 3> outputs{};
      for (std::size_t k = 0; k < 3; ++k)
        outputs[k] = (results[way][k].resize(count), results[way][k].data());
      machine.run(way == 0 ? guarded : all, lanes.from(0), count, outputs);
    }
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_TRUE(same(results[0][k][i], results[1][k][i])) << k << ' ' << i;
  }
}

// Chains of choices among expensive values, with conditions that repeat.
std::vector<NodeId> random_choices(Builder& builder, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<NodeId> values, conditions;
  for (const Input input : lane_inputs) values.push_back(builder.input(input));
  values.push_back(builder.input(Input::time));
  const auto any = [&] {
    return values[values.size() - 1 - random() % std::min<std::size_t>(values.size(), 8)];
  };
  for (int i = 0; i < 60; ++i) {
    if (conditions.empty() || random() % 5 == 0)
      conditions.push_back(builder.emit(Op::less, {any(), any()}, {}));
    if (random() % 3 == 0)
      values.push_back(
          builder.emit(Op::select, {conditions[random() % conditions.size()], any(), any()}, {}));
    else if (random() % 2 == 0)
      values.push_back(builder.emit(Op::fbm3, {any(), any(), any()}, {}, 1));
    else
      values.push_back(random() % 2 == 0 ? builder.emit(Op::add, {any(), any()}, {})
                                         : builder.emit(Op::log, {any()}, {}));
  }
  return {values[values.size() - 1], values[values.size() - 2]};
}

TEST(Guards, ChangeNoBitOfRandomPrograms) {
  Machine machine;
  const std::size_t count = 96;
  std::mt19937 random(12);
  std::uniform_real_distribution<float> range(-2, 2);
  std::vector<std::array<float, 4>> rows(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      rows[i][k] = i % 16 == 0 || k < 2 ? range(random) : rows[i - 1][k];  // neighbours often agree
  const Lanes lanes(rows);
  const float time = 0.5f;
  BatchInputs inputs = lanes.from(0);
  inputs[Input::time] = &time;
  std::size_t with_guards = 0, nested = 0, skipped = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    Builder guarding(true, true), plain(true, false), unfolded(false, true);
    std::vector<std::vector<float>> results;
    const auto compute = [&](Builder& builder) {
      const Program program = *builder.finish(random_choices(builder, seed));
      EXPECT_EQ(verify(program), "");
      std::array<std::vector<float>, 2> out{std::vector<float>(count), std::vector<float>(count)};
      machine.run(program, inputs, count, std::array{out[0].data(), out[1].data()});
      results.insert(results.end(), out.begin(), out.end());
      run_reference(program, inputs, count, std::array{out[0].data(), out[1].data()});
      results.insert(results.end(), out.begin(), out.end());
      return program;
    };
    const Program guarded = compute(guarding);
    compute(plain), compute(unfolded);
    with_guards += !guarded.guards.empty();
    for (const std::uint64_t n : machine.lanes_run(guarded)) skipped += n < count;
    for (std::size_t i = 1; i < guarded.guards.size(); ++i)
      nested += guarded.guards[i].first < guarded.guards[i - 1].last;
    for (std::size_t way = 2; way < results.size(); ++way)
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_TRUE(same(results[way][i], results[way % 2][i])) << "seed " << seed << ", way " << way << '\n'
                                                                << print(guarded);
  }
  EXPECT_GT(with_guards, 500u);
  EXPECT_GT(nested, 100u);
  EXPECT_GT(skipped, 1000u);
}

TEST(Guards, AreVerified) {
  Graph g;
  const NodeId c = g.emit(Op::less, {g.x, g.y});
  const Program sound = g.program({g.emit(Op::select, {c, g.fbm(g.x), g.y})});
  ASSERT_EQ(verify(sound), "");
  const auto wrong = [&](auto change) {
    Program p = sound;
    change(p);
    return verify(p);
  };
  const auto has = [](const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(wrong([](Program& p) { p.guards[0].when = false; }), "in lanes that may have skipped it"));
  EXPECT_TRUE(has(wrong([](Program& p) {
                    p.outputs[0] = p.lane_code[1].destination;
                    p.lane_code.pop_back();
                    p.lane_spans.pop_back();
                  }),
                  "in lanes that may have skipped it"));
  EXPECT_TRUE(has(wrong([](Program& p) { p.guards[0].last = 9; }), "guards are not in order"));
  EXPECT_TRUE(
      has(wrong([](Program& p) { p.guards[0].last = p.guards[0].first; }), "guards are not in order"));
  EXPECT_TRUE(has(wrong([](Program& p) { p.guards.push_back({0, 2, 0, true}); }), "guards are not in order"));
  EXPECT_TRUE(has(wrong([](Program& p) { p.guards[0].condition = 999; }), "reads operand 999"));
}

}  // namespace
}  // namespace tyndall::vm
