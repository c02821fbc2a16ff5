// What stands in the wrong block, or in a block as other programs write it: told with where it belongs.
// See reader.h.
#include <fmt/format.h>

#include <algorithm>

#include "resolve/reading/reader.h"
#include "shader/material_outputs.h"
#include "shader/outputs.h"
#include "syntax/foreign_words.h"

namespace tyndall::resolve {

namespace {

// The name of what an item calls; none if it calls nothing.
const syntax::NameExpr* name_of_call(const syntax::SyntaxTree& tree, const syntax::Item& item) {
  const auto* call_item = std::get_if<syntax::CallItem>(&item.node);
  const auto* call = call_item ? std::get_if<syntax::CallExpr>(&tree[call_item->call].node) : nullptr;
  return call ? std::get_if<syntax::NameExpr>(&tree[call->callee].node) : nullptr;
}

bool is_output(std::span<const shader::OutputRule> rules, std::string_view name) {
  return std::any_of(rules.begin(), rules.end(),
                     [&](const shader::OutputRule& rule) { return rule.name == name; });
}

}  // namespace

std::vector<std::string_view> Reader::known_names() const {
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < known_count_; ++i) known_[i](known);
  return known;
}

bool Reader::has(std::string_view parameter) const {
  const std::vector<std::string_view> known = known_names();
  return std::find(known.begin(), known.end(), parameter) != known.end();
}

// A call where a parameter stands: `center (1, 2, 3)`, or transforms side by side. False for other calls.
bool Reader::report_call(const syntax::Item& item, const syntax::NameExpr& called) {
  const std::string_view name = symbols_.text(called.symbol);
  const eval::BuiltinEntry* builtin = evaluator_.names().builtin(called.symbol);
  if (builtin && builtin->row->result.starts_with("transform") && has("transform")) {
    if (std::exchange(transforms_told_, true)) return true;
    meant_.push_back(symbols_.intern("transform"));
    if (find(symbols_.intern("transform")))
      error(item.span, "two transforms side by side",
            fmt::format("join them with '*', of which the last applies first: translate(…) * {}(…)", name));
    else
      error(item.span, fmt::format("a parameter of '{}' is given with ':'", keyword_),
            fmt::format("write `transform: {}(…)`", name));
    return true;
  }
  if (builtin && !has(name)) return false;
  error(item.span, fmt::format("a parameter of '{}' is given with ':'", keyword_),
        fmt::format("write `{}: …`", name));
  meant_.push_back(called.symbol);
  return true;
}

// Whatever stands in a block of parameters and is none.
void Reader::report_other(const syntax::Item& item) {
  const syntax::NameExpr* called = name_of_call(*site_.tree, item);
  if (called && report_call(item, *called)) return;
  std::string help = "statements stand beside it, or in a `group { … }`";
  const auto meant = [&](std::string_view parameter, std::string_view value) {
    help = fmt::format("write {}: {}", parameter, value);
    meant_.push_back(symbols_.intern(parameter));
  };
  if (const auto* thing = std::get_if<syntax::ThingItem>(&item.node)) {
    const std::string_view word = symbols_.text(thing->keyword.symbol);
    const Statement* row = site_.statements ? site_.statements->find(thing->keyword.symbol, {}) : nullptr;
    const std::string_view foreign = syntax::help_for_foreign_word(syntax::ForeignUse::statement, word);
    if (row && row->read_shape && has("in"))
      meant("in", fmt::format("{} {{ … }}", word));
    else if (!row && !foreign.empty())
      return error(thing->keyword.span, fmt::format("no statement '{}'", word), std::string(foreign));
  } else if (const auto* body = std::get_if<syntax::BodyItem>(&item.node)) {
    const std::string_view noun = body->kind == syntax::BodyKind::medium ? "medium" : "material";
    if (has(noun)) meant(noun, "{ … }");
    if (symbols_.text(body->name.symbol).empty()) return;  // told where it was read
  }
  error(item.span, fmt::format("'{}' holds parameters only", keyword_), std::move(help));
}

