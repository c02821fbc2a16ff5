// Evaluates expressions: literals, operators, built-ins, functions with steps, conditionals, lists, ranges.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "base/diagnostics.h"
#include "eval/names.h"
#include "eval/scope.h"
#include "eval/value.h"
#include "syntax/tree.h"
#include "vm/builder/builder.h"

namespace tyndall::eval {

// Limits of the language, so that no input can exhaust the machine.
inline constexpr int max_call_depth = 64;                  // functions calling functions
inline constexpr int max_expression_depth = 1000;          // nested evaluations, calls included
inline constexpr int max_loop_iterations = 100'000;        // one `for` in a function of scene code
inline constexpr int max_total_iterations = 1'000'000;     // all of them below one outermost evaluation
inline constexpr int max_unrolled_iterations = 4'096;      // one `for` in a body
inline constexpr int max_total_unrolled = 65'536;          // all of them in one body
inline constexpr int max_list_entries = 1'000'000;         // of a list that is made by `for`, + or append
inline constexpr int max_total_list_entries = 4'000'000;   // of all of them below one outermost evaluation
inline constexpr int max_scene_list_entries = 20'000'000;  // of all of them in a scene
inline constexpr int max_total_calls = 1'000'000;          // of functions, below one outermost evaluation
inline constexpr int max_body_calls = 65'536;              // of functions, in one body
inline constexpr int max_octaves = 32;
inline constexpr std::size_t max_string_bytes = 65'536;
inline constexpr int max_list_depth = 256;  // lists within each other

// What could not be read, and has been told: names that may have been defined there are not complained of.
struct Unread {
  std::vector<syntax::SymbolId> definitions;  // their beginnings could be read
  bool file = false;                          // a whole file: any name may come from there

  bool may_define(syntax::SymbolId symbol) const {
    return file || std::find(definitions.begin(), definitions.end(), symbol) != definitions.end();
  }
};

// Where a name is defined that is not known where it was used, and how it could be.
struct DefinedElsewhere {
  Span place;
  std::string_view help;
};

// What a whole run shares.
struct Context {
  const Sources* sources = nullptr;
  syntax::Symbols* symbols = nullptr;
  Diagnostics* diagnostics = nullptr;
  double time = 0;  // seconds, when the shutter opens; or a moment while it is open, when that is asked for
  double frame = 0;
  bool shutter_open = false;      // for some time: in bodies what depends on `time` is a function of it
  double frame_time = 0;          // seconds, whatever moment is asked for
  double opened = 0;              // seconds, when the shutter opens, whatever moment is asked for
  double shutter_seconds = 0;     // how long it is open
  std::uint64_t time_reads = 0;   // how often scene code asked for `time`, or for what depends on it
  std::uint64_t frame_reads = 0;  // how often scene code or a body asked for `frame`
  SourceId main_source{0};        // the file whose unused names are warned of
  Unread unread{};
  std::vector<const syntax::SyntaxTree*> trees{};       // that were read so far
  std::unordered_set<syntax::SymbolId> told_unknown{};  // names that are nothing: told once for all uses
  ImageReader* images = nullptr;                        // none: there are no pictures
  GridReader* grids = nullptr;                          // none: there are no grids
  std::shared_ptr<Names> names{};  // made when first needed; must outlive the values of the run

  // For a name that was used in vain at `use`: a definition of it that comes later, or within a block.
  std::optional<DefinedElsewhere> defined_elsewhere(syntax::SymbolId symbol, const Span& use) const;
};

// The way out where a colour is wanted and this is found.
std::string help_for_color(const Value& found);

// How many values a range holds (0 when empty, or when its step is 0 or not finite), and the i-th.
std::int64_t count(const RangeValue& range);
double at(const RangeValue& range, std::int64_t index);

// Evaluates in scene code (builder == nullptr: everything is known, a division by zero or NaN is an error at
// its place) or in a body of the given kind (`builder` collects what depends on the inputs).
class Evaluator {
 public:
  explicit Evaluator(Context& context, vm::Builder* builder = nullptr,
                     syntax::BodyKind body = syntax::BodyKind::medium);

  // The value, or an error value after reporting why there is none. `scope` is where names are looked up.
  Value evaluate(const syntax::SyntaxTree& tree, syntax::ExprId expr, const std::shared_ptr<Scope>& scope);

