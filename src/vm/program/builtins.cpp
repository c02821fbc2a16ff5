// The rows of the table of built-ins.
#include "vm/program/builtins.h"

#include <algorithm>
#include <array>

namespace tyndall::vm {

namespace {

using enum Shape;
using Parameters = std::vector<BuiltinParameter>;

constexpr std::string_view numbers = "number|pair|vec";
constexpr std::string_view quantities = "number|angle|pair|vec";

Builtin row(std::string_view name, Shape shape, std::vector<Op> ops, Parameters parameters,
            std::string_view result, std::string_view documentation, std::string_view example) {
  return {name, shape, std::move(ops), std::move(parameters), result, documentation, example, true};
}
Builtin sine(std::string_view name, std::vector<Op> ops, std::string_view documentation,
             std::string_view example) {
  return row(name, angle_to_number, std::move(ops), {{"angle", "angle|number", ""}}, "number", documentation,
             example);
}
Builtin other(std::string_view name, Parameters parameters, std::string_view result,
              std::string_view documentation, std::string_view example) {
  return row(name, custom, {}, std::move(parameters), result, documentation, example);
}
Builtin turn(std::string_view name, std::string_view documentation, std::string_view example) {
  return other(name, {{"p", "vec", ""}, {"angle", "angle", ""}}, "transform|vec", documentation, example);
}
Builtin scene_only(std::string_view name, Parameters parameters, std::string_view result,
                   std::string_view documentation, std::string_view example) {
  Builtin builtin = other(name, std::move(parameters), result, documentation, example);
  builtin.in_bodies = false;
  return builtin;
}

// The parameters of fields.
constexpr bool named = true;
const Parameters one = {{"p", "vec", ""}, {"time", "number", "", named}, {"seed", "number", "0", named}};
const Parameters many = {{"p", "vec", ""},
                         {"time", "number", "", named},
                         {"octaves", "number", "5", named},
                         {"seed", "number", "0", named}};

std::vector<Builtin> make_rows() {
  std::vector<Builtin> rows = {
#define TYNDALL_BUILTIN(...) __VA_ARGS__,
#include "vm/program/operations.inc"
#define TYNDALL_BUILTIN(...) __VA_ARGS__,
#include "vm/program/functions.inc"
  };
  std::sort(rows.begin(), rows.end(), [](const Builtin& a, const Builtin& b) { return a.name < b.name; });
  return rows;
}

}  // namespace

std::span<const Builtin> builtins() {
  static const std::vector<Builtin> rows = make_rows();
  return rows;
}

const Builtin* find_builtin(std::string_view name) {
  const std::span<const Builtin> rows = builtins();
  const auto found = std::lower_bound(rows.begin(), rows.end(), name,
                                      [](const Builtin& a, std::string_view b) { return a.name < b; });
  return found != rows.end() && found->name == name ? &*found : nullptr;
}

}  // namespace tyndall::vm
