// Operators on values.
#include "eval/operators.h"

#include "eval/lists.h"

#include <fmt/format.h>

#include <cmath>

namespace tyndall::eval {

using syntax::BinaryOp;
using syntax::Unit;
using vm::Op;

namespace {

bool is_comparison(BinaryOp op) {
  switch (op) {
    case BinaryOp::less:
    case BinaryOp::less_equal:
    case BinaryOp::greater:
    case BinaryOp::greater_equal:
    case BinaryOp::equal:
    case BinaryOp::not_equal:
      return true;
    case BinaryOp::add:
    case BinaryOp::subtract:
    case BinaryOp::multiply:
    case BinaryOp::divide:
    case BinaryOp::power:
    case BinaryOp::logical_and:
    case BinaryOp::logical_or:
      return false;
  }
  return false;
}

Op opcode(BinaryOp op) {
  switch (op) {
    case BinaryOp::add:
      return Op::add;
    case BinaryOp::subtract:
      return Op::sub;
    case BinaryOp::multiply:
      return Op::mul;
    case BinaryOp::divide:
      return Op::div;
    case BinaryOp::power:
      return Op::pow;
    case BinaryOp::less:
    case BinaryOp::greater:
      return Op::less;
    case BinaryOp::less_equal:
    case BinaryOp::greater_equal:
      return Op::less_equal;
    case BinaryOp::equal:
      return Op::equal;
    case BinaryOp::not_equal:
      return Op::not_equal;
    case BinaryOp::logical_and:
      return Op::logical_and;
    case BinaryOp::logical_or:
      return Op::logical_or;
  }
  return Op::copy;
}

// The type of `a op b` for + - * / ^ of numbers, vecs and angles; nothing where the language has none.
std::optional<Type> arithmetic_type(BinaryOp op, Type a, Type b) {
  if (const std::optional<Type> common = common_type(a, b)) return common;
  if (a != Type::angle && b != Type::angle) return std::nullopt;
  const bool sum = op == BinaryOp::add || op == BinaryOp::subtract;
  if (a == Type::angle && b == Type::angle) {
    if (sum) return Type::angle;
    if (op == BinaryOp::divide) return Type::number;
    return std::nullopt;
  }
  if ((a == Type::angle ? b : a) != Type::number) return std::nullopt;
  if (sum) return Type::number;
  if (op == BinaryOp::multiply || (op == BinaryOp::divide && a == Type::angle)) return Type::angle;
  return std::nullopt;
}

// The unit of the result; reports two units that do not add or compare.
std::optional<Unit> result_unit(Evaluator& ev, BinaryOp op, const Value& a, const Value& b,
                                const OperatorSpans& at) {
  if (a.unit == b.unit) {
    const bool sum = op == BinaryOp::add || op == BinaryOp::subtract;
    return sum ? a.unit : Unit::none;
  }
  if (op == BinaryOp::multiply)
    return a.unit == Unit::none ? b.unit : b.unit == Unit::none ? a.unit : Unit::none;
  if (op == BinaryOp::divide) return b.unit == Unit::none ? a.unit : Unit::none;
  if (op == BinaryOp::power || a.unit == Unit::none || b.unit == Unit::none) return Unit::none;
  ev.error(at.whole,
           fmt::format("'{}' of {} and {}", spelling(op), describe_unit(a.unit), describe_unit(b.unit)),
           "both sides must measure the same");
  return std::nullopt;
}

Value wrong_operands(Evaluator& ev, BinaryOp op, const Value& a, const Value& b, const OperatorSpans& at) {
  std::string help;
  const bool angles = a.type == Type::angle || b.type == Type::angle;
  if (a.type == Type::string || b.type == Type::string)
    help = "values are put into strings with braces: \"leaf{i}.png\"";
  else if (angles && (a.type == Type::number || b.type == Type::number || a.type == b.type))
    help = "divide an angle by 1rad to get its number";
  else if ((a.type == Type::boolean && b.width() > 0) || (b.type == Type::boolean && a.width() > 0))
    help = "write if condition then 1 else 0 for a number";
  else if (common_type(a.type, a.type) && common_type(b.type, b.type))
    help = "choose components, for instance v.xy";
  else if (a.type == Type::transform || b.type == Type::transform)
    help = "a transform may be multiplied with a transform or a vec on its right";
  else if (a.type == Type::list || b.type == Type::list)
    help = op == BinaryOp::add ? "an entry is added in brackets: list + [x]"
                               : "make a list of results: [x * 2 for x in list]";
  else if (a.type == Type::function || b.type == Type::function)
    help = "a function must be called, with its arguments in ( )";
  return ev.error(at.whole,
                  fmt::format("'{}' of {} and {}", spelling(op), describe(a.type), describe(b.type)), help);
}

Value compared(Evaluator& ev, BinaryOp op, const Value& a, const Value& b, const OperatorSpans& at) {
  const bool equality = op == BinaryOp::equal || op == BinaryOp::not_equal;
  if (equality && a.type == Type::string && b.type == Type::string)
    return Value::boolean((a.as_string() == b.as_string()) == (op == BinaryOp::equal));
  const int width = a.width();
  const bool scalars = width == 1 && b.width() == 1 && (a.type == Type::boolean) == (b.type == Type::boolean);
  const bool same = a.type == b.type && width > 0;
  if (equality ? !(scalars || same) : !scalars || a.type == Type::boolean)
    return wrong_operands(ev, op, a, b, at);
  if (!result_unit(ev, op, a, b, at)) return {};
  const bool swap = op == BinaryOp::greater || op == BinaryOp::greater_equal;
  Scalar result =
      ev.emit(opcode(op), {swap ? b.scalars[0] : a.scalars[0], swap ? a.scalars[0] : b.scalars[0]}, at.whole);
  const Op join = op == BinaryOp::equal ? Op::logical_and : Op::logical_or;
  for (std::size_t i = 1; i < static_cast<std::size_t>(width); ++i)
    result = ev.emit(join, {result, ev.emit(opcode(op), {a.scalars[i], b.scalars[i]}, at.whole)}, at.whole);
  return Value::of(Type::boolean, {result});
}

// Known plain numbers, the common case in scene code.
double compute(BinaryOp op, double a, double b) {
  switch (op) {
    case BinaryOp::add:
      return a + b;
    case BinaryOp::subtract:
      return a - b;
    case BinaryOp::multiply:
      return a * b;
    case BinaryOp::divide:
      return a / b;
    case BinaryOp::power:
      return std::pow(a, b);
    case BinaryOp::less:
      return a < b;
    case BinaryOp::less_equal:
      return a <= b;
    case BinaryOp::greater:
      return a > b;
    case BinaryOp::greater_equal:
      return a >= b;
    case BinaryOp::equal:
      return a == b;
    case BinaryOp::not_equal:
      return a != b;
    case BinaryOp::logical_and:
      return a != 0 && b != 0;
    case BinaryOp::logical_or:
      return a != 0 || b != 0;
  }
  return 0;
}

// Reports a known zero below a division in scene code.
bool divides_by_zero(Evaluator& ev, const Value& divisor, Span span) {
  if (ev.in_body()) return false;
  for (int i = 0; i < divisor.width(); ++i)
    if (divisor.scalars[static_cast<std::size_t>(i)].value == 0) {
      ev.error(span, "division by zero", "this is 0 here");
      return true;
    }
  return false;
}

}  // namespace

std::string_view describe_unit(Unit unit) {
  switch (unit) {
    case Unit::none:
      return "a plain number";
    case Unit::length:
      return "a length";
    case Unit::time:
      return "a time";
    case Unit::temperature:
      return "a temperature";
    case Unit::angle:
      return "an angle";
  }
  return {};
}

std::optional<Type> common_type(Type a, Type b) {
  if (!is_numeric(a) || !is_numeric(b)) return std::nullopt;
  if (a == b || b == Type::number) return a;
  if (a == Type::number) return b;
  return std::nullopt;
}

Value widened(Type type, const Value& value) {
  if (value.type == type) return value;
  const Scalar s = value.scalars[0];
  return type == Type::pair ? Value::of(type, {s, s}) : Value::of(type, {s, s, s});
}

Scalar product(Evaluator& ev, const Scalar& a, const Scalar& b, Span span) {
  if (a.known() && a.value == 1) return b;
  if (b.known() && b.value == 1) return a;
  if ((a.known() && a.value == 0) || (b.known() && b.value == 0)) return Scalar{0};
  return ev.emit(Op::mul, {a, b}, span);
}

Scalar sum(Evaluator& ev, const Scalar& a, const Scalar& b, Span span) {
  if (a.known() && a.value == 0) return b;
  if (b.known() && b.value == 0) return a;
  return ev.emit(Op::add, {a, b}, span);
}

Scalar difference(Evaluator& ev, const Scalar& a, const Scalar& b, Span span) {
  if (b.known() && b.value == 0) return a;
  return ev.emit(Op::sub, {a, b}, span);
}

Value transformed(Evaluator& ev, const Transform& t, const Value& v, bool translates, Span span) {
  std::array<Scalar, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    Scalar s = product(ev, v.scalars[0], Scalar{t.x[i]}, span);
    s = sum(ev, s, product(ev, v.scalars[1], Scalar{t.y[i]}, span), span);
    s = sum(ev, s, product(ev, v.scalars[2], Scalar{t.z[i]}, span), span);
    result[i] = translates ? sum(ev, s, Scalar{t.t[i]}, span) : s;
  }
  return Value::of(Type::vec, result);
}

