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

// Options with a time argument come in two forms, so the time may be left out though it has no default.
static bool is_required(const vm::Builtin& row, std::size_t i) {
  const bool is_field = row.shape == vm::Shape::field || row.shape == vm::Shape::vector_field;
  return row.parameters[i].default_value.empty() && !(is_field && i > 0);
}

static std::string signature(const vm::Builtin& row) {
  std::vector<std::string_view> names;
  for (const vm::BuiltinParameter& parameter : row.parameters) names.push_back(parameter.name);
  return fmt::format("it is written {}({})", row.name, fmt::join(names, ", "));
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
    if (!site.given[i] && is_required(row, i))
      return ev.error(span, fmt::format("'{}' wants '{}'", row.name, row.parameters[i].name), signature(row));
  return ev.finite(entry.bound(site), span);
}

}  // namespace tyndall::eval
