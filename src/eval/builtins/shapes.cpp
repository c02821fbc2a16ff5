// Built-ins that the table describes wholly: an opcode and how arguments become its operands.
#include <fmt/format.h>

#include "eval/calls.h"
#include "eval/operators.h"

namespace tyndall::eval {

using vm::Op;

namespace {

// Built-ins of the componentwise shape that also take angles; mix takes them for its ends alone.
bool takes_angles(Op op) {
  return op == Op::min || op == Op::max || op == Op::mix || op == Op::clamp || op == Op::abs || op == Op::mod;
}

Value wrong_argument(CallSite& site, std::size_t i, std::string_view wanted) {
  const Type found = site.arguments[i].type;
  return site.ev.error(site.spans[i],
                       fmt::format("{} wants {}, found {}", site.what(i), wanted, describe(found)),
                       found == Type::angle ? "divide an angle by 1rad to get its number" : "");
}

// sin(30): as for rotate_y(30), nothing says whether degrees are meant. What is computed, sin(2 * pi * x), is
// in radians.
Value bare_angle(CallSite& site) {
  const Value& number = site.arguments[0];
  const bool bare = number.unit == syntax::Unit::none;
  return site.ev.error(
      site.spans[0],
      fmt::format("{} wants an angle, found {}", site.what(0),
                  bare ? "a number" : describe_unit(number.unit)),
      bare ? fmt::format("give the angle a unit: {0}({1}deg) or {0}({1}rad)", site.name(), text_of(number))
           : "an angle is written 30deg or 0.5rad");
}

}  // namespace

Value call_componentwise(CallSite& site) {
  const vm::Builtin& row = *site.entry.row;
  const std::size_t n = row.parameters.size();
  const Op op = row.op();
  // The last argument of mix is a weight: a number also between angles and phase functions.
  const std::size_t mixed = op == Op::mix ? n - 1 : n;
  if (op == Op::mix && site.arguments[0].type == Type::phase && site.arguments[1].type == Type::phase)
    return phase_handler("mix").bound(site);
  bool angles = takes_angles(op) && site.arguments[0].type == Type::angle;
  Type type = Type::number;
  for (std::size_t i = 0; i < n; ++i) {
    const Type found = site.arguments[i].type;
    if (angles && i < mixed) {
      if (found != Type::angle) return wrong_argument(site, i, "an angle like the others");
      continue;
    }
    const std::optional<Type> common = common_type(type, found);
    if (!common)
      return wrong_argument(site, i,
                            type == Type::number ? "a number, pair or vec" : "a value as wide as the others");
    type = *common;
  }
  if (angles && type != Type::number) return wrong_argument(site, n - 1, "a number");
  if (angles) type = Type::angle;
  Value result;
  result.type = type;
  if (type == Type::number) {
    result.unit = takes_angles(op) ? site.arguments[0].unit : syntax::Unit::none;
    for (std::size_t i = 0; i < mixed; ++i)
      if (site.arguments[i].unit != result.unit) result.unit = syntax::Unit::none;
  }
  std::array<Scalar, 4> operands;
  for (std::size_t c = 0; c < static_cast<std::size_t>(result.width()); ++c) {
    for (std::size_t i = 0; i < n; ++i)
      operands[i] = site.arguments[i].scalars[site.arguments[i].width() == 1 ? 0 : c];
    result.scalars[c] = site.ev.emit(op, std::span<const Scalar>(operands.data(), n), site.span);
  }
  return result;
}

Value call_angle_to_number(CallSite& site) {
  const Type found = site.arguments[0].type;
  if (found != Type::angle && found != Type::number)
    return wrong_argument(site, 0, "an angle or a number in radians");
  if (found == Type::number && is_literal(site.tree, site.written()[0].value)) return bare_angle(site);
  return Value::of(Type::number,
                   {site.ev.emit(site.entry.row->op(), {site.arguments[0].scalars[0]}, site.span)});
}

Value call_number_to_angle(CallSite& site) {
  const std::size_t n = site.entry.row->parameters.size();
  std::array<Scalar, 4> operands;
  bool ok = true;
  for (std::size_t i = 0; i < n; ++i) operands[i] = site.as(Type::number, i, ok).scalars[0];
  if (!ok) return {};
  return Value::of(Type::angle, {site.ev.emit(site.entry.row->op(),
                                              std::span<const Scalar>(operands.data(), n), site.span)});
}

Value call_length(CallSite& site) {
  const Value& v = site.arguments[0];
  if (v.type == Type::list) return Value::number(static_cast<double>(v.as_list().size()));
  if (v.type == Type::pair)
    return Value::of(Type::number, {site.ev.emit(Op::length2, {v.scalars[0], v.scalars[1]}, site.span)});
  if (v.type == Type::vec)
    return Value::of(Type::number,
                     {site.ev.emit(Op::length3, {v.scalars[0], v.scalars[1], v.scalars[2]}, site.span)});
  return wrong_argument(site, 0, "a pair, a vec or a list");
}

}  // namespace tyndall::eval