Value negated(Evaluator& ev, const Value& value, Span span) {
  if (value.is_error()) return {};
  const int width = value.width();
  if (width == 0 || value.type == Type::boolean)
    return ev.error(span,
                    fmt::format("'-' wants a number, an angle or a vec, found {}", describe(value.type)));
  Value result = value;
  for (std::size_t i = 0; i < static_cast<std::size_t>(width); ++i)
    result.scalars[i] = ev.emit(Op::neg, {value.scalars[i]}, span);
  return result;
}

Value inverted(Evaluator& ev, const Value& value, Span span) {
  if (value.is_error()) return {};
  if (value.type != Type::boolean)
    return ev.error(span, fmt::format("'not' wants true or false, found {}", describe(value.type)),
                    "compare first, for instance not (x > 0)");
  return Value::of(Type::boolean, {ev.emit(Op::logical_not, {value.scalars[0]}, span)});
}

Value binary(Evaluator& ev, BinaryOp op, const Value& a, const Value& b, const OperatorSpans& at) {
  if (a.is_error() || b.is_error()) return {};
  if (op == BinaryOp::divide && divides_by_zero(ev, b, at.right)) return {};
  if (op == BinaryOp::logical_and || op == BinaryOp::logical_or) {
    if (a.type != Type::boolean || b.type != Type::boolean) return wrong_operands(ev, op, a, b, at);
    return Value::of(Type::boolean, {ev.emit(opcode(op), {a.scalars[0], b.scalars[0]}, at.whole)});
  }
  const bool plain =
      a.type == Type::number && b.type == Type::number && a.unit == b.unit && a.unit == Unit::none;
  if (plain && a.scalars[0].known() && b.scalars[0].known()) {
    const double result = compute(op, a.scalars[0].value, b.scalars[0].value);
    if (is_comparison(op)) return Value::boolean(result != 0);
    return ev.finite(Value::number(result), at.whole, op == BinaryOp::power ? "pow" : "");
  }
  if (is_comparison(op)) return compared(ev, op, a, b, at);
  if (op == BinaryOp::multiply && a.type == Type::transform) {
    if (b.type == Type::transform) return Value::transform(a.as_transform() * b.as_transform());
    if (b.type == Type::vec) return transformed(ev, a.as_transform(), b, true, at.whole);
  }
  if (op == BinaryOp::add && a.type == Type::list && b.type == Type::list)
    return joined_lists(ev, a, b, at.whole);
  if (op == BinaryOp::multiply && a.type == Type::image && b.type != Type::image)
    return scaled_image(ev, a, b, at.whole);
  if (op == BinaryOp::multiply && b.type == Type::image && a.type != Type::image)
    return scaled_image(ev, b, a, at.whole);
  const std::optional<Type> type = arithmetic_type(op, a.type, b.type);
  if (!type) return wrong_operands(ev, op, a, b, at);
  const std::optional<Unit> unit = result_unit(ev, op, a, b, at);
  if (!unit) return {};
  const bool widens = *type == Type::pair || *type == Type::vec;
  const Value left = widens ? widened(*type, a) : a, right = widens ? widened(*type, b) : b;
  Value result;
  result.type = *type;
  result.unit = *type == Type::angle ? Unit::none : *unit;
  for (std::size_t i = 0; i < static_cast<std::size_t>(result.width()); ++i)
    result.scalars[i] = ev.emit(opcode(op), {left.scalars[i], right.scalars[i]}, at.whole);
  return ev.finite(result, at.whole);
}