  // The same, converted to `type` where the language converts (a number widens to a vec only if `widen`);
  // reports "wanted an angle, found a number: write 40deg" at the expression otherwise. `what` names the
  // receiver.
  Value evaluate_as(Type type, const syntax::SyntaxTree& tree, syntax::ExprId expr,
                    const std::shared_ptr<Scope>& scope, std::string_view what, bool widen = false);

  // Converts a value that is already there, as evaluate_as does; `span` is where it was written.
  Value convert(Type type, const Value& value, Span span, std::string_view what, bool widen = false);

  // Binds what a definition defines (let, var, def, template, medium, material, object) in `scope`, after
  // checking the names inside a def or body. False when the item is no definition.
  bool define(const syntax::SyntaxTree& tree, const syntax::Item& item, const std::shared_ptr<Scope>& scope);

  // Adds a binding; reports a name that the scope has already or that may not be redefined here.
  void bind(const std::shared_ptr<Scope>& scope, Binding binding);
  // Notes that `value` comes to stand in `scope`: if it holds scopes in its turn, the run's end must let go
  // of it.
  void hold(const Scope& scope, const Value& value);

  // The value of a `var`, which in a scene's own blocks may not depend on `time`: reported. `current` is the
  // value that it has; where an entry of it is set it may be changed.
  Value evaluate_variable(const syntax::SyntaxTree& tree, syntax::ExprId expr,
                          const std::shared_ptr<Scope>& scope, Value* current = nullptr);

  // Evaluates an expression for a binding, and notes there whether it depends on `time`. Scene code only.
  void evaluate_into(Binding& binding, const syntax::SyntaxTree& tree, syntax::ExprId expr,
                     const std::shared_ptr<Scope>& scope, const Scope& holder);

  // Binds the call's arguments to the definition's parameters (positional, named, defaults evaluated in
  // order) in a new scope below the definition's. Reports unknown, missing and doubled ones. Null after an
  // error.
  std::shared_ptr<Scope> bind_arguments(const syntax::SyntaxTree& definition_tree, syntax::ListRef parameters,
                                        const std::shared_ptr<const Scope>& definition_scope,
                                        const syntax::SyntaxTree& call_tree, syntax::ListRef arguments,
                                        const std::shared_ptr<Scope>& call_scope, std::string_view callee,
                                        Span call);

  // A text that is equal for equal arguments, as bind_arguments binds them, and only for those.
  std::string key_of(const Scope& arguments);

  // The body with its parameters' defaults, when it is not bound yet; nothing after reporting a parameter
  // without a default. `use` is the place that names the body.
  std::optional<Body> bound(const Body& body, Span use);

  // Runs let, var, assignment, if, for and nested def items of a block in order. For bodies `outputs->assign`
  // is told of an assignment to a name that is no `var` in scope but an output, once for all branches of an
  // `if`; for function steps there are none and `return` gives the value.
  struct Branches {
    std::vector<Span> places;  // of the statements that set one output
    Scalar taken{0};           // the number of the one that did so at a place
    bool constant = false;     // each sets a constant
  };
  struct Outputs {
    std::string_view owner;               // the body, as messages name it
    std::vector<std::string_view> names;  // of those that it may set
    // What a statement sets as its output takes it; complains of what it does not take.
    std::function<Value(const syntax::AssignItem& assign, const Value& value)> read;
    std::function<void(const syntax::Item& item, const syntax::AssignItem& assign, Value value,
                       const Branches& branches)>
        assign;
  };
  // Reports a name that is set but is no output; `variables` are what else may have been meant.
  void report_no_output(const Outputs& outputs, const syntax::Name& name,
                        const std::vector<std::string_view>& variables);
  std::optional<Value> run_steps(const syntax::SyntaxTree& tree, syntax::BlockId block,
                                 const std::shared_ptr<Scope>& scope, const Outputs* outputs);

  // Looks every name of the expression or block up, without evaluating it; reports unknown ones.
  void check_names(const syntax::SyntaxTree& tree, syntax::ExprId expr,
                   const std::shared_ptr<const Scope>& scope);
  // `parameters` and `local` are known in the block besides.
  void check_names(const syntax::SyntaxTree& tree, syntax::BlockId block,
                   const std::shared_ptr<const Scope>& scope, syntax::ListRef parameters = {},
                   syntax::SymbolId local = {});

