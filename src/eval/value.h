// Values of the one expression language.
//
// A number is either known (a double) or, inside a medium or material body, a node of the program being
// built. The same evaluator serves scenes and bodies: what is known is computed at once, what is not becomes
// bytecode.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/source.h"
#include "base/transform.h"
#include "base/vec.h"
#include "eval/grids.h"
#include "eval/images.h"
#include "optics/phase.h"
#include "syntax/tree.h"
#include "vm/builder/builder.h"

namespace tyndall::eval {

struct Scope;

enum class Type : std::uint8_t {
  error,  // already reported; whoever meets it stays silent and gives error
  number,
  boolean,
  angle,
  pair,
  vec,  // up to three Scalars
  string,
  transform,
  list,
  range,
  function,
  phase,
  shape,  // a shape literal: `sphere { radius: 1 }`
  medium,
  material,  // a body with its arguments
  object,    // a prototype
  image,
  grid
};
// As in messages: "a number", "an angle", "a vec (x, y, z)".
std::string_view describe(Type type);

// A number that is known, or a node of the body being compiled.
struct Scalar {
  double value = 0;
  vm::NodeId node{};  // invalid: known
  bool known() const { return !node.valid(); }
};

struct Value;

// A function (`def`), with the scope it was defined in.
struct Function {
  const syntax::SyntaxTree* tree = nullptr;
  const syntax::Item* item = nullptr;  // FunctionItem, or TemplateItem for templates
  std::shared_ptr<const Scope> scope;
};

// A medium or material with its parameters bound: `cloud(height: 0.7)`, or an unnamed `{ density = 1 }`.
// The bare name of a definition, `cloud`, is not bound yet: Evaluator::bound gives it its defaults.
struct Body {
  const syntax::SyntaxTree* tree = nullptr;
  syntax::BodyKind kind{};
  std::string name;  // "cloud"; "medium" for unnamed ones
  Span definition;
  syntax::BlockId block;
  std::shared_ptr<const Scope> scope;  // parameters and what encloses the definition; null: not bound yet
  std::string key;  // equal keys compile to the same program (definition + argument values)
  const syntax::BodyItem* item = nullptr;         // the definition; null for unnamed ones
  std::shared_ptr<const Scope> definition_scope;  // where it was defined
};

// One lobe of a phase mixture: kind and its parameters, known or computed per segment.
struct PhaseLobe {
  optics::PhaseKind kind{};
  std::array<Scalar, optics::most_phase_parameters> parameters{};
  Scalar weight{1};
  std::vector<Scalar> shares{};  // of mixtures that it is in, as given: those that are not known
};

struct ShapeLiteral {  // evaluated by resolve
  const syntax::SyntaxTree* tree = nullptr;
  const syntax::ThingExpr* thing = nullptr;
  std::shared_ptr<const Scope> scope;
  Span span;
};

struct ObjectDefinition {
  const syntax::SyntaxTree* tree = nullptr;
  const syntax::ObjectItem* item = nullptr;
  std::shared_ptr<const Scope> scope;
};

struct RangeValue {
  double first = 0, last = 0, step = 1;
  bool excludes_last = false;
  // In a body: the value at which each lane's rounds end, when it differs; `last` is the most it can be.
  Scalar lane_last{};

  bool differs() const { return !lane_last.known(); }
};

using Heavy =
    std::variant<std::monostate, std::string, Transform, std::vector<Value>, RangeValue, Function, Body,
                 std::vector<PhaseLobe>, ShapeLiteral, ObjectDefinition, Image, Grid, GridBounds>;

struct Value {
  Type type = Type::error;
  syntax::Unit unit =
      syntax::Unit::none;  // of a number written with a unit; see language.md "Space, time, units"
  // Of lists, noted as they are made: a list may hold another one many times over.
  bool parts_known = true, parts_hold_scopes = false;
  std::uint16_t list_depth = 0;     // lists within each other, itself included
  std::array<Scalar, 3> scalars{};  // number, boolean (0/1), angle (radians): [0]; pair: [0,1]; vec: all
  std::shared_ptr<const Heavy> heavy;

  int width() const;   // 1, 2 or 3 for scalar types, 0 otherwise
  bool known() const;  // every scalar known (and every part of a list)
  // Whether it may hold the scope it is bound in: definitions, bodies, shapes, and lists of them.
  bool holds_scope() const;
  bool is_error() const { return type == Type::error; }

  static Value number(double v, syntax::Unit unit = syntax::Unit::none);
  static Value boolean(bool v);
  static Value angle(double radians);
  static Value pair(double x, double y);
  static Value vec(const Vec3d& v);
  static Value string(std::string v);
  static Value list(std::vector<Value> elements);
  static Value transform(const Transform& t);
  // A value of up to three scalars, known or not.
  static Value of(Type type, const std::array<Scalar, 3>& scalars);
  template <class T>
  static Value of_heavy(Type type, T content) {
    Value v;
    v.type = type;
    v.heavy = std::make_shared<Heavy>(std::move(content));
    return v;
  }
  // The heavy content if it is a T, or nullptr.
  template <class T>
  const T* get() const {
    return heavy ? std::get_if<T>(heavy.get()) : nullptr;
  }
  // Of known values only.
  double as_number() const;
  bool as_bool() const;
  Vec3d as_vec() const;
  const std::string& as_string() const;
  const Transform& as_transform() const;
  const std::vector<Value>& as_list() const;
  // Of a list that shares its entries with no other value, and is deeper than the entry.
  void set_own_entry(std::size_t place, Value entry);
};

// The value as "{…}" in a string writes it: numbers at their shortest, integers without a point.
std::string text_of(const Value& value);

// The value with its numbers, those of angles in degrees, as the format says; lists, strings and booleans as
// above.
std::string text_of(const Value& value, const syntax::NumberFormat& format);

// Appends that text. False, with a part of it, when `text` would grow beyond `most` bytes.
bool append_text(std::string& text, const Value& value, std::size_t most);

}  // namespace tyndall::eval
