// What the builder makes of a graph, compared as listings: values made once, folded, dropped, hoisted, rows
// reused.
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

struct Graph {
  Builder builder;
  NodeId x = builder.input(Input::p_x), y = builder.input(Input::p_y), time = builder.input(Input::time);

  explicit Graph(bool fold = true) : builder(fold) {}
  NodeId constant(float v) { return builder.constant(v); }
  NodeId emit(Op op, std::initializer_list<NodeId> operands) { return builder.emit(op, operands, {}); }
  std::string listing(std::initializer_list<NodeId> outputs) {
    return print(*builder.finish(std::vector<NodeId>(outputs)));
  }
};

TEST(Builder, MakesEqualValuesOnce) {
  Graph g;
  const NodeId a = g.emit(Op::add, {g.x, g.y}), b = g.emit(Op::add, {g.y, g.x});
  EXPECT_EQ(a, b);
  EXPECT_NE(g.emit(Op::sub, {g.x, g.y}), g.emit(Op::sub, {g.y, g.x}));
  EXPECT_EQ(g.constant(2), g.constant(2));
  EXPECT_NE(g.constant(0.0f), g.constant(-0.0f));
  const std::array p = {g.x, g.y, g.x};
  EXPECT_EQ(g.builder.emit(Op::fbm3, p, {}, 3, 1), g.builder.emit(Op::fbm3, p, {}, 3, 1));
  EXPECT_NE(g.builder.emit(Op::fbm3, p, {}, 3, 1), g.builder.emit(Op::fbm3, p, {}, 4, 1));
  EXPECT_NE(g.builder.emit(Op::fbm3, p, {}, 3, 1), g.builder.emit(Op::fbm3, p, {}, 3, 2));
}

TEST(Builder, FoldsConstantsByRunningTheKernels) {
  Graph g;
  const NodeId a = g.emit(Op::smoothstep, {g.constant(0), g.constant(1), g.constant(0.5f)});
  ASSERT_TRUE(g.builder.is_constant(a));
  EXPECT_EQ(g.builder.constant_value(a), 0.5f);
  EXPECT_EQ(g.listing({a}), "constants\n  c0 = 0.5\noutputs\n  c0\n");
}

TEST(Builder, DropsWhatChangesNothing) {
  Graph g;
  const NodeId one = g.constant(1), zero = g.constant(0);
  EXPECT_EQ(g.emit(Op::mul, {g.x, one}), g.x);
  EXPECT_EQ(g.emit(Op::mul, {one, g.x}), g.x);
  EXPECT_EQ(g.emit(Op::div, {g.x, one}), g.x);
  EXPECT_EQ(g.emit(Op::sub, {g.x, zero}), g.x);
  EXPECT_EQ(g.emit(Op::copy, {g.x}), g.x);
  EXPECT_EQ(g.emit(Op::neg, {g.emit(Op::neg, {g.x})}), g.x);
  EXPECT_EQ(g.emit(Op::select, {g.constant(1), g.x, g.y}), g.x);
  EXPECT_EQ(g.emit(Op::select, {zero, g.x, g.y}), g.y);
  EXPECT_EQ(g.emit(Op::select, {g.x, g.y, g.y}), g.y);
  // Adding zero turns -0 into 0, and 0 times infinity is NaN: both stay.
  EXPECT_NE(g.emit(Op::add, {g.x, zero}), g.x);
  EXPECT_FALSE(g.builder.is_constant(g.emit(Op::mul, {g.x, zero})));
}

TEST(Builder, DropsWhatNoOutputNeeds) {
  Graph g;
  const NodeId wanted = g.emit(Op::mul, {g.x, g.constant(3)});
  g.emit(Op::exp, {g.emit(Op::add, {g.y, g.constant(4)})});
  EXPECT_EQ(g.listing({wanted}),
            "constants\n  c0 = 3\n"
            "inputs\n  p.x\n"
            "every lane, 1 rows\n  r0 = mul p.x c0\n"
            "outputs\n  r0\n");
}

TEST(Builder, ComputesWhatIsUniformOnceABatch) {
  Graph g;
  const NodeId phase = g.emit(Op::sin, {g.emit(Op::mul, {g.time, g.constant(2)})});
  const NodeId result = g.emit(Op::max, {g.x, phase});
  EXPECT_TRUE(g.builder.is_uniform(phase));
  EXPECT_FALSE(g.builder.is_uniform(result));
  EXPECT_EQ(g.listing({result, phase}),
            "constants\n  c0 = 2\n"
            "inputs\n  time p.x\n"
            "once a batch\n  u0 = mul time c0\n  u1 = sin u0\n"
            "every lane, 1 rows\n  r0 = max p.x u1\n"
            "outputs\n  r0 u1\n");
}