  // Warns of every binding of this scope that nothing used, except parameters and names with a leading `_`.
  // Silent once there are errors, which may hide the uses.
  void report_unused(const Scope& scope);

  // The value of `op`: computed when every operand is known, a node of the program otherwise.
  Scalar emit(vm::Op op, std::span<const Scalar> operands, Span span, std::uint8_t repeats = 0,
              std::uint32_t immediate = 0);
  Scalar emit(vm::Op op, std::initializer_list<Scalar> operands, Span span, std::uint8_t repeats = 0,
              std::uint32_t immediate = 0) {
    return emit(op, std::span(operands.begin(), operands.size()), span, repeats, immediate);
  }

  // The node of a scalar, making a constant of a known one. Bodies only.
  vm::NodeId node(const Scalar& scalar);

  // x to the exponent by other operations, where they are as exact; bodies only.
  std::optional<Scalar> easy_power(const Scalar& x, double exponent, Span span);

  // Reports an error with the chain of calls that led here, and gives the error value.
  Value error(Span span, std::string message, std::string help = {},
              std::vector<Diagnostic::Note> notes = {});
  // The same, unless the message has been reported at any place.
  Value error_once(Span span, std::string message, std::string help, std::vector<Diagnostic::Note> notes);
  // In scene code: the value, or an error when a scalar of it is not finite. `function`: what it came from.
  Value finite(const Value& value, Span span, std::string_view function = {});
  // The way out for `value.name`: the call where the name is a built-in's.
  std::string help_for_member(syntax::SymbolId member, std::string_view otherwise) const;
  // True after reporting a name whose definition comes only after its use.
  bool report_defined_below(syntax::SymbolId symbol, Span span);

  // Calls a function value with arguments written in `tree`.
  Value call(const Function& function, const syntax::SyntaxTree& tree, const syntax::CallExpr& call,
             std::string_view name, Span span, const std::shared_ptr<Scope>& scope);

  // Counts iterations against the limits; reports and gives false past them.
  bool may_iterate(std::int64_t iterations, Span span);
  // Counts what a list of so many entries takes to be made, likewise.
  bool may_hold(std::size_t entries, Span span);

  // How many errors were reported through this evaluator, repeated ones included.
  int errors_reported() const { return errors_reported_; }

  bool in_body() const { return builder_ != nullptr; }
  Context& context() { return context_; }
  vm::Builder* builder() { return builder_; }
  std::string_view text(syntax::SymbolId symbol) const { return context_.symbols->text(symbol); }
  const Names& names() const { return *context_.names; }

 private:
  friend struct Dispatch;  // evaluator.cpp: one overload for each kind of expression
  friend class NameCheck;

  struct Frame {
    const syntax::Item* item;
    Span call;
  };
  class Nested;  // counts the nesting of evaluations

  Value input(Special special);
  Value function_of_time(const Binding& binding, Span use);
  Value value_of_name(syntax::SymbolId symbol, Span span, const Scope& scope);
  Value unknown_name(syntax::SymbolId symbol, Span span, const Scope* scope,
                     std::span<const syntax::SymbolId> locals, std::optional<syntax::BodyKind> inputs = {});
  std::vector<Diagnostic::Note> calls_that_led_here() const;
  bool sees(Special special) const;
  friend Value evaluate_call(Evaluator&, const syntax::SyntaxTree&, const syntax::CallExpr&, Span,
                             const std::shared_ptr<Scope>&);
  Value instantiate(const Body& body, const syntax::SyntaxTree& tree, const syntax::CallExpr& call, Span span,
                    const std::shared_ptr<Scope>& scope);
  std::string key_of(const Body& body, const Scope& scope);
  void append_key(std::string& key, const Binding& binding);
  void check_parameters(const syntax::SyntaxTree& tree, syntax::ListRef parameters,
                        const syntax::BodyKind* body);

  Context& context_;
  vm::Builder* builder_;
  syntax::BodyKind body_;
  std::vector<Frame> frames_;
  int depth_ = 0;
  int errors_reported_ = 0;
  std::int64_t iterations_ = 0, calls_ = 0, list_entries_ = 0, all_list_entries_ = 0;
};

}  // namespace tyndall::eval
