// Built-ins on vecs and others that are made of several operations.
#include <fmt/format.h>

#include <algorithm>

#include "base/numerics.h"
#include "eval/builtins/maker.h"
#include "eval/operators.h"

namespace tyndall::eval {

using vm::Op;

namespace {

// Both arguments as pairs, or both as vecs.
bool same_width(CallSite& site) {
  const Type a = site.arguments[0].type, b = site.arguments[1].type;
  if (a == b && (a == Type::pair || a == Type::vec)) return true;
  const std::size_t wrong = a == Type::pair || a == Type::vec ? 1 : 0;
  site.ev.error(site.spans[wrong], fmt::format("{} wants {}, found {}", site.what(wrong),
                                               wrong == 1 ? describe(a) : "a pair or a vec",
                                               describe(site.arguments[wrong].type)));
  return false;
}

bool is_pair_or_vec(CallSite& site, std::size_t i) {
  const Type found = site.arguments[i].type;
  if (found == Type::pair || found == Type::vec) return true;
  site.ev.error(site.spans[i],
                fmt::format("{} wants a pair or a vec, found {}", site.what(i), describe(found)));
  return false;
}

Value dot(CallSite& site) {
  return same_width(site) ? number(maker(site).dot(site.arguments[0], site.arguments[1])) : Value{};
}

Value distance(CallSite& site) {
  if (!same_width(site)) return {};
  const Maker m = maker(site);
  return number(m.length(m.subtract(site.arguments[0], site.arguments[1])));
}

Value cross(CallSite& site) {
  bool ok = true;
  const Value a = site.as(Type::vec, 0, ok), b = site.as(Type::vec, 1, ok);
  if (!ok) return {};
  const Maker m = maker(site);
  Value result = a;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    result.scalars[i] = m.sub(m.mul(a.scalars[j], b.scalars[k]), m.mul(a.scalars[k], b.scalars[j]));
  }
  return result;
}

Value normalize(CallSite& site) {
  if (!is_pair_or_vec(site, 0)) return {};
  const Maker m = maker(site);
  Value result = site.arguments[0];
  const Scalar length = m.length(result);
  if (!site.ev.in_body() && length.value == 0)
    return site.ev.error(site.spans[0], "a vec of length 0 has no direction");
  for (std::size_t i = 0; i < static_cast<std::size_t>(result.width()); ++i)
    result.scalars[i] = m.div(result.scalars[i], length);
  return result;
}

// v mirrored at the plane across the unit normal n: v - 2 dot(v, n) n.
Value reflect(CallSite& site) {
  if (!same_width(site)) return {};
  const Maker m = maker(site);
  const Value &v = site.arguments[0], &n = site.arguments[1];
  return m.subtract(v, m.scaled(n, m.mul(Scalar{2}, m.dot(v, n))));
}

// remap(x, a, b, c, d): what x in [a, b] is in [c, d], beyond the ends too. Componentwise.
Value remap(CallSite& site) {
  const Maker m = maker(site);
  Type type = Type::number;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::optional<Type> common = common_type(type, site.arguments[i].type);
    if (!common)
      return site.ev.error(site.spans[i],
                           fmt::format("{} wants a number, pair or vec as wide as the others, found {}",
                                       site.what(i), describe(site.arguments[i].type)));
    type = *common;
  }
  Value result = Value::of(type, {});
  for (std::size_t c = 0; c < static_cast<std::size_t>(result.width()); ++c) {
    std::array<Scalar, 5> s;
    for (std::size_t i = 0; i < 5; ++i) s[i] = widened(type, site.arguments[i]).scalars[c];
    const Scalar width = m.sub(s[2], s[1]);
    if (!site.ev.in_body() && width.value == 0)
      return site.ev.error(site.span, "remap from a range of no width");
    result.scalars[c] = m.add(s[3], m.mul(m.div(m.sub(s[0], s[1]), width), m.sub(s[4], s[3])));
  }
  return result;
}

Value luminance(CallSite& site) {
  bool ok = true;
  const Value c = site.as(Type::vec, 0, ok, true);
  return ok ? number(maker(site).dot(c, Value::vec({0.2126, 0.7152, 0.0722}))) : Value{};
}

