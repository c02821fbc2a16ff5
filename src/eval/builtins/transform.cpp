// Built-ins that make transforms, and rotations of points.
#include <fmt/format.h>

#include "eval/calls.h"
#include "eval/operators.h"

namespace tyndall::eval {

namespace {

// False after reporting an argument that differs from place to place.
bool all_known(CallSite& site, std::string_view help) {
  for (std::size_t i = 0; i < site.entry.row->parameters.size(); ++i)
    if (site.given[i] && !site.arguments[i].known()) {
      site.ev.error(site.spans[i], fmt::format("{} must be known when the scene is read", site.what(i)),
                    std::string(help));
      return false;
    }
  return true;
}

Value translate(CallSite& site) {
  bool ok = true;
  const Value v = site.as(Type::vec, 0, ok);
  if (!ok || !all_known(site, "to move a point in a body, write p + offset")) return {};
  return Value::transform(Transform::translate(v.as_vec()));
}

Value scale(CallSite& site) {
  bool ok = true;
  const Value v = site.as(Type::vec, 0, ok, true);
  if (!ok || !all_known(site, "to scale a point in a body, write p * factors")) return {};
  return Value::transform(Transform::scale(v.as_vec()));
}

// rotate_y(angle), or rotate_y(p, angle), which turns a point.
template <int axis>
Value rotate_axis(CallSite& site) {
  const auto written = site.written();
  const bool turns_point = written.size() == 2;
  if (written.size() != 1 && written.size() != 2)
    return site.ev.error(site.span, fmt::format("'{}' with {} arguments", site.name(), written.size()),
                         fmt::format("write {0}(angle), or {0}(p, angle) to turn a point", site.name()));
  Value point, angle;
  for (std::size_t i = 0; i < written.size(); ++i) {
    std::string_view word = i + 1 == written.size() ? "angle" : "p";
    if (written[i].name.symbol.valid()) word = site.ev.text(written[i].name.symbol);
    if (word != "angle" && (word != "p" || !turns_point))
      return site.ev.error(written[i].name.span, fmt::format("'{}' has no parameter '{}'", site.name(), word),
                           "it takes p, angle");
    Value& target = word == "angle" ? angle : point;
    const bool is_angle = word == "angle";
    target = site.ev.evaluate_as(is_angle ? Type::angle : Type::vec, site.tree, written[i].value, site.scope,
                                 fmt::format("'{}' of {}", word, site.name()));
  }
  if (angle.is_error() || (turns_point && point.is_error())) return {};
  if (!turns_point) {
    if (!angle.known())
      return site.ev.error(site.span, "a transform must be known when the scene is read",
                           fmt::format("to turn a point in a body, write {}(p, angle)", site.name()));
    Vec3d direction;
    direction[axis] = 1;
    return Value::transform(Transform::rotate(direction, angle.as_number()));
  }
  Evaluator& ev = site.ev;
  const Scalar s = ev.emit(vm::Op::sin, {angle.scalars[0]}, site.span);
  const Scalar c = ev.emit(vm::Op::cos, {angle.scalars[0]}, site.span);
  constexpr std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
  const Scalar pa = point.scalars[a], pb = point.scalars[b];
  Value result = point;
  result.scalars[a] = difference(ev, product(ev, pa, c, site.span), product(ev, pb, s, site.span), site.span);
  result.scalars[b] = sum(ev, product(ev, pa, s, site.span), product(ev, pb, c, site.span), site.span);
  return ev.finite(result, site.span);
}

Value rotate(CallSite& site) {
  bool ok = true;
  const Value axis = site.as(Type::vec, 0, ok), angle = site.as(Type::angle, 1, ok);
  if (!ok || !all_known(site, "to turn a point in a body, write rotate_y(p, angle)")) return {};
  if (length(axis.as_vec()) == 0)
    return site.ev.error(site.spans[0], "an axis of length 0", "for instance (0, 1, 0)");
  return Value::transform(Transform::rotate(axis.as_vec(), angle.as_number()));
}

Value look_at(CallSite& site) {
  bool ok = true;
  const Value from = site.as(Type::vec, 0, ok), to = site.as(Type::vec, 1, ok);
  const Value up = site.given[2] ? site.as(Type::vec, 2, ok) : Value::vec({0, 1, 0});
  if (!ok || !all_known(site, "")) return {};
  const std::optional<Transform> t = Transform::look_at(from.as_vec(), to.as_vec(), up.as_vec());
  if (!t)
    return site.ev.error(
        site.span, "look_at has no direction",
        from.as_vec() == to.as_vec() ? "from and to are the same point" : "up points along the view");
  return Value::transform(*t);
}

// Four columns: the images of the axes, then of the origin.
Value matrix(CallSite& site) {
  bool ok = true;
  std::array<Vec3d, 4> columns{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!site.given[i]) continue;
    const Value column = site.as(Type::vec, i, ok);
    if (!ok || !all_known(site, "")) return {};
    columns[i] = column.as_vec();
  }
  return Value::transform({columns[0], columns[1], columns[2], columns[3]});
}

Value direction(CallSite& site) {
  bool ok = true;
  const Value t = site.as(Type::transform, 0, ok), v = site.as(Type::vec, 1, ok);
  return ok ? transformed(site.ev, t.as_transform(), v, false, site.span) : Value{};
}

}  // namespace

Handlers transform_handler(std::string_view name) {
  if (name == "translate") return {translate};
  if (name == "scale") return {scale};
  if (name == "rotate_x") return {nullptr, rotate_axis<0>};
  if (name == "rotate_y") return {nullptr, rotate_axis<1>};
  if (name == "rotate_z") return {nullptr, rotate_axis<2>};
  if (name == "rotate") return {rotate};
  if (name == "look_at") return {look_at};
  if (name == "matrix") return {matrix};
  if (name == "direction") return {direction};
  return {};
}

}  // namespace tyndall::eval