// The value of an unknown parameter is not wanted, but what is wrong in it is; a word that it begins with may
// be one that the parameter meant knows: `stepp: auto(1%)`; and so in a shape: `inn: text { align: center }`.
void Reader::check_names_of_unknown(syntax::ExprId value) {
  const syntax::SyntaxTree& tree = *site_.tree;
  if (std::holds_alternative<syntax::NameExpr>(tree[value].node)) return;
  if (const auto* thing = std::get_if<syntax::ThingExpr>(&tree[value].node)) {
    const auto items = tree.list_of_items(tree[thing->block].items);
    const auto parameter = [&](syntax::ItemId id) {
      return std::get_if<syntax::ParameterItem>(&tree[id].node);
    };
    if (std::all_of(items.begin(), items.end(), parameter)) {
      for (const syntax::ItemId id : items) check_names_of_unknown(parameter(id)->value);
      return;
    }
  }
  const auto* call = std::get_if<syntax::CallExpr>(&tree[value].node);
  if (call == nullptr || !std::holds_alternative<syntax::NameExpr>(tree[call->callee].node))
    return void(evaluator_.check_names(tree, value, *site_.scope));
  for (const syntax::Argument& argument : tree.list_of_arguments(call->arguments))
    evaluator_.check_names(tree, argument.value, *site_.scope);
}

// The way out for an output of a body that is given to the thing itself; empty for other names.
std::string Reader::help_for_output(std::string_view name) {
  const bool of_medium = has("medium") && is_output(shader::medium_outputs(), name);
  const bool of_material = !of_medium && has("material") && is_output(shader::material_outputs(), name);
  if (!of_medium && !of_material) return {};
  const std::string_view body = of_medium ? "medium" : "material";
  meant_.push_back(symbols_.intern(body));
  return fmt::format("it is set in the {0}: {0}: {{ {1} = … }}", body, name);
}

// Where a parameter belongs that this thing does not have; empty when nothing tells.
std::string Reader::help_elsewhere(std::string_view name, Reader* outer) {
  if (outer && outer->has(name)) {
    outer->meant_.push_back(symbols_.intern(name));
    return fmt::format("it is a parameter of the '{}' around: write it after the '}}' of this '{}'",
                       outer->keyword_, keyword_);
  }
  for (const Given& given : given_) {
    const auto* thing = std::get_if<syntax::ThingExpr>(&(*site_.tree)[given.item->value].node);
    const Statement* inner =
        thing && site_.statements ? site_.statements->find(thing->keyword.symbol, {}) : nullptr;
    std::vector<std::string_view> names;
    if (inner && inner->list_shape_names) inner->list_shape_names(names);
    if (std::find(names.begin(), names.end(), name) != names.end())
      return fmt::format("it is a parameter of the '{}' inside: write it in its braces", inner->name);
  }
  if (name == "medium" && (has("material") || has("transform"))) {
    const Statement* row = site_.statements ? site_.statements->find(symbols_.intern(keyword_), {}) : nullptr;
    return fmt::format("a medium fills a volume: write volume {{ in: {} {{ … }}  medium: … }}",
                       row && row->closed ? keyword_ : "sphere");
  }
  const std::vector<std::string_view> known = known_names();
  if (site_.statements)
    if (const Statement* shape = site_.statements->find(symbols_.intern(name), {});
        shape && shape->read_shape && has("in")) {
      meant_.push_back(symbols_.intern("in"));
      return fmt::format("write in: {} {{ … }}", name);
    }
  if (const syntax::ForeignWord* row = syntax::find_foreign_parameter(name, known)) {
    meant_.push_back(symbols_.intern(row->needs));
    return std::string(row->help);
  }
  return {};
}

std::string Reader::help_of_others(std::string_view name) const {
  constexpr std::size_t few = 2;  // statements that have it: with more of them none is likely to be meant
  std::vector<std::string_view> owners;
  if (!site_.statements) return {};
  for (const Statement& row : site_.statements->rows()) {
    std::vector<std::string_view> names;
    if (row.list_names) row.list_names(names);
    if (std::find(names.begin(), names.end(), name) != names.end()) owners.push_back(row.name);
  }
  if (owners.empty() || owners.size() > few) return {};
  return fmt::format("it is a parameter of '{}'", fmt::join(owners, "' and '"));
}

}  // namespace tyndall::resolve
