// Evaluates expressions: one overload of Dispatch for each kind.
#include "eval/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "eval/calls.h"
#include "eval/lists.h"
#include "eval/operators.h"
#include "vm/run/machine.h"

namespace tyndall::eval {

using namespace syntax;

Evaluator::Evaluator(Context& context, vm::Builder* builder, BodyKind body)
    : context_(context), builder_(builder), body_(body) {
  if (!context_.names) context_.names = std::make_shared<Names>(*context_.symbols);
}

Scalar Evaluator::emit(vm::Op op, std::span<const Scalar> operands, Span span, std::uint8_t repeats,
                       std::uint32_t immediate) {
  const bool known = std::all_of(operands.begin(), operands.end(), [](const Scalar& s) { return s.known(); });
  if (known) {
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < operands.size(); ++i) values[i] = operands[i].value;
    return Scalar{vm::evaluate(op, std::span(values.data(), operands.size()), repeats, immediate)};
  }
  if (op == vm::Op::pow && operands[1].known())
    if (const std::optional<Scalar> power = easy_power(operands[0], operands[1].value, span)) return *power;
  std::array<vm::NodeId, 4> nodes;
  for (std::size_t i = 0; i < operands.size(); ++i) nodes[i] = node(operands[i]);
  const vm::NodeId id = builder_->emit(op, std::span<const vm::NodeId>(nodes.data(), operands.size()), span,
                                       repeats, immediate);
  return Scalar{0, id};
}

// Powers that a few products or a root give faster than pow, and as exactly.
std::optional<Scalar> Evaluator::easy_power(const Scalar& x, double exponent, Span span) {
  const auto square = [&](const Scalar& a) { return emit(vm::Op::mul, {a, a}, span); };
  if (exponent == 1) return x;
  if (exponent == 2) return square(x);
  if (exponent == 3) return emit(vm::Op::mul, {square(x), x}, span);
  if (exponent == 4) return square(square(x));
  if (exponent == 0.5) return emit(vm::Op::sqrt, {x}, span);
  if (exponent == -1) return emit(vm::Op::div, {Scalar{1}, x}, span);
  return std::nullopt;
}

vm::NodeId Evaluator::node(const Scalar& scalar) {
  return scalar.known() ? builder_->constant(static_cast<float>(scalar.value)) : scalar.node;
}

std::int64_t count(const RangeValue& range) {
  if (!(range.step != 0) || !std::isfinite(range.step)) return 0;
  // A whole number of steps may miss the last value by rounding only.
  const double steps = (range.last - range.first) / range.step;
  const double nearest = std::round(steps);
  const bool hits = std::abs(steps - nearest) <= 1e-9 * std::max(1.0, std::abs(steps));
  const double last = hits ? nearest - (range.excludes_last ? 1 : 0) : std::floor(steps);
  if (!(last >= 0)) return 0;
  return last >= 1e15 ? static_cast<std::int64_t>(1e15) : static_cast<std::int64_t>(last) + 1;
}

double at(const RangeValue& range, std::int64_t index) {
  return range.first + range.step * static_cast<double>(index);
}

