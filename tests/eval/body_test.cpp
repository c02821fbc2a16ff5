// The same expression in a scene and in a body: every built-in's example, computed at once in double, and as
// a program over lanes with every number of it made to depend on the lane.
#include <gtest/gtest.h>

#include <cmath>

#include "run.h"

namespace tyndall::eval {
namespace UNNAMED {

// Rewrites the numbers of an expression: v becomes v + shift (a number), an angle a becomes a * (1 + shift).
// The shift is a number of the scene or the input p.x of a body. Numbers that must be known stay as they are.
class Shifter {
 public:
  Shifter(SceneText& text, std::optional<double> known_shift) : text_(text), known_shift_(known_shift) {}

  void shift(syntax::ExprId id) {
    using namespace syntax;
    const Expr expr = text_.tree[id];
    if (const auto* number = std::get_if<NumberExpr>(&expr.node)) {
      const bool angle = number->unit == Unit::angle;
      ExprId amount = this->amount(expr.span);
      if (angle)
        amount =
            add({expr.span, BinaryExpr{BinaryOp::add, add({expr.span, NumberExpr{1, Unit::none}}), amount}});
      const ExprId original = add(expr);
      text_.tree.exprs[id.index].node =
          BinaryExpr{angle ? BinaryOp::multiply : BinaryOp::add, original, amount};
    } else if (const auto* unary = std::get_if<UnaryExpr>(&expr.node)) {
      shift(unary->operand);
    } else if (const auto* tuple = std::get_if<TupleExpr>(&expr.node)) {
      for (const ExprId element : copy(tuple->elements)) shift(element);
    } else if (const auto* list = std::get_if<ListExpr>(&expr.node)) {
      shift(copy(list->elements).at(1));  // the value of a key; its position must be known
    } else if (const auto* call = std::get_if<CallExpr>(&expr.node)) {
      const auto arguments = text_.tree.list_of_arguments(call->arguments);
      const std::vector<Argument> copied(arguments.begin(), arguments.end());
      for (const Argument& argument : copied) {
        const bool makes_transform = std::holds_alternative<CallExpr>(text_.tree[argument.value].node);
        if (!argument.name.symbol.valid() && !makes_transform) shift(argument.value);
      }
    }
  }

 private:
  syntax::ExprId add(syntax::Expr expr) {
    text_.tree.exprs.push_back(std::move(expr));
    return syntax::ExprId(text_.tree.exprs.size() - 1);
  }
  syntax::ExprId amount(Span span) {
    if (known_shift_) return add({span, syntax::NumberExpr{*known_shift_, syntax::Unit::none}});
    const auto p = add({span, syntax::NameExpr{text_.symbols.intern("p")}});
    return add({span, syntax::MemberExpr{p, text_.symbols.intern("x"), span}});
  }
  std::vector<syntax::ExprId> copy(syntax::ListRef list) const {
    const auto elements = text_.tree.list_of_exprs(list);
    return {elements.begin(), elements.end()};
  }

