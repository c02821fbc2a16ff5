// Calls of built-ins: binds the arguments to the row's parameters and hands them to the row's handler.
#include <fmt/format.h>

#include "base/check.h"
#include "eval/calls.h"
#include "eval/operators.h"

namespace tyndall::eval {

using namespace syntax;

std::string CallSite::what(std::size_t i) const {
  return fmt::format("'{}' of {}", entry.row->parameters[i].name, name());
}

Value CallSite::as(Type type, std::size_t i, bool& ok, bool widen) {
  const Value value =
      arguments[i].type == type ? arguments[i] : ev.convert(type, arguments[i], spans[i], what(i), widen);
  ok &= !value.is_error();
  return value;
}

// Options may be left out, the time of a field too, which has no default.
static bool is_required(const vm::BuiltinParameter& parameter) {
  return parameter.default_value.empty() && !parameter.named;
}

static std::string signature(const vm::Builtin& row) {
  std::vector<std::string> names;
  for (const vm::BuiltinParameter& parameter : row.parameters)
    names.push_back(fmt::format("{}{}", parameter.name, parameter.named ? ": …" : ""));
  return fmt::format("it is written {}({})", row.name, fmt::join(names, ", "));
}

// An argument as the way out repeats it: a number or a name as they are, … for all that is longer.
static std::string in_short(const Evaluator& ev, const Expr& written) {
  if (const auto* number = std::get_if<NumberExpr>(&written.node); number && number->unit == Unit::none)
    return fmt::format("{}", number->value);
  const auto* name = std::get_if<NameExpr>(&written.node);
  return name ? std::string(ev.text(name->symbol)) : "…";
}

void report_option_without_name(Evaluator& ev, const vm::Builtin& row, const SyntaxTree& tree,
                                ExprId written) {
  const std::string value = in_short(ev, tree[written]);
  const auto* name = std::get_if<NameExpr>(&tree[written].node);
  const bool is_time = name && ev.names().special(name->symbol) == Special::time;
  std::vector<std::string> calls;
  for (const bool time : {false, true})  // a bare number is hardly ever the time: it stands last
    for (const vm::BuiltinParameter& option : row.parameters)
      if (option.named && (option.name == "time") == time && (time || !is_time))
        calls.push_back(fmt::format("{}({}, {}: {})", row.name, row.parameters[0].name, option.name, value));
  ev.error(tree[written].span, fmt::format("an option of '{}' is given by its name", row.name),
           fmt::format("write {}", fmt::join(calls, " or ")));
}

Value call_builtin(Evaluator& ev, const BuiltinEntry& entry, const SyntaxTree& tree, const CallExpr& call,
                   Span span, const std::shared_ptr<Scope>& scope) {
  const vm::Builtin& row = *entry.row;
  CallSite site{ev, entry, tree, call, span, scope};
  if (entry.free) return entry.free(site);
  CHECK_LE(entry.parameters.size(), CallSite::max_arguments);
  bool failed = false;
  std::size_t position = 0;
  for (const Argument& argument : site.written()) {
    std::size_t index = position;
    const Span place = tree[argument.value].span;
    if (argument.name.symbol.valid()) {
      index = 0;
      while (index < entry.parameters.size() && entry.parameters[index] != argument.name.symbol) ++index;
      if (index == entry.parameters.size()) {
        std::vector<std::string_view> names;
        for (const vm::BuiltinParameter& parameter : row.parameters) names.push_back(parameter.name);
        report_unknown_parameter(ev, row.name, argument.name, names, {});
        ev.check_names(tree, argument.value, scope);
        failed = true;
        continue;
      }
    } else if (position++ >= entry.parameters.size()) {
      return ev.error(place, fmt::format("too many arguments for '{}'", row.name), signature(row));
    } else if (row.parameters[index].named) {
      report_option_without_name(ev, row, tree, argument.value);
      ev.check_names(tree, argument.value, scope);
      failed = true;
      break;
    }
    if (site.given[index]) {
      ev.error(place, fmt::format("'{}' is given twice", row.parameters[index].name));
      failed = true;
    }
    site.given[index] = true;
    site.spans[index] = place;
    site.arguments[index] = ev.evaluate(tree, argument.value, scope);
    failed |= site.arguments[index].is_error();
  }
  if (failed) return {};
  for (std::size_t i = 0; i < entry.parameters.size(); ++i)
    if (!site.given[i] && is_required(row.parameters[i]))
      return ev.error(span, fmt::format("'{}' wants '{}'", row.name, row.parameters[i].name), signature(row));
  return ev.finite(entry.bound(site), span);
}

}  // namespace tyndall::eval
