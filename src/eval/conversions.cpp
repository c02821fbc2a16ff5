// From the type that was found to the type that is wanted.
#include <fmt/format.h>

#include <cmath>

#include "eval/evaluator.h"
#include "eval/operators.h"
#include "syntax/foreign_words.h"

namespace tyndall::eval {

using namespace syntax;

// What a text stands for that is no text here: a colour, or a word of another program; or nothing.
static std::string without_quotes(const std::string& text, bool value) {
  const std::string_view meant = value ? help_for_foreign_word(ForeignUse::value, text) : std::string_view{};
  if (!meant.empty()) return std::string(meant);
  const bool color = text.size() > 1 && text.size() < 10 && text.front() == '#';
  return fmt::format("write {} without quotes", color ? text : "it");
}

// The way out of "wanted a, found b", or empty.
static std::string way_out(Type wanted, const Value& value, bool widen) {
  const Type found = value.type;
  if (const auto* text = value.get<std::string>())
    return without_quotes(*text, wanted == Type::vec || wanted == Type::phase);
  if (wanted == Type::phase && found == Type::number) {
    const bool cosine = value.known() && std::abs(value.as_number()) < 1;
    return fmt::format("write hg({}): its mean cosine, above 0 for forward scattering",
                       cosine ? text_of(value) : "0.5");
  }
  if (wanted == Type::transform && found == Type::list)
    return "join transforms with '*', of which the last applies first: translate((0, 1, 0)) * "
           "rotate_y(30deg)";
  if (wanted == Type::transform && found == Type::angle) return "write rotate_y(30deg)";
  if (wanted == Type::transform && found == Type::number) return "write scale(2)";
  if (wanted == Type::vec && found == Type::list) return "a vec is written in parentheses: (x, y, z)";
  if (wanted == Type::pair && found == Type::list) return "a pair is written in parentheses: (x, y)";
  if (wanted == Type::list && (found == Type::vec || found == Type::pair)) return "a list is written [a, b]";
  if (wanted == Type::range) return "a range is written 1..48";
  if (wanted == Type::material && value.width() > 0) return "write material: { base_color = … }";
  if (wanted == Type::medium && value.width() > 0) return "write medium: { density = …  albedo = … }";
  if (wanted == Type::shape && found == Type::object) return "write the shape itself: in: sphere { … }";
  if (wanted == Type::shape && found == Type::medium) return "write in: sphere { … }, and medium: beside it";
  if (found == Type::image) return "look it up at a pair, for instance wood(uv)";
  if (found == Type::grid && wanted == Type::shape) return "write in: bounds(smoke)";
  if (found == Type::grid) return "look it up at a place, for instance smoke(p)";
  if (found == Type::function) return "call it, with its arguments in ( )";
  if (wanted == Type::angle && found == Type::number)
    return "give the angle a unit, for instance 40deg or 0.7rad";
  if (wanted == Type::number && found == Type::boolean) return "write if condition then 1 else 0";
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

std::string help_for_color(const Value& value) {
  if (const auto* text = value.get<std::string>()) return without_quotes(*text, true);
  return value.type == Type::list ? "a colour is written in parentheses: (r, g, b), or #ff8800"
                                  : "a number is that much in each of red, green and blue";
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
               way_out(type, value, widen));
}

}  // namespace tyndall::eval
