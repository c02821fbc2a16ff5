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

// One `[k, v]`; the positions must rise.
bool read_key(CallSite& site, syntax::ExprId id, Keys& keys) {
  const Span span = site.tree[id].span;
  const Value key = site.ev.evaluate(site.tree, id, site.scope);
  if (key.is_error()) return false;
  const bool is_key =
      key.type == Type::list && key.as_list().size() == 2 && key.as_list()[0].type == Type::number;
  if (!is_key) {
    site.ev.error(span, fmt::format("a key is a position and a value, found {}", describe(key.type)),
                  "write [0s, a], [1s, b]");
    return false;
  }
  const Value& position = key.as_list()[0];
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
  keys.values.push_back(key.as_list()[1]);
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

Value keys(CallSite& site) {
  Keys keys;
  Value x;
  bool failed = false, has_x = false;
  for (const syntax::Argument& argument : site.written()) {
    if (argument.name.symbol.valid() && argument.name.symbol != site.ev.names().ease) {
      site.ev.error(argument.name.span,
                    fmt::format("'keys' has no parameter '{}'", site.ev.text(argument.name.symbol)),
                    nearest(site.ev.text(argument.name.symbol), {"ease"}).empty()
                        ? "write keys(x, [0, a], [1, b], ease: smooth)"
                        : "did you mean 'ease'?");
      failed = true;
    } else if (argument.name.symbol.valid()) {
      failed |= !read_ease(site, argument.value, keys.ease);
    } else if (!has_x) {
      has_x = true;
      x = site.ev.evaluate_as(Type::number, site.tree, argument.value, site.scope,
                              "the first argument of keys");
      failed |= x.is_error();
    } else {
      failed |= !read_key(site, argument.value, keys);
    }
  }
  if (failed) return {};
  if (keys.values.empty())
    return site.ev.error(site.span, "'keys' wants a number and at least one key",
                         "write keys(time, [0s, a], [1s, b])");
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
