// Calls of functions and bodies: binding arguments to parameters, running what the function says.
#include "eval/calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "base/check.h"
#include "eval/free_names.h"

namespace tyndall::eval {

using namespace syntax;

bool is_literal(const SyntaxTree& tree, ExprId id) {
  const auto* sign = std::get_if<UnaryExpr>(&tree[id].node);
  return std::holds_alternative<NumberExpr>(tree[sign ? sign->operand : id].node);
}

std::vector<std::string_view> parameter_names(const Evaluator& ev, std::span<const Parameter> parameters) {
  std::vector<std::string_view> names;
  for (const Parameter& parameter : parameters) names.push_back(ev.text(parameter.name.symbol));
  return names;
}

static std::string listed(const std::vector<std::string_view>& names) {
  return names.empty() ? "it takes no arguments" : fmt::format("it takes {}", fmt::join(names, ", "));
}

void report_unknown_parameter(Evaluator& ev, std::string_view callee, const Name& argument,
                              const std::vector<std::string_view>& parameters, Span definition) {
  const std::string_view word = ev.text(argument.symbol);
  const std::string guess = did_you_mean(word, parameters);
  std::vector<Diagnostic::Note> notes;
  if (definition.valid())
    notes.push_back({definition, fmt::format("the parameters of '{}' are here", callee)});
  ev.error(argument.span, fmt::format("'{}' has no parameter '{}'", callee, word),
           guess.empty() ? listed(parameters) : guess, std::move(notes));
}

namespace {

// Where parameters stand by their names; of many, a table is made when the first is asked for.
class ParameterPlaces {
 public:
  explicit ParameterPlaces(std::span<const Parameter> parameters) : parameters_(parameters) {}

  // The number of the parameter, or of all of them if there is none of that name.
  std::size_t find(SymbolId symbol) {
    constexpr std::size_t few = 16;
    const auto has_name = [&](const Parameter& p) { return p.name.symbol == symbol; };
    if (parameters_.size() <= few)
      return static_cast<std::size_t>(std::find_if(parameters_.begin(), parameters_.end(), has_name) -
                                      parameters_.begin());
    if (table_.empty())
      for (std::size_t i = 0; i < parameters_.size(); ++i) table_.try_emplace(parameters_[i].name.symbol, i);
    const auto found = table_.find(symbol);
    return found == table_.end() ? parameters_.size() : found->second;
  }

 private:
  std::span<const Parameter> parameters_;
  std::unordered_map<SymbolId, std::size_t> table_;
};

constexpr std::size_t no_argument = static_cast<std::size_t>(-1);

// The argument that each parameter gets, by number; nothing after an error.
std::optional<std::vector<std::size_t>> match_arguments(Evaluator& ev, std::span<const Parameter> parameters,
                                                        const SyntaxTree& tree,
                                                        std::span<const Argument> arguments,
                                                        const std::shared_ptr<Scope>& scope,
                                                        std::string_view callee) {
  std::vector<std::size_t> argument_of(parameters.size(), no_argument);
  ParameterPlaces places(parameters);
  bool failed = false;
  std::size_t position = 0;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Argument& argument = arguments[i];
    const Span span = argument.name.symbol.valid() ? argument.name.span : tree[argument.value].span;
    std::size_t index = position;
    if (argument.name.symbol.valid()) {
      index = places.find(argument.name.symbol);
      if (index == parameters.size()) {
        report_unknown_parameter(ev, callee, argument.name, parameter_names(ev, parameters),
                                 parameters.empty() ? Span{} : parameters[0].name.span);
        failed = true;
        ev.check_names(tree, argument.value, scope);
        continue;
      }
    } else if (position++ >= parameters.size()) {
      const bool numbers = arguments.size() >= 3 && is_literal(tree, arguments[0].value);
      ev.error(span, fmt::format("too many arguments for '{}'", callee),
               listed(parameter_names(ev, parameters)) +
                   (numbers ? "; a point is one argument, with parentheses of its own: (x, y, z)" : ""));
      failed = true;
      break;
    }
    if (argument_of[index] != no_argument) {
      ev.error(span, fmt::format("'{}' is given twice", ev.text(parameters[index].name.symbol)));
      failed = true;
    }
    argument_of[index] = i;
  }
  return failed ? std::nullopt : std::optional(std::move(argument_of));
}

}  // namespace

std::shared_ptr<Scope> Evaluator::bind_arguments(const SyntaxTree& definition_tree, ListRef parameter_list,
                                                 const std::shared_ptr<const Scope>& definition_scope,
                                                 const SyntaxTree& call_tree, ListRef argument_list,
                                                 const std::shared_ptr<Scope>& call_scope,
                                                 std::string_view callee, Span call) {
  const auto parameters = definition_tree.list_of_parameters(parameter_list);
  const auto arguments = call_tree.list_of_arguments(argument_list);
  const auto argument_of = match_arguments(*this, parameters, call_tree, arguments, call_scope, callee);
  if (!argument_of) return nullptr;
  bool failed = false;
  auto scope = std::make_shared<Scope>();
  scope->parent = definition_scope;
  scope->assignments_end_here = true;
  scope->bindings.reserve(parameters.size());
  for (std::size_t i = 0; i < parameters.size() && !failed; ++i) {
    const Parameter& parameter = parameters[i];
    Binding binding{parameter.name.symbol, {}, BindingKind::parameter, parameter.name.span, false};
    if ((*argument_of)[i] != no_argument) {
      evaluate_into(binding, call_tree, arguments[(*argument_of)[i]].value, call_scope, *scope);
    } else if (parameter.default_value.valid()) {
      frames_.push_back({nullptr, call});  // a default sees what the function sees
      evaluate_into(binding, definition_tree, parameter.default_value, scope, *scope);
      hold(*scope, binding.value);
      frames_.pop_back();
    } else {
      error(call, fmt::format("'{}' wants '{}'", callee, text(parameter.name.symbol)),
            listed(parameter_names(*this, parameters)), {{parameter.name.span, "it has no default"}});
      failed = true;
    }
    if (binding.value.is_error()) failed = true;
    scope->bindings.push_back(std::move(binding));
  }
  return failed ? nullptr : scope;
}