Value mixed_phases(Evaluator& ev, const Value& a, const Value& b, const Scalar& weight_of_b, Span span) {
  std::vector<PhaseLobe> lobes;
  const Scalar weight_of_a = ev.emit(Op::sub, {Scalar{1}, weight_of_b}, span);
  const auto append = [&](const Value& from, const Scalar& weight) {
    for (PhaseLobe lobe : *from.get<std::vector<PhaseLobe>>()) {
      lobe.weight = product(ev, lobe.weight, weight, span);
      if (!lobe.weight.known() || lobe.weight.value > 0) lobes.push_back(lobe);
    }
  };
  append(a, weight_of_a);
  append(b, weight_of_b);
  return Value::of_heavy(Type::phase, std::move(lobes));
}

Value select(Evaluator& ev, const Scalar& condition, const Value& a, const Value& b, Span span) {
  if (a.is_error() || b.is_error()) return {};
  if (a.type == Type::phase && b.type == Type::phase) {
    const Scalar b_is_taken = ev.emit(Op::logical_not, {condition}, span);
    return mixed_phases(ev, a, b, b_is_taken, span);
  }
  const std::optional<Type> common =
      a.type == b.type && a.width() > 0 ? std::optional(a.type) : common_type(a.type, b.type);
  if (!common) {
    if (a.type != b.type)
      return ev.error(span,
                      fmt::format("one branch gives {}, the other {}", describe(a.type), describe(b.type)),
                      "both must give the same kind of value, for the condition differs from place to place");
    return ev.error(
        span,
        fmt::format("the condition differs from place to place, so it cannot choose {}", describe(a.type)),
        "use a condition that does not depend on p");
  }
  const Value left = widened(*common, a), right = widened(*common, b);
  Value result = left;
  if (left.unit != right.unit) result.unit = Unit::none;
  for (std::size_t i = 0; i < static_cast<std::size_t>(left.width()); ++i)
    result.scalars[i] = ev.emit(Op::select, {condition, left.scalars[i], right.scalars[i]}, span);
  return result;
}

}  // namespace tyndall::eval
