// Calls of built-ins: binds the arguments to the row's parameters and hands them to the row's handler.
#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "eval/calls.h"
#include "eval/free_names.h"
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

// translate(1, 2, 3) with the parentheses that it lacks, translate((1, 2, 3)); empty where three arguments in
// a row make no vec.
static std::string with_inner_parentheses(CallSite& site) {
  const auto written = site.written();
  const vm::Builtin& row = *site.entry.row;
  std::vector<std::string> arguments;
  std::size_t next = 0;
  for (const vm::BuiltinParameter& parameter : row.parameters) {
    const bool vec = parameter.type.find("vec") != std::string_view::npos;
    if (next == written.size() || parameter.named) break;
    std::vector<std::string> parts;
    while (next < written.size() && parts.size() < (vec ? 3 : 1))
      parts.push_back(in_short(site.ev, site.tree[written[next++].value]));
    if (vec && parts.size() < 3) return {};
    const std::string joined = fmt::format("{}", fmt::join(parts, ", "));
    arguments.push_back(vec ? fmt::format("({})", joined) : joined);
  }
  const bool all_used = next == written.size() && next > arguments.size();
  return all_used ? fmt::format("{}({})", row.name, fmt::join(arguments, ", ")) : std::string{};
}

// True after reporting translate(x: 1, …).
static bool report_named_components(Evaluator& ev, const vm::Builtin& row, const Name& name) {
  const std::string_view word = ev.text(name.symbol);
  const bool vec = row.parameters.size() == 1 && row.parameters[0].type.ends_with("vec");
  if (!vec || (word != "x" && word != "y" && word != "z")) return false;
  ev.error(name.span, fmt::format("'{}' has no parameter '{}'", row.name, word),
           fmt::format("write {}((x, y, z))", row.name));
  return true;
}

// True after reporting numbers, at `place` one too many, that are meant as one vec.
static bool report_flat_vec(CallSite& site, Span place) {
  const auto written = site.written();
  const Type first = site.arguments[0].type;
  const bool named = std::any_of(written.begin(), written.end(),
                                 [](const Argument& argument) { return argument.name.symbol.valid(); });
  const std::string meant = named || first != Type::number ? "" : with_inner_parentheses(site);
  if (meant.empty()) return false;
  site.ev.error(place, fmt::format("'{}' takes a vec as one argument", site.name()),
                fmt::format("write it with parentheses of its own: {}", meant));
  return true;
}

// True after reporting min or max of more than two.
static bool report_too_many_to_compare(CallSite& site, Span place) {
  const vm::Builtin& row = *site.entry.row;
  const auto written = site.written();
  if (row.name != "min" && row.name != "max") return false;
  std::vector<std::string> parts;
  for (const Argument& argument : written) parts.push_back(in_short(site.ev, site.tree[argument.value]));
  std::string nested = parts.back();
  for (auto part = parts.rbegin() + 1; part != parts.rend(); ++part)
    nested = fmt::format("{}({}, {})", row.name, *part, nested);
  site.ev.error(place, fmt::format("too many arguments for '{}'", row.name),
                fmt::format("it takes two: write {}", nested));
  return true;
}

// A word that names nothing, where one of a few is wanted: who reads it tells which there are.
static bool is_unknown_choice(const Evaluator& ev, const SyntaxTree& tree, const Argument& argument,
                              const Scope& scope) {
  const Names& names = ev.names();
  if (argument.name.symbol != names.filter && argument.name.symbol != names.encoding) return false;
  const auto* word = std::get_if<NameExpr>(&tree[argument.value].node);
  return word != nullptr && scope.find(word->symbol) == nullptr && names.builtin(word->symbol) == nullptr;
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
        // A word alone may be one that the parameter meant knows: `filterr: cubic`.
        if (!std::holds_alternative<NameExpr>(tree[argument.value].node))
          ev.check_names(tree, argument.value, scope);
        failed = true;
        if (report_named_components(ev, row, argument.name)) break;
        report_unknown_parameter(ev, row.name, argument.name, names, {});
        continue;
      }
    } else if (position++ >= entry.parameters.size()) {
      if (report_too_many_to_compare(site, place) || report_flat_vec(site, place)) return {};
      return ev.error(place, fmt::format("too many arguments for '{}'", row.name), signature(row));
    } else if (row.parameters[index].named) {
      if (report_flat_vec(site, place)) return {};
      bool has_place = true;
      if (row.parameters[0].type == "vec") site.as(Type::vec, 0, has_place);
      if (!has_place) return {};
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
    if (is_choice(ev.names(), tree, argument) || is_unknown_choice(ev, tree, argument, *scope)) {
      const auto& word = std::get<NameExpr>(tree[argument.value].node);
      site.arguments[index] = Value::string(std::string(ev.text(word.symbol)));
      continue;
    }
    site.arguments[index] = ev.evaluate(tree, argument.value, scope);
    failed |= site.arguments[index].is_error();
  }
  if (failed) return {};
  if (const std::optional<Value> extreme = extreme_entry(site)) return *extreme;
  for (std::size_t i = 0; i < entry.parameters.size(); ++i)
    if (!site.given[i] && is_required(row.parameters[i]))
      return ev.error(span, fmt::format("'{}' wants '{}'", row.name, row.parameters[i].name), signature(row));
  return ev.finite(entry.bound(site), span, row.name);
}

}  // namespace tyndall::eval
