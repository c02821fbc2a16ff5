// keys(x, [k, v], …, ease: smooth): a value that passes through v where x is k.
#include <fmt/format.h>

#include "base/transform_mix.h"
#include "eval/calls.h"
#include "eval/operators.h"

namespace tyndall::eval {

using vm::Op;

namespace {

enum class Ease : std::uint8_t { linear, smooth, hold };

struct Keys {
  std::vector<double> positions;
  std::vector<Value> values;
  Ease ease = Ease::linear;
};

bool read_ease(CallSite& site, syntax::ExprId id, Ease& ease) {
  const syntax::Expr& expr = site.tree[id];
  constexpr std::pair<std::string_view, Ease> words[] = {
      {"linear", Ease::linear}, {"smooth", Ease::smooth}, {"hold", Ease::hold}};
  const auto* name = std::get_if<syntax::NameExpr>(&expr.node);
  const std::string_view written = name ? site.ev.text(name->symbol) : "";
  for (const auto& [word, value] : words)
    if (word == written) {
      ease = value;
      return true;
    }
  std::vector<std::string_view> known;
  for (const auto& row : words) known.push_back(row.first);
  const std::string guess = did_you_mean(written, known);
  site.ev.error(expr.span, name ? fmt::format("there is no ease '{}'", written) : "'ease' wants a word",
                guess.empty() ? "ease is linear, smooth or hold" : guess);
  return false;
}

// One position and its value; the positions must rise.
bool add_key(CallSite& site, const Value& position, const Value& value, Span span, Keys& keys) {
  if (!position.known()) {
    site.ev.error(span, "the positions of keys must be known when the scene is read");
    return false;
  }
  if (!keys.positions.empty() && !(position.as_number() > keys.positions.back())) {
    site.ev.error(span, fmt::format("keys must rise: {} follows {}", text_of(position),
                                    text_of(Value::number(keys.positions.back()))));
    return false;
  }
  keys.positions.push_back(position.as_number());
  keys.values.push_back(value);
  return true;
}

// A `[k, v]`.
bool read_key(CallSite& site, const Value& key, Span span, Keys& keys) {
  const bool is_key =
      key.type == Type::list && key.as_list().size() == 2 && key.as_list()[0].type == Type::number;
  if (is_key) return add_key(site, key.as_list()[0], key.as_list()[1], span, keys);
  site.ev.error(span, fmt::format("a key is a position and a value, found {}", describe(key.type)),
                "write [0s, a], [1s, b]");
  return false;
}

// A `[k, v]`, or a list of them.
bool read_keys(CallSite& site, syntax::ExprId id, Keys& keys) {
  const Span span = site.tree[id].span;
  const Value given = site.ev.evaluate(site.tree, id, site.scope);
  if (given.is_error()) return false;
  const bool many =
      given.type == Type::list && (given.as_list().empty() || given.as_list()[0].type == Type::list);
  if (!many) return read_key(site, given, span, keys);
  for (const Value& key : given.as_list())
    if (!read_key(site, key, span, keys)) return false;
  return true;
}

// The lists `points` and `values`, where they are given.
bool read_lists(CallSite& site, const syntax::Argument* points, const syntax::Argument* values, Keys& keys) {
  if (!points && !values) return true;
  if (!points || !values || !keys.values.empty()) {
    site.ev.error(points ? points->name.span : values->name.span,
                  !keys.values.empty() ? "keys are given as stops or as 'points' and 'values', not as both"
                                       : "'points' and 'values' are given together",
                  "write keys(x, points: [0, 1], values: [a, b])");
    return false;
  }
  const auto list = [&](const syntax::Argument& argument, std::string_view what) {
    return site.ev.evaluate_as(Type::list, site.tree, argument.value, site.scope, what);
  };
  const Value at = list(*points, "'points' of keys"), given = list(*values, "'values' of keys");
  if (at.is_error() || given.is_error()) return false;
  const Span span = site.tree[points->value].span;
  if (at.as_list().size() != given.as_list().size()) {
    site.ev.error(span, fmt::format("{} points and {} values", at.as_list().size(), given.as_list().size()),
                  "each point has one value");
    return false;
  }
  for (std::size_t i = 0; i < at.as_list().size(); ++i) {
    const Value& point = at.as_list()[i];
    if (point.type != Type::number) {
      site.ev.error(span, fmt::format("a point of keys is a number, found {}", describe(point.type)));
      return false;
    }
    if (!add_key(site, point, given.as_list()[i], span, keys)) return false;
  }
  return true;
}

// The type of all values; nothing after reporting values that have none in common.
std::optional<Type> value_type(CallSite& site, const Keys& keys) {
  Type type = keys.values[0].type;
  for (const Value& value : keys.values) {
    const std::optional<Type> common = common_type(type, value.type);
    if (common) type = *common;
    if (common || (type == value.type && (type == Type::angle || type == Type::transform))) continue;
    site.ev.error(site.span,
                  type == value.type
                      ? fmt::format("'keys' cannot pass from {} to {}", describe(type), describe(value.type))
                      : fmt::format("one key holds {}, another {}", describe(type), describe(value.type)),
                  "keys hold numbers, pairs, vecs, angles or transforms, all alike");
    return std::nullopt;
  }
  return type;
}

// How far x is from a to b: 0 before, 1 after.
Scalar progress(CallSite& site, const Scalar& x, double a, double b, Ease ease) {
  Evaluator& ev = site.ev;
  switch (ease) {
    case Ease::hold:
      return ev.emit(Op::step, {Scalar{b}, x}, site.span);
    case Ease::smooth:
      return ev.emit(Op::smoothstep, {Scalar{a}, Scalar{b}, x}, site.span);
    case Ease::linear:
      break;
  }
  const Scalar t =
      ev.emit(Op::mul, {ev.emit(Op::sub, {x, Scalar{a}}, site.span), Scalar{1 / (b - a)}}, site.span);
  return ev.emit(Op::clamp, {t, Scalar{0}, Scalar{1}}, site.span);
}

Value transform_at(CallSite& site, const Keys& keys, const Scalar& x) {
  if (!x.known())
    return site.ev.error(site.span, "a transform must be known when the scene is read",
                         "in a body turn and move points: rotate_y(p, keys(…))");
  std::size_t i = 0;
  while (i + 1 < keys.positions.size() && x.value >= keys.positions[i + 1]) ++i;
  if (i + 1 == keys.positions.size()) return keys.values[i];
  const double t = progress(site, x, keys.positions[i], keys.positions[i + 1], keys.ease).value;
  return Value::transform(mix(keys.values[i].as_transform(), keys.values[i + 1].as_transform(), t));
}

std::string help_for_parameter(std::string_view name) {
  const std::string guess = did_you_mean(name, {"ease", "points", "values"});
  return guess.empty() ? "write keys(x, [0, a], [1, b], ease: smooth)" : guess;
}

Value keys(CallSite& site) {
  Keys keys;
  Value x;
  bool failed = false, has_x = false;
  const syntax::Argument *points = nullptr, *values = nullptr;
  for (const syntax::Argument& argument : site.written()) {
    const std::string_view name =
        argument.name.symbol.valid() ? site.ev.text(argument.name.symbol) : std::string_view{};
    if (name == "points" || name == "values") {
      (name == "points" ? points : values) = &argument;
    } else if (argument.name.symbol.valid() && argument.name.symbol != site.ev.names().ease) {
      site.ev.error(argument.name.span, fmt::format("'keys' has no parameter '{}'", name),
                    help_for_parameter(name));
      failed = true;
    } else if (argument.name.symbol.valid()) {
      failed |= !read_ease(site, argument.value, keys.ease);
    } else if (!has_x) {
      has_x = true;
      x = site.ev.evaluate_as(Type::number, site.tree, argument.value, site.scope,
                              "the first argument of keys");
      failed |= x.is_error();
    } else {
      failed |= !read_keys(site, argument.value, keys);
    }
  }
  if (failed || !read_lists(site, points, values, keys)) return {};
  if (keys.values.empty())
    return site.ev.error(site.span, "'keys' wants a number and at least one key",
                         "write keys(time, [0s, a], [1s, b])");
  if (!x.known() && keys.values.size() > max_unrolled_iterations)
    return site.ev.error(
        site.span, fmt::format("{} keys at places that differ", keys.values.size()),
        fmt::format("in a body there are at most {}; a picture may hold more", max_unrolled_iterations));
  const std::optional<Type> type = value_type(site, keys);
  if (!type) return {};
  if (*type == Type::transform) return transform_at(site, keys, x.scalars[0]);
  // Every step from key to key is 0 before it and 1 after it, so one mix follows another.
  Value result = widened(*type, keys.values[0]);
  for (std::size_t i = 1; i < keys.values.size(); ++i) {
    const Scalar t = progress(site, x.scalars[0], keys.positions[i - 1], keys.positions[i], keys.ease);
    const Value next = widened(*type, keys.values[i]);
    if (next.unit != result.unit) result.unit = syntax::Unit::none;
    for (std::size_t c = 0; c < static_cast<std::size_t>(result.width()); ++c)
      result.scalars[c] = site.ev.emit(Op::mix, {result.scalars[c], next.scalars[c], t}, site.span);
  }
  return site.ev.finite(result, site.span);
}

}  // namespace

Handlers keys_handler(std::string_view name) {
  if (name == "keys") return {nullptr, keys};
  return {};
}

}  // namespace tyndall::eval
