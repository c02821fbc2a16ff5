// Values: making, reading, printing and comparing them.
#include "eval/value.h"

#include <fmt/format.h>

#include <bit>
#include <numbers>

#include "base/check.h"
#include "eval/scope.h"

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
  if (const auto* list = get<std::vector<Value>>())
    for (const Value& element : *list)
      if (!element.known()) return false;
  if (const auto* lobes = get<std::vector<PhaseLobe>>())
    for (const PhaseLobe& lobe : *lobes)
      if (!lobe.weight.known() || !lobe.parameters[0].known() || !lobe.parameters[1].known()) return false;
  return true;
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
      std::string text = "[";
      for (const Value& element : value.as_list()) {
        if (text.size() > 1) text += ", ";
        text += text_of(element);
      }
      return text + "]";
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

static void append_number(std::string& key, double number) {
  fmt::format_to(std::back_inserter(key), "{:x},", std::bit_cast<std::uint64_t>(number + 0.0));
}

static void append_vec(std::string& key, const Vec3d& v) {
  for (std::size_t i = 0; i < 3; ++i) append_number(key, v[i]);
}

// A definition and the scope it stands in. Definitions keep their scopes for the whole run (Evaluator::bind),
// so equal addresses are the same scope.
static void append_definition(std::string& key, const Span& span, const Scope* scope) {
  fmt::format_to(std::back_inserter(key), "{}:{}@{},", span.source.index, span.begin,
                 fmt::ptr(static_cast<const void*>(scope)));
}

void append_key(std::string& key, const Value& value) {
  fmt::format_to(std::back_inserter(key), "{}~", static_cast<int>(value.type));
  for (int i = 0; i < value.width(); ++i)
    append_number(key, value.scalars[static_cast<std::size_t>(i)].value);
  if (!value.heavy) return;
  if (const auto* text = value.get<std::string>()) {
    fmt::format_to(std::back_inserter(key), "{}:{},", text->size(), *text);
  } else if (const auto* t = value.get<Transform>()) {
    for (const Vec3d& column : {t->x, t->y, t->z, t->t}) append_vec(key, column);
  } else if (const auto* list = value.get<std::vector<Value>>()) {
    fmt::format_to(std::back_inserter(key), "{}[", list->size());
    for (const Value& element : *list) append_key(key, element);
  } else if (const auto* range = value.get<RangeValue>()) {
    append_vec(key, {range->first, range->last, range->step});
    key += range->excludes_last ? '<' : '.';
  } else if (const auto* function = value.get<Function>()) {
    append_definition(key, function->item->span, function->scope.get());
  } else if (const auto* body = value.get<Body>()) {
    key += body->key;
  } else if (const auto* lobes = value.get<std::vector<PhaseLobe>>()) {
    for (const PhaseLobe& lobe : *lobes) {
      key += static_cast<char>('a' + static_cast<int>(lobe.kind));
      append_vec(key, {lobe.parameters[0].value, lobe.parameters[1].value, lobe.weight.value});
    }
  } else if (const auto* shape = value.get<ShapeLiteral>()) {
    append_definition(key, shape->span, shape->scope.get());
  } else if (const auto* object = value.get<ObjectDefinition>()) {
    append_definition(key, object->item->name.span, object->scope.get());
  } else if (const auto* image = value.get<Image>()) {
    fmt::format_to(std::back_inserter(key), "{}:{}:{},", image->path.size(), image->path, image->channel);
    append_vec(key, image->factor);
  }
}

}  // namespace tyndall::eval
