// Values: making, reading, printing and comparing them.
#include "eval/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/check.h"

namespace tyndall::eval {

std::string_view describe(Type type) {
  switch (type) {
    case Type::error:
      return "an error";
    case Type::number:
      return "a number";
    case Type::boolean:
      return "true or false";
    case Type::angle:
      return "an angle";
    case Type::pair:
      return "a pair (x, y)";
    case Type::vec:
      return "a vec (x, y, z)";
    case Type::string:
      return "a string";
    case Type::transform:
      return "a transform";
    case Type::list:
      return "a list";
    case Type::range:
      return "a range";
    case Type::function:
      return "a function";
    case Type::phase:
      return "a phase function";
    case Type::shape:
      return "a shape";
    case Type::medium:
      return "a medium";
    case Type::material:
      return "a material";
    case Type::object:
      return "an object";
    case Type::image:
      return "an image";
    case Type::grid:
      return "a grid";
  }
  return {};
}

int Value::width() const {
  switch (type) {
    case Type::number:
    case Type::boolean:
    case Type::angle:
      return 1;
    case Type::pair:
      return 2;
    case Type::vec:
      return 3;
    case Type::error:
    case Type::string:
    case Type::transform:
    case Type::list:
    case Type::range:
    case Type::function:
    case Type::phase:
    case Type::shape:
    case Type::medium:
    case Type::material:
    case Type::object:
    case Type::image:
    case Type::grid:
      return 0;
  }
  return 0;
}

bool Value::known() const {
  for (const Scalar& scalar : scalars)
    if (!scalar.known()) return false;
  if (!parts_known) return false;
  if (const auto* lobes = get<std::vector<PhaseLobe>>())
    for (const PhaseLobe& lobe : *lobes)
      if (!lobe.weight.known() || !lobe.parameters[0].known() || !lobe.parameters[1].known()) return false;
  return true;
}

bool Value::holds_scope() const {
  return parts_hold_scopes || get<Function>() || get<Body>() || get<ShapeLiteral>() ||
         get<ObjectDefinition>();
}

Value Value::number(double v, syntax::Unit unit) {
  Value value;
  value.type = Type::number;
  value.unit = unit;
  value.scalars[0].value = v;
  return value;
}
Value Value::boolean(bool v) {
  Value value;
  value.type = Type::boolean;
  value.scalars[0].value = v ? 1 : 0;
  return value;
}
Value Value::angle(double radians) {
  Value value;
  value.type = Type::angle;
  value.scalars[0].value = radians;
  return value;
}
Value Value::pair(double x, double y) { return of(Type::pair, {Scalar{x}, Scalar{y}}); }
Value Value::vec(const Vec3d& v) { return of(Type::vec, {Scalar{v.x}, Scalar{v.y}, Scalar{v.z}}); }
Value Value::string(std::string v) { return of_heavy(Type::string, std::move(v)); }
Value Value::list(std::vector<Value> elements) {
  bool known = true, hold_scopes = false;
  std::uint16_t depth = 0;
  for (const Value& element : elements) {
    known = known && element.known();
    hold_scopes = hold_scopes || element.holds_scope();
    depth = std::max(depth, element.list_depth);
  }
  Value value = of_heavy(Type::list, std::move(elements));
  value.parts_known = known;
  value.parts_hold_scopes = hold_scopes;
  value.list_depth = static_cast<std::uint16_t>(depth + 1);
  return value;
}
Value Value::transform(const Transform& t) { return of_heavy(Type::transform, t); }
Value Value::of(Type type, const std::array<Scalar, 3>& scalars) {
  Value value;
  value.type = type;
  value.scalars = scalars;
  return value;
}

double Value::as_number() const {
  CHECK(width() == 1 && scalars[0].known());
  return scalars[0].value;
}
bool Value::as_bool() const {
  CHECK(type == Type::boolean && scalars[0].known());
  return scalars[0].value != 0;
}
Vec3d Value::as_vec() const {
  CHECK(type == Type::vec && known());
  return {scalars[0].value, scalars[1].value, scalars[2].value};
}
const std::string& Value::as_string() const {
  const auto* content = get<std::string>();
  CHECK(content != nullptr);
  return *content;
}
const Transform& Value::as_transform() const {
  const auto* content = get<Transform>();
  CHECK(content != nullptr);
  return *content;
}
const std::vector<Value>& Value::as_list() const {
  const auto* content = get<std::vector<Value>>();
  CHECK(content != nullptr);
  return *content;
}

static std::string text_of(double number) {
  std::string text = fmt::format("{}", number);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string text_of(const Value& value) {
  switch (value.type) {
    case Type::number:
      return text_of(value.scalars[0].value);
    case Type::boolean:
      return value.scalars[0].value != 0 ? "true" : "false";
    case Type::angle: {
      // Degrees, without the last digits that the way through radians spoils.
      const std::string degrees = fmt::format("{:.12g}", value.scalars[0].value * (180 / std::numbers::pi));
      return degrees + "deg";
    }
    case Type::pair:
      return fmt::format("({}, {})", text_of(value.scalars[0].value), text_of(value.scalars[1].value));
    case Type::vec:
      return fmt::format("({}, {}, {})", text_of(value.scalars[0].value), text_of(value.scalars[1].value),
                         text_of(value.scalars[2].value));
    case Type::string:
      return value.as_string();
    case Type::list: {
      std::string text;
      append_text(text, value, std::string::npos);
      return text;
    }
    case Type::error:
    case Type::transform:
    case Type::range:
    case Type::function:
    case Type::phase:
    case Type::shape:
    case Type::medium:
    case Type::material:
    case Type::object:
    case Type::image:
    case Type::grid:
      return std::string(describe(value.type));
  }
  return {};
}

void Value::set_own_entry(std::size_t place, Value entry) {
  CHECK(type == Type::list && heavy.use_count() == 1 && list_depth > entry.list_depth);
  parts_known &= entry.known();
  parts_hold_scopes |= entry.holds_scope();
  // Made as a plain Heavy (of_heavy), and nobody else sees it.
  auto& entries = std::get<std::vector<Value>>(const_cast<Heavy&>(*heavy));
  entries[place] = std::move(entry);
}

std::string text_of(const Value& value, const syntax::NumberFormat& format) {
  const auto number = [&](double x) {
    std::string text = format.decimals ? fmt::format("{:.{}f}", x, int{*format.decimals}) : text_of(x);
    if (text.find_first_not_of("-0.") == std::string::npos && text.starts_with('-'))
      text.erase(0, 1);  // no -0
    const bool negative = text.starts_with('-');
    if (text.size() < format.width) text.insert(negative ? 1 : 0, format.width - text.size(), '0');
    return text;
  };
  const auto& s = value.scalars;
  switch (value.type) {
    case Type::number:
      return number(s[0].value);
    case Type::angle:
      return number(s[0].value * (180 / std::numbers::pi)) + "deg";
    case Type::pair:
      return fmt::format("({}, {})", number(s[0].value), number(s[1].value));
    case Type::vec:
      return fmt::format("({}, {}, {})", number(s[0].value), number(s[1].value), number(s[2].value));
    default:
      return text_of(value);
  }
}

bool append_text(std::string& text, const Value& value, std::size_t most) {
  if (value.type != Type::list) {
    if (value.type == Type::string && value.as_string().size() > most) return false;
    text += text_of(value);
    return text.size() <= most;
  }
  text += '[';
  bool first = true;
  for (const Value& element : value.as_list()) {
    if (!first) text += ", ";
    first = false;
    if (!append_text(text, element, most)) return false;
  }
  text += ']';
  return text.size() <= most;
}

}  // namespace tyndall::eval
