// The built-in functions: name, parameters, meaning, documentation, operation. The rows stand in
// operations.inc and functions.inc. From a row come overloads, "did you mean", folding, listings, the
// manual's entry, editor completion and the tests at awkward arguments.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "vm/program/op.h"

namespace tyndall::vm {

// How a call's arguments become operands.
enum class Shape : std::uint8_t {
  componentwise,  // numbers, pairs or vecs, numbers widened: the op per component; result as wide as the
                  // widest (min max mix clamp abs mod also take angles, all of them or none of the selectable
                  // ones)
  angle_to_number,  // sin cos tan: of an angle or a number in radians
  number_to_angle,  // asin acos atan atan2: an angle
  length,           // of a pair or vec. ops: of a pair, of a vec
  field,            // a point, then options by name: `time`, `octaves`, `seed`. A number.
                    // ops: without a time, with one
  vector_field,     // curl: as field, a vec. ops: x, y, z without a time, then with one
  custom,  // the evaluator knows it by name (dot cross normalize reflect distance rotate_x … keys random
           // remap luminance blackbody sd_* smooth_union length-of-list checker …), built of other ops
};

struct BuiltinParameter {
  std::string_view name;
  std::string_view type;           // as the manual writes it: "number", "vec", "number|vec", "angle"
  std::string_view default_value;  // as written in a scene; empty: required
  bool named = false;              // an option that a call gives by its name, never by its place
};

struct Builtin {
  std::string_view name;
  Shape shape;
  std::vector<Op> ops;  // that it becomes, by its shape; none for custom
  std::vector<BuiltinParameter> parameters;
  std::string_view result;         // as the manual writes it
  std::string_view documentation;  // one or two sentences, with ranges
  std::string_view example;        // an expression that must evaluate
  bool in_bodies = true;           // false: scene code only (translate, look_at, …)

  Op op() const { return ops.empty() ? Op::copy : ops.front(); }
};

// All rows, sorted by name.
std::span<const Builtin> builtins();
// The row of that name or nullptr.
const Builtin* find_builtin(std::string_view name);

}  // namespace tyndall::vm
