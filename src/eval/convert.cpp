// From the type that was found to the type that is wanted.
#include <fmt/format.h>

#include "eval/evaluator.h"
#include "eval/operators.h"

namespace tyndall::eval {

// The way out of "wanted a, found b", or empty.
static std::string way_out(Type wanted, Type found, bool widen) {
  if (found == Type::image) return "look it up at a pair, for instance wood(uv)";
  if (found == Type::function) return "call it, with its arguments in ( )";
  if (wanted == Type::angle && found == Type::number)
    return "give the angle a unit, for instance 40deg or 0.7rad";
  if (wanted == Type::number && found == Type::angle) return "divide by 1rad or 1deg to get a number";
  if (wanted == Type::number && (found == Type::vec || found == Type::pair))
    return "choose a component, for instance v.x";
  if (wanted == Type::vec && found == Type::number)
    return widen ? "" : "write all three, for instance (0, 1, 0)";
  if (wanted == Type::vec && found == Type::pair) return "write three components";
  if (wanted == Type::boolean) return "compare first, for instance x > 0";
  if (wanted == Type::transform && found == Type::vec) return "write translate((x, y, z))";
  return {};
}

Value Evaluator::convert(Type type, const Value& value, Span span, std::string_view what, bool widen) {
  if (value.is_error()) return value;
  if (value.type == type) {
    if (type != Type::medium && type != Type::material) return value;
    const auto* body = value.get<Body>();
    if (!body || body->scope) return value;
    const std::optional<Body> with_defaults = bound(*body, span);
    return with_defaults ? Value::of_heavy(type, *with_defaults) : Value{};
  }
  if (widen && value.type == Type::number && (type == Type::vec || type == Type::pair)) {
    Value result = widened(type, value);
    result.unit = value.unit;
    return result;
  }
  return error(span, fmt::format("{} wants {}, found {}", what, describe(type), describe(value.type)),
               way_out(type, value.type, widen));
}

}  // namespace tyndall::eval