Value Evaluator::call(const Function& function, const SyntaxTree& tree, const CallExpr& call_expr,
                      std::string_view name, Span span, const std::shared_ptr<Scope>& scope) {
  const auto* item = std::get_if<FunctionItem>(&function.item->node);
  if (!item)
    return error(span, fmt::format("'{}' places things and gives no value", name),
                 "call it as a statement of its own");
  for (const Frame& frame : frames_) {
    if (frame.item != function.item) continue;
    // Its own name in its own text was told where it is defined.
    const Span& own = function.item->span;
    const bool told = name == text(item->name.symbol) && own.source == span.source &&
                      own.begin <= span.begin && span.end <= own.end;
    if (told) return ++errors_reported_, Value{};
    return error(span, fmt::format("'{}' calls itself", text(item->name.symbol)),
                 "functions may not; use a for loop", {{item->name.span, "defined here"}});
  }
  if (item->value.valid() && item->steps.valid())  // its '=' is missing, which was told
    return ++errors_reported_, Value{};
  if (static_cast<int>(frames_.size()) >= max_call_depth)
    return error(span, fmt::format("more than {} functions inside each other", max_call_depth));
  const int most_calls = in_body() ? max_body_calls : max_total_calls;
  if (calls_ > most_calls) return ++errors_reported_, Value{};  // told already
  if (++calls_ > most_calls)
    return error(span, fmt::format("more than {} calls of functions for one value", most_calls),
                 "functions that call others twice multiply: give the first result a name with let");
  const std::shared_ptr<Scope> inner = bind_arguments(*function.tree, item->parameters, function.scope, tree,
                                                      call_expr.arguments, scope, name, span);
  if (!inner) return {};
  frames_.push_back({function.item, span});
  Value result;
  if (item->value.valid()) {
    result = evaluate(*function.tree, item->value, inner);
  } else {
    const int errors = errors_reported_;
    const std::optional<Value> returned = run_steps(*function.tree, item->steps, inner, nullptr);
    if (returned)
      result = *returned;
    else if (errors_reported_ == errors)
      error(item->name.span, fmt::format("'{}' ends without a value on some path", text(item->name.symbol)),
            "end it with return");
  }
  frames_.pop_back();
  return result;
}

std::optional<Body> Evaluator::bound(const Body& body, Span use) {
  if (body.scope) return body;
  CHECK(body.item != nullptr);
  Body result = body;
  const auto empty = std::make_shared<Scope>();
  result.scope = bind_arguments(*body.tree, body.item->parameters, body.definition_scope, *body.tree,
                                ListRef{}, empty, body.name, use);
  if (!result.scope) return std::nullopt;
  result.key = key_of(result, *result.scope);
  return result;
}

Value Evaluator::instantiate(const Body& body, const SyntaxTree& tree, const CallExpr& call_expr, Span span,
                             const std::shared_ptr<Scope>& scope) {
  const bool medium = body.kind == BodyKind::medium;
  if (!body.item)
    return error(span, fmt::format("an unnamed {} takes no arguments", medium ? "medium" : "material"));
  Body result = body;
  result.scope = bind_arguments(*body.tree, body.item->parameters, body.definition_scope, tree,
                                call_expr.arguments, scope, body.name, span);
  if (!result.scope) return {};
  for (const Binding& binding : result.scope->bindings)
    if (!binding.value.known())
      return error(span, fmt::format("'{}' must be known when the scene is read", text(binding.symbol)));
  result.key = key_of(result, *result.scope);
  return Value::of_heavy(medium ? Type::medium : Type::material, std::move(result));
}

Value evaluate_call(Evaluator& ev, const SyntaxTree& tree, const CallExpr& call, Span span,
                    const std::shared_ptr<Scope>& scope) {
  const Expr& callee = tree[call.callee];
  Value value;
  std::string_view name = "this";
  if (const auto* named = std::get_if<NameExpr>(&callee.node)) {
    name = ev.text(named->symbol);
    if (!scope->find(named->symbol))
      if (const BuiltinEntry* entry = ev.names().builtin(named->symbol))
        return call_builtin(ev, *entry, tree, call, span, scope);
  }
  value = ev.evaluate(tree, call.callee, scope);
  if (value.is_error()) {
    for (const Argument& argument : tree.list_of_arguments(call.arguments))
      if (!is_choice(ev.names(), tree, argument)) ev.check_names(tree, argument.value, scope);
    return {};
  }
  if (const auto* function = value.get<Function>()) return ev.call(*function, tree, call, name, span, scope);
  if (const auto* image = value.get<Image>()) return look_up(ev, *image, tree, call, name, span, scope);
  if (const auto* grid = value.get<Grid>()) return look_up(ev, *grid, tree, call, name, span, scope);
  if (const auto* body = value.get<Body>()) return ev.instantiate(*body, tree, call, span, scope);
  return ev.error(callee.span, fmt::format("'{}' is {}, not a function", name, describe(value.type)),
                  value.width() > 0 ? "write * to multiply" : "");
}

}  // namespace tyndall::eval
