// What a name stands for, and what a definition adds to a scope.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "base/check.h"
#include "base/numerics.h"
#include "eval/evaluator.h"
#include "eval/free_names.h"
#include "eval/lists.h"
#include "syntax/foreign_words.h"

namespace tyndall::eval {

using namespace syntax;

static std::string_view spelling(Special special) {
  switch (special) {
    case Special::none:
      return {};
    case Special::time:
      return "time";
    case Special::frame:
      return "frame";
    case Special::pi:
      return "pi";
    case Special::p:
      return "p";
    case Special::P:
      return "P";
    case Special::n:
      return "n";
    case Special::N:
      return "N";
    case Special::uv:
      return "uv";
  }
  return {};
}

// True where bodies of that kind have the input.
static bool has_input(BodyKind kind, Special special) {
  switch (special) {
    case Special::p:
    case Special::P:
      return true;
    case Special::n:
    case Special::N:
    case Special::uv:
      return kind == BodyKind::material;
    case Special::none:
    case Special::time:
    case Special::frame:
    case Special::pi:
      return false;
  }
  return false;
}

// Functions do not see the inputs of the body that calls them.
bool Evaluator::sees(Special special) const {
  return in_body() && frames_.empty() && has_input(body_, special);
}

Value Evaluator::input(Special special) {
  const auto read = [&](vm::Input first, int count) {
    Value value = Value::of(count == 2 ? Type::pair : Type::vec, {});
    for (int i = 0; i < count; ++i)
      value.scalars[static_cast<std::size_t>(i)].node =
          builder_->input(static_cast<vm::Input>(static_cast<int>(first) + i));
    return value;
  };
  switch (special) {
    case Special::time:
      if (!in_body()) {
        ++context_.time_reads;
        return Value::number(context_.time);
      }
      return Value::of(Type::number, {Scalar{0, builder_->input(vm::Input::time)}});
    case Special::frame:
      ++context_.frame_reads;
      return Value::number(context_.frame);
    case Special::pi:
      return Value::number(pi);
    case Special::p:
      return read(vm::Input::p_x, 3);
    case Special::P:
      return read(vm::Input::P_x, 3);
    case Special::n:
      return read(vm::Input::n_x, 3);
    case Special::N:
      return read(vm::Input::N_x, 3);
    case Special::uv:
      return read(vm::Input::u, 2);
    case Special::none:
      break;
  }
  CHECK(special != Special::none);
  return {};
}

Value Evaluator::value_of_name(SymbolId symbol, Span span, const Scope& scope) {
  const Special special = names().special(symbol);
  if (special == Special::time || special == Special::frame || sees(special)) return input(special);
  if (const Binding* binding = scope.find(symbol)) {
    if (binding->timed)
      return in_body() ? function_of_time(*binding, span) : (++context_.time_reads, binding->value);
    return binding->value;
  }
  if (special == Special::pi) return input(special);
  if (const BuiltinEntry* entry = names().builtin(symbol)) {
    if (entry->row->result == "phase" && entry->row->parameters.empty()) {
      const SyntaxTree none;
      const CallExpr call{};
      const auto empty = std::make_shared<Scope>();
      CallSite site{*this, *entry, none, call, span, empty};
      return entry->bound(site);
    }
    return error(span, fmt::format("'{}' is a function", text(symbol)),
                 fmt::format("call it: {}", entry->row->example));
  }
  return unknown_name(symbol, span, &scope, {});
}

namespace {

// The name that an item defines; none if it defines none.
const syntax::Name* name_defined_by(const syntax::Item& item) {
  return std::visit(
      [](const auto& node) -> const syntax::Name* {
        using Node = std::decay_t<decltype(node)>;
        if constexpr (std::is_same_v<Node, syntax::LetItem> || std::is_same_v<Node, syntax::VarItem> ||
                      std::is_same_v<Node, syntax::FunctionItem> ||
                      std::is_same_v<Node, syntax::TemplateItem> || std::is_same_v<Node, syntax::BodyItem> ||
                      std::is_same_v<Node, syntax::ObjectItem>)
          return &node.name;
        else
          return nullptr;
      },
      item.node);
}

}  // namespace

// The span of the innermost block that holds the item; the whole file's for what stands in none.
static Span block_around(const SyntaxTree& tree, std::uint32_t item) {
  for (const syntax::Block& block : tree.blocks) {
    const auto items = tree.list_of_items(block.items);
    if (std::any_of(items.begin(), items.end(), [item](syntax::ItemId id) { return id.index == item; }))
      return block.span;
  }
  return tree[tree.file].span;
}

std::optional<DefinedElsewhere> Context::defined_elsewhere(SymbolId symbol, const Span& use) const {
  std::optional<DefinedElsewhere> in_a_block;
  for (const SyntaxTree* tree : trees) {
    const auto in_file = tree->list_of_items((*tree)[tree->file].items);
    for (std::uint32_t i = 0; i < tree->items.size(); ++i) {
      const syntax::Item& item = tree->items[i];
      const syntax::Name* name = name_defined_by(item);
      const bool around =
          item.span.source == use.source && item.span.begin <= use.begin && use.end <= item.span.end;
      if (!name || name->symbol != symbol || around) continue;
      if (std::any_of(in_file.begin(), in_file.end(), [i](syntax::ItemId id) { return id.index == i; }))
        return DefinedElsewhere{name->span, "a definition comes before its uses: move it up"};
      const Span block = block_around(*tree, i);
      if (block.source == use.source && block.begin <= use.begin && use.end <= block.end &&
          use.begin < name->span.begin)
        return DefinedElsewhere{name->span, "a definition comes before its uses: move it up"};
      if (!in_a_block) in_a_block = {name->span, "it is known in its own block only, below its definition"};
    }
  }
  return in_a_block;
}

bool Evaluator::report_defined_below(SymbolId symbol, Span span) {
  if (context_.diagnostics->full()) return false;
  const auto elsewhere = context_.defined_elsewhere(symbol, span);
  if (!elsewhere || elsewhere->place.source != span.source || elsewhere->place.begin < span.begin)
    return false;
  error(span, fmt::format("'{}' is defined further below", text(symbol)), std::string(elsewhere->help),
        {{elsewhere->place, "here"}});
  return true;
}

Value Evaluator::unknown_name(SymbolId symbol, Span span, const Scope* scope,
                              std::span<const SymbolId> locals, std::optional<BodyKind> inputs) {
  const std::string_view word = text(symbol);
  const Special special = names().special(symbol);
  if (special != Special::none && report_defined_below(symbol, span)) return {};
  if (special != Special::none) {
    if (in_body() && has_input(body_, special))
      return error(span, fmt::format("a function does not see '{}'", word), "pass it as an argument");
    if (in_body())
      return error(span, fmt::format("a medium has no '{}'", word), "its inputs are p, P and time");
    return error(span, fmt::format("'{}' is known only inside a medium or material", word),
                 frames_.empty() ? "" : "pass it as an argument");
  }
  if (context_.unread.may_define(symbol) || !context_.told_unknown.insert(symbol).second) {
    ++errors_reported_;
    return {};
  }
  if (context_.diagnostics->full())
    return error_once(span, fmt::format("nothing is named '{}' here", word), {}, {});
  if (const auto elsewhere = context_.defined_elsewhere(symbol, span))
    return error_once(span, fmt::format("nothing is named '{}' here", word), std::string(elsewhere->help),
                      {{elsewhere->place, fmt::format("'{}' is defined here", word)}});
  if (const std::string_view help = help_for_foreign_word(ForeignUse::value, word); !help.empty())
    return error_once(span, fmt::format("nothing is named '{}' here", word), std::string(help), {});
  // Those that nothing uses first: one of them may have been meant.
  std::vector<std::string_view> candidates;
  for (const bool used : {false, true})
    for (const Scope* s = scope; s; s = s->parent.get())
      for (const Binding& binding : s->bindings)
        if (binding.used == used) candidates.push_back(text(binding.symbol));
  for (const SymbolId local : locals) candidates.push_back(text(local));
  for (const auto& entry : names().builtins) candidates.push_back(entry->row->name);
  for (const Special known : {Special::p, Special::P, Special::n, Special::N, Special::uv, Special::time,
                              Special::frame, Special::pi})
    if (!has_input(BodyKind::material, known) || sees(known) || (inputs && has_input(*inputs, known)))
      candidates.push_back(spelling(known));
  const std::string_view meant = nearest(word, candidates);
  std::vector<Diagnostic::Note> notes;
  for (const Scope* s = scope; s && notes.empty(); s = s->parent.get())
    for (const Binding& binding : s->bindings)
      if (text(binding.symbol) == meant)
        notes.push_back({binding.definition, fmt::format("'{}' is defined here", meant)});
  return error_once(span, fmt::format("nothing is named '{}' here", word), did_you_mean(word, candidates),
                    std::move(notes));
}

void Evaluator::hold(const Scope& scope, const Value& value) {
  if (!value.holds_scope()) return;
  auto& kept = context_.names->scopes_with_definitions;
  if (kept.empty() || kept.back().get() != &scope) kept.push_back(scope.shared_from_this());
}

Value Evaluator::function_of_time(const Binding& binding, Span use) {
  if (binding.value.width() == 0 && binding.value.type != Type::list) return binding.value;
  frames_.push_back({nullptr, use});  // it sees what the scene sees
  Value value = evaluate(*binding.timed->tree, binding.timed->expr, binding.timed->scope);
  frames_.pop_back();
  return value;
}

Value Evaluator::evaluate_variable(const SyntaxTree& tree, syntax::ExprId expr,
                                   const std::shared_ptr<Scope>& scope, Value* current) {
  const std::uint64_t reads = context_.time_reads;
  const auto* entry = std::get_if<WithEntryExpr>(&tree[expr].node);
  const bool set = entry && current && set_entry(*this, tree, *entry, *current, scope);
  const Value value = set ? *current : evaluate(tree, expr, scope);
  if (in_body() || !frames_.empty() || context_.time_reads == reads || value.is_error()) return value;
  return error(tree[expr].span, "a `var` of a scene may not depend on `time`",
               "use `let`, or a function: what they give moves while the shutter is open");
}

void Evaluator::evaluate_into(Binding& binding, const SyntaxTree& tree, syntax::ExprId expr,
                              const std::shared_ptr<Scope>& scope, const Scope& holder) {
  const std::uint64_t reads = context_.time_reads;
  binding.value = evaluate(tree, expr, scope);
  if (!context_.shutter_open || in_body() || context_.time_reads == reads) return;
  binding.timed = std::make_shared<const Deferred>(Deferred{&tree, expr, scope});
  context_.names->scopes_with_definitions.push_back(holder.shared_from_this());
}

void Evaluator::bind(const std::shared_ptr<Scope>& scope, Binding binding) {
  const Special special = names().special(binding.symbol);
  if (special == Special::time || special == Special::frame || sees(special)) {
    error(binding.definition, fmt::format("'{}' cannot be redefined here", text(binding.symbol)),
          "choose another name");
    return;
  }
  if (const Binding* earlier = scope->find_here(binding.symbol)) {
    error(binding.definition, fmt::format("'{}' is defined twice", text(binding.symbol)),
          "choose another name", {{earlier->definition, "the first is here"}});
    return;
  }
  hold(*scope, binding.value);
  scope->bindings.push_back(std::move(binding));
}

void Evaluator::check_parameters(const SyntaxTree& tree, ListRef list, const BodyKind* body) {
  std::unordered_map<SymbolId, Span> places;
  for (const Parameter& parameter : tree.list_of_parameters(list)) {
    const Name& name = parameter.name;
    const Special special = names().special(name.symbol);
    if (special == Special::time || special == Special::frame || (body && has_input(*body, special)))
      error(name.span, fmt::format("'{}' cannot be redefined here", text(name.symbol)),
            "choose another name");
    if (const auto [first, is_new] = places.try_emplace(name.symbol, name.span); !is_new)
      error(name.span, fmt::format("'{}' is defined twice", text(name.symbol)), "choose another name",
            {{first->second, "the first is here"}});
  }
}

// Captured names that end in the key: what the body's block and the parameters take from its surroundings.
std::string Evaluator::key_of(const Body& body, const Scope& scope) {
  auto [entry, is_new] = context_.names->free_names.try_emplace(body.definition);
  if (is_new) entry->second = free_names(*body.tree, body.block);
  std::string key =
      fmt::format("{}:{}-{}", body.definition.source.index, body.definition.begin, body.definition.end);
  for (const SymbolId symbol : entry->second)
    if (const Binding* binding = scope.find(symbol)) append_key(key, *binding);
  return context_.names->keys.shortened(std::move(key));
}

void Evaluator::append_key(std::string& key, const Binding& binding) {
  fmt::format_to(std::back_inserter(key), ";{}=", binding.symbol.index);
  context_.names->keys.append(key, binding.value);
  // Equal when the shutter opens is not equal all the while.
  if (binding.timed)
    fmt::format_to(std::back_inserter(key), "({}@{})", binding.timed->expr.index,
                   fmt::ptr(binding.timed->scope.get()));
}

std::string Evaluator::key_of(const Scope& arguments) {
  std::string key;
  for (const Binding& binding : arguments.bindings) append_key(key, binding);
  return context_.names->keys.shortened(std::move(key));
}

bool Evaluator::define(const SyntaxTree& tree, const Item& item, const std::shared_ptr<Scope>& scope) {
  const auto add = [&](const Name& name, Value value, BindingKind kind) {
    bind(scope, {name.symbol, std::move(value), kind, name.span, false});
  };
  if (const auto* let = std::get_if<LetItem>(&item.node)) {
    Binding binding{let->name.symbol, {}, BindingKind::constant, let->name.span, false};
    evaluate_into(binding, tree, let->value, scope, *scope);
    bind(scope, std::move(binding));
  } else if (const auto* var = std::get_if<VarItem>(&item.node)) {
    add(var->name, evaluate_variable(tree, var->value, scope), BindingKind::variable);
  } else if (const auto* function = std::get_if<FunctionItem>(&item.node)) {
    check_parameters(tree, function->parameters, nullptr);
    check_definition(*this, tree, item, scope);
    if (function->value.valid() && function->steps.valid()) {
      const Span& steps = tree[function->steps].span;
      const std::string_view name = text(function->name.symbol);
      error({steps.source, steps.begin, steps.begin + 1},
            fmt::format("'=' is missing before the steps of '{}', which returns a value", name),
            fmt::format("write def {}(…) = {{ … }}; without '=' it is a template that places things", name));
    }
    add(function->name, Value::of_heavy(Type::function, Function{&tree, &item, scope}),
        BindingKind::constant);
  } else if (const auto* form = std::get_if<TemplateItem>(&item.node)) {
    check_parameters(tree, form->parameters, nullptr);
    add(form->name, Value::of_heavy(Type::function, Function{&tree, &item, scope}), BindingKind::constant);
  } else if (const auto* body = std::get_if<BodyItem>(&item.node)) {
    check_parameters(tree, body->parameters, &body->kind);
    check_definition(*this, tree, item, scope);
    Body value;
    value.tree = &tree;
    value.kind = body->kind;
    value.name = text(body->name.symbol);
    value.definition = body->name.span;
    value.block = body->body;
    value.item = body;
    value.definition_scope = scope;
    value.key = key_of(value, *scope);
    const Type type = body->kind == BodyKind::medium ? Type::medium : Type::material;
    add(body->name, Value::of_heavy(type, std::move(value)), BindingKind::constant);
  } else if (const auto* object = std::get_if<ObjectItem>(&item.node)) {
    check_parameters(tree, object->parameters, nullptr);
    add(object->name, Value::of_heavy(Type::object, ObjectDefinition{&tree, object, scope}),
        BindingKind::constant);
  } else {
    return false;
  }
  return true;
}

void Evaluator::report_unused(const Scope& scope) {
  if (context_.diagnostics->has_errors()) return;  // they may hide the uses
  for (const Binding& binding : scope.bindings) {
    if (binding.used || binding.kind == BindingKind::parameter || binding.value.is_error()) continue;
    if (binding.definition.source != context_.main_source || text(binding.symbol).starts_with('_')) continue;
    context_.diagnostics->warning(binding.definition, fmt::format("'{}' is never used", text(binding.symbol)),
                                  fmt::format("remove it, or call it _{}", text(binding.symbol)));
  }
}

}  // namespace tyndall::eval
