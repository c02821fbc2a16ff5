// Calls of built-ins and functions (internal to this layer).
#pragma once

#include "eval/evaluator.h"

namespace tyndall::eval {

// A call of a built-in. With BuiltinEntry::bound the arguments are evaluated and stand at their parameters'
// places.
struct CallSite {
  Evaluator& ev;
  const BuiltinEntry& entry;
  const syntax::SyntaxTree& tree;
  const syntax::CallExpr& call;
  Span span;
  const std::shared_ptr<Scope>& scope;

  static constexpr std::size_t max_arguments = 8;
  std::array<Value, max_arguments> arguments{};
  std::array<Span, max_arguments> spans{};
  std::array<bool, max_arguments> given{};

  std::string_view name() const { return entry.row->name; }
  std::span<const syntax::Argument> written() const { return tree.list_of_arguments(call.arguments); }
  // The argument as a type, after reporting what does not fit; `ok` turns false.
  Value as(Type type, std::size_t i, bool& ok, bool widen = false);
  // "octaves of fbm"
  std::string what(std::size_t i) const;
};

// Whether an expression is a number as it is written, with its sign.
bool is_literal(const syntax::SyntaxTree& tree, syntax::ExprId id);
std::vector<std::string_view> parameter_names(const Evaluator& evaluator,
                                              std::span<const syntax::Parameter> parameters);
// An argument for a parameter that `callee` does not have; `definition` is where it has its parameters, if
// that is in a scene.
void report_unknown_parameter(Evaluator& evaluator, std::string_view callee, const syntax::Name& argument,
                              const std::vector<std::string_view>& parameters, Span definition);

// An argument that stands where only named options may.
void report_option_without_name(Evaluator& evaluator, const vm::Builtin& row, const syntax::SyntaxTree& tree,
                                syntax::ExprId written);

Value evaluate_call(Evaluator& evaluator, const syntax::SyntaxTree& tree, const syntax::CallExpr& call,
                    Span span, const std::shared_ptr<Scope>& scope);
// Calls a built-in of any shape.
Value call_builtin(Evaluator& evaluator, const BuiltinEntry& entry, const syntax::SyntaxTree& tree,
                   const syntax::CallExpr& call, Span span, const std::shared_ptr<Scope>& scope);

// The handlers by name of this layer's hand-written built-ins (nullptr: none).
struct Handlers {
  Value (*bound)(CallSite&) = nullptr;
  Value (*free)(CallSite&) = nullptr;
};
Handlers vector_handler(std::string_view name);     // builtins_vector.cpp
Handlers transform_handler(std::string_view name);  // builtins_transform.cpp
Handlers phase_handler(std::string_view name);      // builtins_phase.cpp
Handlers keys_handler(std::string_view name);       // builtins_keys.cpp
Handlers image_handler(std::string_view name);      // builtins_image.cpp
Handlers grid_handler(std::string_view name);       // builtins/grid.cpp
Handlers list_handler(std::string_view name);       // builtins/lists.cpp
Handlers solid_handler(std::string_view name);      // builtins/solids.cpp
Handlers field_handler(std::string_view name);      // builtins/fields.cpp
Handlers sky_handler(std::string_view name);        // builtins/sky.cpp
Handlers print_handler(std::string_view name);      // builtins/print.cpp

// Of a call of min or max with one list: its least or greatest entry, in each component (builtins/lists.cpp).
std::optional<Value> extreme_entry(CallSite& site);

// The plane at (u, v), bilinear.
Scalar texel_at(Evaluator& evaluator, const PlanePointer& plane, const Scalar& u, const Scalar& v, Span span);

// The image at the place that the call's one argument, a pair, names (builtins_image.cpp).
Value look_up(Evaluator& evaluator, const Image& image, const syntax::SyntaxTree& tree,
              const syntax::CallExpr& call, std::string_view name, Span span,
              const std::shared_ptr<Scope>& scope);

// The grid at the place that the call's one argument, a vec, names (builtins/grid.cpp).
Value look_up(Evaluator& evaluator, const Grid& grid, const syntax::SyntaxTree& tree,
              const syntax::CallExpr& call, std::string_view name, Span span,
              const std::shared_ptr<Scope>& scope);

// Calls by the shapes of vm::Shape (builtins_shapes.cpp).
Value call_componentwise(CallSite& site);
Value call_angle_to_number(CallSite& site);
Value call_number_to_angle(CallSite& site);
Value call_length(CallSite& site);
Value call_field(CallSite& site);
Value call_vector_field(CallSite& site);

}  // namespace tyndall::eval