TEST(Builder, FusesProductsWithOneReaderIntoSums) {
  Graph g;
  const NodeId product = g.emit(Op::mul, {g.x, g.constant(2)});
  const NodeId sum = g.emit(Op::add, {g.y, product});
  EXPECT_EQ(g.listing({sum}),
            "constants\n  c0 = 2\n"
            "inputs\n  p.x p.y\n"
            "every lane, 1 rows\n  r0 = fma p.x c0 p.y\n"
            "outputs\n  r0\n");
  EXPECT_EQ(g.listing({sum, product}),
            "constants\n  c0 = 2\n"
            "inputs\n  p.x p.y\n"
            "every lane, 2 rows\n  r0 = mul p.x c0\n  r1 = add p.y r0\n"
            "outputs\n  r1 r0\n");
}

TEST(Builder, FusesWhatOneReaderWants) {
  struct Case {
    Op outer;
    bool inner_left, inner_right;
    Op inner;
    std::string code;
  };
  const Case cases[] = {
      {Op::add, true, false, Op::mul, "fma p.x p.y uv.x"},
      {Op::add, false, true, Op::mul, "fma p.x p.y uv.x"},
      {Op::sub, true, false, Op::mul, "fms p.x p.y uv.x"},
      {Op::sub, false, true, Op::mul, "fnma p.x p.y uv.x"},
      {Op::add, true, true, Op::mul, "dot2 p.x p.y p.y uv.x"},
      {Op::mul, true, false, Op::add, "add_mul p.x p.y uv.x"},
      {Op::mul, false, true, Op::add, "add_mul p.x p.y uv.x"},
      {Op::mul, true, false, Op::sub, "sub_mul p.x p.y uv.x"},
  };
  for (const Case& c : cases) {
    Graph g;
    const NodeId u = g.builder.input(Input::u), inner = g.emit(c.inner, {g.x, g.y});
    const NodeId left = c.inner_left ? inner : u;
    const NodeId right = c.inner_left && c.inner_right ? g.emit(c.inner, {g.y, u})
                         : c.inner_right               ? inner
                                                       : u;
    const NodeId result = g.emit(c.outer, {left, right});
    EXPECT_EQ(g.listing({result}),
              "inputs\n  p.x p.y uv.x\nevery lane, 1 rows\n  r0 = " + c.code + "\noutputs\n  r0\n");
  }
}

TEST(Builder, DividesByPowersOfTwoByMultiplying) {
  Graph g;
  EXPECT_EQ(g.emit(Op::div, {g.x, g.constant(4)}), g.emit(Op::mul, {g.x, g.constant(0.25f)}));
  EXPECT_EQ(g.emit(Op::div, {g.x, g.constant(-0x1p-126f)}), g.emit(Op::mul, {g.x, g.constant(-0x1p126f)}));
  // 1/3 is rounded, and 2^-128 is no normal number (not every machine multiplies by one quickly).
  EXPECT_EQ(g.listing({g.emit(Op::div, {g.x, g.constant(3)}), g.emit(Op::div, {g.x, g.constant(0x1p127f)})}),
            "constants\n  c0 = 3\n  c1 = 1.7014118e+38\n"
            "inputs\n  p.x\n"
            "every lane, 2 rows\n  r0 = div p.x c0\n  r1 = div p.x c1\n"
            "outputs\n  r0 r1\n");
}

TEST(Builder, MovesSignsOutOfSums) {
  Graph g;
  const NodeId minus_x = g.emit(Op::neg, {g.x}), minus_y = g.emit(Op::neg, {g.y});
  EXPECT_EQ(g.emit(Op::add, {g.y, minus_x}), g.emit(Op::sub, {g.y, g.x}));
  EXPECT_EQ(g.emit(Op::add, {minus_x, g.y}), g.emit(Op::sub, {g.y, g.x}));
  EXPECT_EQ(g.emit(Op::sub, {g.y, minus_x}), g.emit(Op::add, {g.y, g.x}));
  EXPECT_EQ(g.emit(Op::mul, {minus_x, minus_y}), g.emit(Op::mul, {g.x, g.y}));
  EXPECT_EQ(g.emit(Op::mul, {g.x, g.constant(-1)}), minus_x);
  EXPECT_EQ(g.emit(Op::abs, {minus_x}), g.emit(Op::abs, {g.x}));
  EXPECT_EQ(g.emit(Op::add, {g.x, g.constant(-0.0f)}), g.x);
  // x - x is NaN for infinities, and min(0, -0) depends on the order.
  EXPECT_FALSE(g.builder.is_constant(g.emit(Op::sub, {g.x, g.x})));
  EXPECT_NE(g.emit(Op::min, {g.x, g.y}), g.emit(Op::min, {g.y, g.x}));
}