Value blackbody(CallSite& site) {
  bool ok = true;
  const Value kelvin = site.as(Type::number, 0, ok);
  if (!ok) return {};
  if (kelvin.unit != syntax::Unit::none && kelvin.unit != syntax::Unit::temperature)
    return site.ev.error(site.spans[0], fmt::format("{} wants a temperature", site.what(0)),
                         "for instance 3200K");
  if (kelvin.known() && !(kelvin.as_number() > 0))
    return site.ev.error(site.spans[0], "a temperature must be greater than 0K", "for instance 3200K");
  const Maker m = maker(site);
  const Scalar k = kelvin.scalars[0];
  return Value::of(Type::vec,
                   {m.op(Op::blackbody_r, {k}), m.op(Op::blackbody_g, {k}), m.op(Op::blackbody_b, {k})});
}

// The linear colour of a component of sRGB (IEC 61966-2-1).
Scalar linear_of_srgb(const Maker& m, const Scalar& c) {
  const Scalar curve = m.op(Op::pow, {m.div(m.add(c, Scalar{0.055}), Scalar{1.055}), Scalar{2.4}});
  return m.op(Op::select, {m.op(Op::less_equal, {c, Scalar{0.04045}}), m.div(c, Scalar{12.92}), curve});
}

// As colour pickers have it: of sRGB. A channel is full within 60 degrees of its own hue, and falls to
// value (1 - saturation) over the next 60.
Value hsv(CallSite& site) {
  bool ok = true;
  const Scalar hue = site.as(Type::angle, 0, ok).scalars[0],
               saturation = site.as(Type::number, 1, ok).scalars[0],
               given = site.as(Type::number, 2, ok).scalars[0];
  if (!ok) return {};
  const Maker m = maker(site);
  const Scalar sixths = m.mul(hue, Scalar{3 / pi}), zero{0}, one{1};
  const Scalar value = m.max(given, zero), depth = m.mul(value, m.op(Op::saturate, {saturation}));
  Value result = Value::of(Type::vec, {});
  for (std::size_t i = 0; i < 3; ++i) {
    const Scalar k = m.op(Op::mod, {m.add(sixths, Scalar{5.0 - 2.0 * static_cast<double>(i)}), Scalar{6}});
    const Scalar part = m.max(zero, m.min(m.min(k, m.sub(Scalar{4}, k)), one));
    result.scalars[i] = linear_of_srgb(m, m.sub(value, m.mul(depth, part)));
  }
  return result;
}

Value checker(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::pair, 0, ok);
  return ok ? Value::of(Type::boolean, {maker(site).op(Op::checker, {p.scalars[0], p.scalars[1]})}) : Value{};
}

// A hash of any number of numbers, pairs and vecs: of four at a time, the hash so far going first.
Value random(CallSite& site) {
  std::vector<Scalar> parts;
  bool failed = false;
  for (const syntax::Argument& argument : site.written()) {
    const Span place = site.tree[argument.value].span;
    const Value v = site.ev.evaluate(site.tree, argument.value, site.scope);
    failed |= v.is_error();
    if (argument.name.symbol.valid()) {
      site.ev.error(argument.name.span, "the arguments of 'random' have no names", "write random(a, b)");
      failed = true;
    } else if (!v.is_error() && v.width() == 0) {
      site.ev.error(place, fmt::format("'random' wants numbers or vecs, found {}", describe(v.type)));
      failed = true;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(v.width()); ++i) parts.push_back(v.scalars[i]);
  }
  if (failed) return {};
  if (parts.empty())
    return site.ev.error(site.span, "'random' wants an argument",
                         "the same arguments give the same number: write random(i)");
  constexpr Op ops[] = {Op::random1, Op::random2, Op::random3, Op::random4};
  std::vector<Scalar> operands;
  for (std::size_t i = 0; i < parts.size();) {
    while (operands.size() < 4 && i < parts.size()) operands.push_back(parts[i++]);
    const Scalar hash = site.ev.emit(ops[operands.size() - 1], operands, site.span);
    operands.assign({hash});
  }
  return number(operands[0]);
}

}  // namespace

Handlers vector_handler(std::string_view name) {
  static constexpr std::pair<std::string_view, Value (*)(CallSite&)> handlers[] = {
      {"dot", dot},         {"distance", distance}, {"cross", cross},         {"normalize", normalize},
      {"reflect", reflect}, {"remap", remap},       {"luminance", luminance}, {"blackbody", blackbody},
      {"hsv", hsv},         {"checker", checker},   {"length", call_length}};
  if (name == "random") return {nullptr, random};
  for (const auto& [word, handler] : handlers)
    if (word == name) return {handler};
  return {};
}

}  // namespace tyndall::eval