  SceneText& text_;
  std::optional<double> known_shift_;
};

syntax::ExprId result_expression(const SceneText& text) {
  const auto& item = text.tree[text.tree.list_of_items(text.tree[text.tree.file].items)[0]];
  return std::get<syntax::LetItem>(item.node).value;
}

Value shifted_in_scene(std::string_view expression, double shift) {
  SceneText text("let result = " + std::string(expression));
  Shifter(text, shift).shift(result_expression(text));
  const Value value = text.scene();
  EXPECT_EQ(text.all_messages(), "");
  return value;
}

// The components over lanes whose p.x are `shifts`, by the machine.
std::vector<std::vector<float>> shifted_in_body(std::string_view expression, const std::vector<float>& shifts,
                                                bool fold) {
  SceneText text("let result = " + std::string(expression));
  Shifter(text, std::nullopt).shift(result_expression(text));
  vm::Builder builder(fold);
  Evaluator evaluator(text.context, &builder);
  const Value value = evaluator.evaluate(text.tree, result_expression(text), text.scope);
  EXPECT_EQ(text.all_messages(), "");
  std::vector<vm::NodeId> nodes;
  for (int i = 0; i < value.width(); ++i)
    nodes.push_back(evaluator.node(value.scalars[static_cast<std::size_t>(i)]));
  const auto program = builder.finish(nodes);
  EXPECT_TRUE(program.has_value());
  EXPECT_EQ(vm::verify(*program), "");
  std::vector<std::vector<float>> outputs(nodes.size(), std::vector<float>(shifts.size()));
  std::vector<float*> rows;
  for (auto& output : outputs) rows.push_back(output.data());
  vm::BatchInputs inputs;
  inputs[vm::Input::p_x] = shifts.data();
  vm::Machine machine;
  machine.run(*program, inputs, shifts.size(), rows);
  return outputs;
}

// Powers of two, so that sums with them are the same in float and double for the examples' short numbers.
const std::vector<float> shifts = {0.0f, 0.0625f, -0.03125f, 0.125f};

TEST(SceneAndBody, AgreeOnEveryBuiltIn) {
  int compared = 0;
  for (const vm::Builtin& row : vm::builtins()) {
    // What these are given must be known.
    if (!row.in_bodies || row.name == "sky" || row.name == "print") continue;
    SCOPED_TRACE(row.example);
    if (shifted_in_scene(row.example, 0).width() == 0) continue;  // rotate_x(90deg) is a transform
    const auto lanes = shifted_in_body(row.example, shifts, true);
    const auto unfolded = shifted_in_body(row.example, shifts, false);
    for (std::size_t lane = 0; lane < shifts.size(); ++lane) {
      // A hash of bits differs wholly where rounding to float differs at all.
      if (row.name == "random" && shifts[lane] != 0) continue;
      const Value expected = shifted_in_scene(row.example, static_cast<double>(shifts[lane]));
      ASSERT_EQ(lanes.size(), static_cast<std::size_t>(expected.width()));
      for (std::size_t c = 0; c < lanes.size(); ++c) {
        const double value = expected.scalars[c].value;
        // A few roundings of float: of the arguments (up to about 10) and of the result.
        EXPECT_NEAR(static_cast<double>(lanes[c][lane]), value, 4e-6 * std::max(1.0, std::abs(value)));
        EXPECT_EQ(lanes[c][lane], unfolded[c][lane]);
      }
    }
    ++compared;
  }
  EXPECT_GT(compared, 40);
}

TEST(SceneAndBody, AgreeOnOperators) {
  for (const char* expression : {"1.5 + 2", "1.5 - 2", "(1, 2, 3) * 4", "3 / 4", "2.5 ^ 1.5", "-(1, 2, 3)",
                                 "(1, 2, 3).zx", "min(2, 3) < 2.5", "max(1, 2) >= 2.5", "min(2, 3) == 2.5",
                                 "(1, 2) != (1, 2)", "40deg + 20deg", "2 * 40deg", "40deg / 20deg"}) {
    SCOPED_TRACE(expression);
    // Wrapped in a list's second element, the part that the shifter reaches through operators is the whole.
    SceneText scene("let result = " + std::string(expression));
    const Value expected = scene.scene();
    SceneText text("def f(o) = " + std::string(expression) + " let result = 0");
    vm::Builder builder;
    Evaluator evaluator(text.context, &builder);
    // Every number plus p.x - p.x stays the same, but is no longer known.
    for (std::size_t i = 0, n = text.tree.exprs.size(); i < n; ++i) {
      if (!std::holds_alternative<syntax::NumberExpr>(text.tree.exprs[i].node)) continue;
      Shifter(text, std::nullopt).shift(syntax::ExprId(i));
    }
    const auto& item = text.tree[text.tree.list_of_items(text.tree[text.tree.file].items)[0]];
    const Value value =
        evaluator.evaluate(text.tree, std::get<syntax::FunctionItem>(item.node).value, text.scope);
    EXPECT_EQ(text.all_messages(), "");
    ASSERT_EQ(value.type, expected.type);
    std::vector<vm::NodeId> nodes;
    for (int i = 0; i < value.width(); ++i)
      nodes.push_back(evaluator.node(value.scalars[static_cast<std::size_t>(i)]));
    const auto program = builder.finish(nodes);
    std::vector<float> result(nodes.size());
    std::vector<float*> rows;
    for (float& r : result) rows.push_back(&r);
    const float zero = 0;
    vm::BatchInputs inputs;
    inputs[vm::Input::p_x] = &zero;
    vm::Machine().run(*program, inputs, 1, rows);
    for (std::size_t c = 0; c < nodes.size(); ++c)
      EXPECT_NEAR(static_cast<double>(result[c]), expected.scalars[c].value,
                  1e-6 * std::max(1.0, std::abs(expected.scalars[c].value)));
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::eval