TEST(Builder, DecidesChoicesOnce) {
  Graph g;
  const NodeId c = g.emit(Op::less, {g.x, g.y}), one = g.constant(1), zero = g.constant(0);
  const NodeId chosen = g.emit(Op::select, {c, g.x, g.time});
  EXPECT_EQ(g.emit(Op::select, {c, chosen, g.y}), g.emit(Op::select, {c, g.x, g.y}));
  EXPECT_EQ(g.emit(Op::select, {c, g.y, chosen}), g.emit(Op::select, {c, g.y, g.time}));
  const NodeId not_c = g.emit(Op::logical_not, {c});
  EXPECT_EQ(g.emit(Op::select, {not_c, g.x, g.y}), g.emit(Op::select, {c, g.y, g.x}));
  EXPECT_EQ(g.emit(Op::logical_not, {not_c}), c);
  EXPECT_EQ(g.emit(Op::logical_and, {c, one}), c);
  EXPECT_EQ(g.emit(Op::logical_and, {zero, c}), zero);
  EXPECT_EQ(g.emit(Op::logical_or, {c, one}), one);
  EXPECT_EQ(g.emit(Op::logical_or, {c, c}), c);
  // Not every number is a boolean, and not(x < y) holds for NaN where x >= y does not.
  EXPECT_NE(g.emit(Op::logical_and, {g.x, one}), g.x);
  EXPECT_NE(not_c, g.emit(Op::less_equal, {g.y, g.x}));
}

TEST(Builder, ReusesRowsAfterTheirLastReader) {
  Graph g;
  NodeId value = g.x;
  for (int i = 0; i < 50; ++i) value = g.emit(Op::max, {g.emit(Op::sin, {value}), g.emit(Op::cos, {value})});
  const Program program = *g.builder.finish(std::array{value});
  EXPECT_EQ(program.lane_code.size(), 150u);
  EXPECT_EQ(program.row_count, 2);
}

TEST(Builder, KeepsEveryOperationWithFoldingOff) {
  Graph g(false);
  const NodeId a = g.emit(Op::add, {g.constant(1), g.constant(2)});
  EXPECT_FALSE(g.builder.is_constant(a));
  EXPECT_TRUE(g.builder.is_constant(g.constant(1)));
  EXPECT_NE(g.emit(Op::add, {g.x, g.y}), g.emit(Op::add, {g.x, g.y}));
  const NodeId b = g.emit(Op::mul, {g.x, a});
  EXPECT_EQ(g.listing({g.emit(Op::add, {b, g.constant(1)})}),
            "constants\n  c0 = 1\n  c1 = 2\n"
            "inputs\n  p.x\n"
            "once a batch\n  u0 = add c0 c1\n"
            "every lane, 1 rows\n  r0 = mul p.x u0\n  r0 = add r0 c0\n"
            "outputs\n  r0\n");
}

TEST(Builder, PassesInputsAndRepeatedOutputsThrough) {
  Graph g;
  EXPECT_EQ(g.listing({g.x, g.x, g.time}), "inputs\n  p.x time\noutputs\n  p.x p.x time\n");
  EXPECT_EQ(g.listing({}), "outputs\n \n");
}

TEST(Builder, ReportsProgramsBeyondTheEncoding) {
  Builder builder;
  std::vector<NodeId> outputs;
  for (int i = 0; i < 65536; ++i) outputs.push_back(builder.constant(static_cast<float>(i)));
  EXPECT_FALSE(builder.finish(outputs).has_value());
  outputs.pop_back();
  EXPECT_TRUE(builder.finish(outputs).has_value());
}

TEST(Print, ShowsTheSourceLineAboveItsInstructions) {
  Sources sources;
  const std::string text = "let a = 1\n  density = sin(p.x) * 2 + p.y\n";
  const SourceId id = sources.add("fog.tyn", text);
  const auto begin = static_cast<std::uint32_t>(text.find("sin"));
  const Span span{id, begin, begin + 8};
  Builder builder;
  const NodeId x = builder.input(Input::p_x);
  const NodeId sine = builder.emit(Op::sin, {x}, span);
  const NodeId result = builder.emit(Op::max, {sine, x}, span);
  EXPECT_EQ(print(*builder.finish(std::array{result}), &sources),
            "inputs\n  p.x\n"
            "every lane, 1 rows\n"
            "  // fog.tyn:2: density = sin(p.x) * 2 + p.y\n"
            "  r0 = sin p.x\n  r0 = max r0 p.x\n"
            "outputs\n  r0\n");
}

}  // namespace
}  // namespace tyndall::vm