class Evaluator::Nested {
 public:
  explicit Nested(Evaluator& evaluator) : evaluator_(evaluator) {
    if (evaluator_.depth_++ == 0 && !evaluator_.in_body())
      evaluator_.iterations_ = evaluator_.calls_ = evaluator_.list_entries_ = 0;
  }
  ~Nested() { --evaluator_.depth_; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  Evaluator& evaluator_;
};

static double linear_from_srgb(std::uint32_t byte) {
  const double s = byte / 255.0;  // IEC 61966-2-1
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// Position of a swizzle letter, or -1.
static int component(char letter) {
  switch (letter) {
    case 'x':
    case 'r':
      return 0;
    case 'y':
    case 'g':
      return 1;
    case 'z':
    case 'b':
      return 2;
    default:
      return -1;
  }
}

struct Dispatch {
  Evaluator& ev;
  const SyntaxTree& tree;
  Span span;
  const std::shared_ptr<Scope>& scope;

  Span place(ExprId id) const { return tree[id].span; }
  Value value(ExprId id) const { return ev.evaluate(tree, id, scope); }

  Value operator()(const ErrorExpr&) const { return {}; }
  Value operator()(const NumberExpr& e) const {
    return e.unit == Unit::angle ? Value::angle(e.value) : Value::number(e.value, e.unit);
  }
  Value operator()(const ColorExpr& e) const {
    return Value::vec({linear_from_srgb(e.rgb >> 16 & 255), linear_from_srgb(e.rgb >> 8 & 255),
                       linear_from_srgb(e.rgb & 255)});
  }
  Value operator()(const BoolExpr& e) const { return Value::boolean(e.value); }

  Value operator()(const StringExpr& e) const {
    const StringValue& literal = tree.strings[e.literal];
    std::string text;
    if (!append_piece(text, literal.pieces[0])) return {};
    bool failed = false;
    for (std::size_t i = 0; i < literal.values.size(); ++i) {
      const Value part = value(literal.values[i]);
      const bool printable = part.width() > 0 || part.type == Type::string || part.type == Type::list;
      if (part.is_error())
        failed = true;
      else if (!printable || !part.known()) {
        ev.error(place(literal.values[i]),
                 printable ? "a string must be known when the scene is read"
                           : fmt::format("{} cannot be written into a string", describe(part.type)));
        failed = true;
      } else if (literal.formats[i].given() && (part.width() == 0 || part.type == Type::boolean)) {
        failed = true;
        ev.error(place(literal.values[i]), fmt::format("the format of a number for {}", describe(part.type)),
                 "leave out what follows ':', or format the numbers themselves");
      } else if (part.type == Type::list ? !append_text(text, part, max_string_bytes)
                                         : !append_piece(text, text_of(part, literal.formats[i]))) {
        return too_long_a_string();
      }
      if (!append_piece(text, literal.pieces[i + 1])) return {};
    }
    return failed ? Value{} : Value::string(std::move(text));
  }

  Value too_long_a_string() const {
    return ev.error(span, fmt::format("a string of more than {} bytes", max_string_bytes),
                    "strings are names of files and parts of them");
  }
  // False after an error.
  bool append_piece(std::string& text, const std::string& piece) const {
    if (text.size() + piece.size() > max_string_bytes) return !too_long_a_string().is_error();
    text += piece;
    return true;
  }

  Value operator()(const NameExpr& e) const { return ev.value_of_name(e.symbol, span, *scope); }

  Value operator()(const UnaryExpr& e) const {
    const Value operand = value(e.operand);
    return e.op == UnaryOp::negate ? negated(ev, operand, span) : inverted(ev, operand, span);
  }

  // Long sums are deep on their left: the left spine is walked, not recursed into.
  Value operator()(const BinaryExpr& first) const {
    if (first.op == BinaryOp::logical_and || first.op == BinaryOp::logical_or) return logical(first);
    std::vector<std::pair<const BinaryExpr*, Span>> spine{{&first, span}};
    ExprId leftmost = first.left;
    while (const auto* inner = std::get_if<BinaryExpr>(&tree[leftmost].node)) {
      if (inner->op == BinaryOp::logical_and || inner->op == BinaryOp::logical_or) break;
      spine.push_back({inner, place(leftmost)});
      leftmost = inner->left;
    }
    Value result = value(leftmost);
    for (auto it = spine.rbegin(); it != spine.rend(); ++it) {
      const BinaryExpr& e = *it->first;
      result = binary(ev, e.op, result, value(e.right), {it->second, place(e.left), place(e.right)});
    }
    return result;
  }

  Value logical(const BinaryExpr& e) const {
    const Value left = value(e.left);
    if (left.type == Type::boolean && left.scalars[0].known() &&
        (left.scalars[0].value != 0) == (e.op == BinaryOp::logical_or)) {
      ev.check_names(tree, e.right, scope);
      return left;
    }
    const Value right = value(e.right);
    if (left.is_error() || right.is_error()) return {};
    for (const auto& [side, id] : {std::pair{&left, e.left}, std::pair{&right, e.right}})
      if (side->type != Type::boolean)
        return ev.error(
            place(id),
            fmt::format("'{}' wants true or false, found {}", spelling(e.op), describe(side->type)),
            "compare first, for instance x > 0");
    return left.scalars[0].known() ? right
                                   : binary(ev, e.op, left, right, {span, place(e.left), place(e.right)});
  }

  Value operator()(const ConditionalExpr& e) const {
    const Value condition = value(e.condition);
    if (condition.type == Type::boolean && condition.scalars[0].known()) {
      const bool taken = condition.as_bool();
      ev.check_names(tree, taken ? e.else_value : e.then_value, scope);
      return value(taken ? e.then_value : e.else_value);
    }
    const Value then_value = value(e.then_value), else_value = value(e.else_value);
    if (condition.is_error()) return {};
    if (condition.type != Type::boolean)
      return ev.error(place(e.condition),
                      fmt::format("'if' wants true or false, found {}", describe(condition.type)),
                      "compare first, for instance x > 0");
    return select(ev, condition.scalars[0], then_value, else_value, span);
  }

  Value operator()(const CallExpr& e) const { return evaluate_call(ev, tree, e, span, scope); }

  Value operator()(const IndexExpr& e) const {
    const Value list = value(e.list), index = value(e.index);
    if (list.is_error() || index.is_error()) return {};
    if (list.type != Type::list)
      return ev.error(
          place(e.list), fmt::format("only a list has elements, found {}", describe(list.type)),
          list.type == Type::vec || list.type == Type::pair ? "components are v.x, v.y, v.z" : "");
    const std::vector<Value>& elements = list.as_list();
    if (index.type == Type::number && !index.known() && !elements.empty())
      return chosen(elements, index.scalars[0]);
    const std::optional<std::size_t> i = place_in(ev, elements, index, place(e.index));
    return i ? elements[*i] : Value{};
  }

  Value operator()(const WithEntryExpr& e) const { return with_entry(ev, tree, e, span, scope); }

  // The element at an index that differs from place to place, rounded down; beyond the ends the first and the
  // last.
  Value chosen(const std::vector<Value>& elements, const Scalar& index) const {
    if (elements.size() > max_unrolled_iterations)
      return ev.error(
          span, fmt::format("an index that differs from place to place, into a list of {}", elements.size()),
          fmt::format("such a list has at most {} entries; a picture may hold more",
                      max_unrolled_iterations));
    Value result = elements[0];
    for (std::size_t k = 1; k < elements.size() && !result.is_error(); ++k) {
      const Scalar reached = ev.emit(vm::Op::less_equal, {Scalar{static_cast<double>(k)}, index}, span);
      result = select(ev, reached, elements[k], result, span);
    }
    return result;
  }

  Value operator()(const MemberExpr& e) const {
    const Value object = value(e.object);
    if (object.is_error()) return {};
    const std::string_view letters = ev.text(e.member);
    if (object.type != Type::pair && object.type != Type::vec)
      return ev.error(e.member_span, fmt::format("{} has no '{}'", describe(object.type), letters),
                      ev.help_for_member(e.member, "components belong to pairs and vecs"));
    Value result = Value::of(letters.size() == 1   ? Type::number
                             : letters.size() == 2 ? Type::pair
                                                   : Type::vec,
                             {});
    result.unit = object.unit;
    if (letters.size() > 3)
      return ev.error(e.member_span, fmt::format("'{}' has {} letters", letters, letters.size()),
                      ev.help_for_member(e.member, "one, two or three letters choose components"));
    for (std::size_t i = 0; i < letters.size(); ++i) {
      const int chosen = component(letters[i]);
      if (chosen < 0 || chosen >= object.width())
        return ev.error(
            e.member_span, fmt::format("{} has no component '{}'", describe(object.type), letters[i]),
            object.type == Type::pair ? "components are x, y" : "components are x, y, z (or r, g, b)");
      result.scalars[i] = object.scalars[static_cast<std::size_t>(chosen)];
    }
    return result;
  }

  Value operator()(const TupleExpr& e) const {
    const auto elements = tree.list_of_exprs(e.elements);
    CHECK(elements.size() == 2 || elements.size() == 3);  // as parsed
    Value result = Value::of(elements.size() == 2 ? Type::pair : Type::vec, {});
    bool failed = false;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const Value element = ev.evaluate_as(Type::number, tree, elements[i], scope, "a component");
      failed |= element.is_error();
      result.scalars[i] = element.scalars[0];
      if (element.unit == Unit::none || element.is_error()) continue;
      if (result.unit != Unit::none && result.unit != element.unit && !failed) {
        ev.error(span,
                 fmt::format("{} and {} in one {}", describe_unit(result.unit), describe_unit(element.unit),
                             elements.size() == 2 ? "pair" : "vec"),
                 "components must measure the same");
        failed = true;
      }
      result.unit = element.unit;
    }
    return failed ? Value{} : result;
  }

  Value operator()(const ListExpr& e) const {
    std::vector<Value> elements;
    bool failed = false;
    for (const ExprId id : tree.list_of_exprs(e.elements)) {
      elements.push_back(value(id));
      failed |= elements.back().is_error();
    }
    return failed ? Value{} : list_of(ev, std::move(elements), span);
  }

  Value operator()(const ComprehensionExpr& e) const { return comprehension(ev, tree, e, span, scope); }

  Value operator()(const RangeExpr& e) const {
    RangeValue range;
    range.excludes_last = e.excludes_last;
    bool failed = false;
    const auto read = [&](ExprId id, double& to, std::string_view what) {
      const Value bound = ev.evaluate_as(Type::number, tree, id, scope, what);
      failed |= bound.is_error();
      if (bound.is_error()) return;
      if (bound.known()) {
        to = bound.as_number();
      } else if (id == e.last) {
        range.lane_last = bound.scalars[0];
        to = ev.builder()->most(range.lane_last.node);
        failed |= !std::isfinite(to);
        if (failed)
          ev.error(place(id), "the end of this range differs from place to place, and it may be any number",
                   "give it a limit, for instance min(n, 8)");
      } else {
        ev.error(place(id), fmt::format("{} must be known when the scene is read", what),
                 "only the end of a range may differ from place to place");
        failed = true;
      }
    };
    read(e.first, range.first, "the beginning of a range");
    read(e.last, range.last, "the end of a range");
    if (e.step.valid()) {
      read(e.step, range.step, "the step of a range");
      if (!failed && range.step == 0)
        return ev.error(place(e.step), "the step of a range is 0", "write ..1 or leave it out");
      if (!failed && range.differs() && range.step < 0)
        return ev.error(place(e.step), "a range that counts down ends at a known number in a body",
                        "count up, and take the difference inside");
    }
    return failed ? Value{} : Value::of_heavy(Type::range, range);
  }

  Value operator()(const ThingExpr& e) const {
    if (e.keyword.symbol.valid()) {
      if (scope->find(e.keyword.symbol))  // `cloud { … }`: a definition used like a thing
        return ev.error(e.keyword.span, fmt::format("'{}' is not a kind of thing", ev.text(e.keyword.symbol)),
                        "arguments are given in ( ), for instance cloud(height: 2)");
      return Value::of_heavy(Type::shape, ShapeLiteral{&tree, &e, scope, span});
    }
    return unnamed_body(BodyKind::medium, e);
  }

  Value unnamed_body(BodyKind kind, const ThingExpr& e) const {
    Body body;
    body.tree = &tree;
    body.kind = kind;
    body.name = kind == BodyKind::medium ? "medium" : "material";
    body.definition = span;
    body.block = e.block;
    body.scope = body.definition_scope = scope;
    body.key = ev.key_of(body, *scope);
    return Value::of_heavy(kind == BodyKind::medium ? Type::medium : Type::material, std::move(body));
  }
};

Value Evaluator::evaluate(const SyntaxTree& tree, ExprId id, const std::shared_ptr<Scope>& scope) {
  const Expr& expr = tree[id];
  if (const auto* number = std::get_if<NumberExpr>(&expr.node); number && number->unit != Unit::angle)
    return Value::number(number->value, number->unit);
  if (depth_ >= max_expression_depth)
    return error(expr.span, "nested too deeply", "break it into parts with let");
  const Nested nested(*this);
  return std::visit(Dispatch{*this, tree, expr.span, scope}, expr.node);
}

Value Evaluator::evaluate_as(Type type, const SyntaxTree& tree, ExprId id,
                             const std::shared_ptr<Scope>& scope, std::string_view what, bool widen) {
  const Expr& expr = tree[id];
  if (type == Type::material)
    if (const auto* thing = std::get_if<ThingExpr>(&expr.node); thing && !thing->keyword.symbol.valid())
      return Dispatch{*this, tree, expr.span, scope}.unnamed_body(BodyKind::material, *thing);
  return convert(type, evaluate(tree, id, scope), expr.span, what, widen);
}

}  // namespace tyndall::eval
