// Walks trees for their names: which are unknown, and which come from outside.
#include "eval/free_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "eval/symbol_stack.h"

namespace tyndall::eval {

using namespace syntax;

namespace {

// What is around a name: which inputs it may be.
enum class Around : std::uint8_t { outside, medium, material, unnamed_body };

// Visits every name that is looked up in a piece of tree, keeping account of the names that the piece itself
// defines. `Visitor` has `name(symbol, place, locals, around)`, and `call(tree, call, locals)` for every
// call.
template <class Visitor>
class FreeNames {
 public:
  // `choices`: the words that stand for values; null takes them for names.
  FreeNames(const SyntaxTree& tree, const Names* choices, Visitor visitor)
      : tree_(tree), choices_(choices), visitor_(std::move(visitor)) {}

  SymbolStack locals;

  bool is_local(SymbolId symbol) const { return locals.contains(symbol); }

  // The last child is walked by looping: long sums and `else if` chains are deep there.
  void expr(ExprId id) {
    while (id.valid()) {
      next_ = ExprId{};
      std::visit([&](const auto& node) { children(node, tree_[id].span); }, tree_[id].node);
      id = next_;
    }
  }

  void block(BlockId id) {
    const std::size_t outside = locals.size();
    for (const ItemId item : tree_.list_of_items(tree_[id].items))
      std::visit([&](const auto& node) { this->item(node); }, tree_[item].node);
    locals.shrink(outside);
  }

  void parameters(ListRef list) {
    for (const Parameter& parameter : tree_.list_of_parameters(list)) {
      expr(parameter.default_value);
      locals.push(parameter.name.symbol);
    }
  }

 private:
  void continue_with(ExprId id) { next_ = id; }
  void list(ListRef elements) {
    for (const ExprId id : tree_.list_of_exprs(elements)) expr(id);
    next_ = ExprId{};
  }

  void children(const ErrorExpr&, Span) {}
  void children(const NumberExpr&, Span) {}
  void children(const ColorExpr&, Span) {}
  void children(const BoolExpr&, Span) {}
  void children(const StringExpr& e, Span) {
    for (const ExprId id : tree_.strings[e.literal].values) expr(id);
    next_ = ExprId{};
  }
  void children(const NameExpr& e, Span span) {
    if (!is_local(e.symbol)) visitor_.name(e.symbol, span, locals, around_);
  }
  void children(const UnaryExpr& e, Span) { continue_with(e.operand); }
  void children(const BinaryExpr& e, Span) {
    expr(e.right);
    continue_with(e.left);
  }
  void children(const ConditionalExpr& e, Span) {
    expr(e.condition);
    expr(e.then_value);
    continue_with(e.else_value);
  }
  void children(const CallExpr& e, Span) {
    visitor_.call(tree_, e, locals);
    for (const Argument& argument : tree_.list_of_arguments(e.arguments)) {
      if (!choices_ || !is_choice(*choices_, tree_, argument)) expr(argument.value);
    }
    continue_with(e.callee);
  }
  void children(const IndexExpr& e, Span) {
    expr(e.list);
    continue_with(e.index);
  }
  void children(const MemberExpr& e, Span) { continue_with(e.object); }
  void children(const TupleExpr& e, Span) { list(e.elements); }
  void children(const ListExpr& e, Span) { list(e.elements); }
  void children(const WithEntryExpr& e, Span) {
    expr(e.list);
    expr(e.index);
    continue_with(e.entry);
  }
  void children(const ComprehensionExpr& node, Span) {
    const Comprehension& e = tree_.comprehensions[node.comprehension];
    expr(e.over);
    locals.push(e.name.symbol);
    expr(e.condition);
    expr(e.element);
    locals.shrink(locals.size() - 1);
    next_ = ExprId{};
  }
  void children(const RangeExpr& e, Span) {
    expr(e.first);
    expr(e.last);
    continue_with(e.step);
  }
  void children(const ThingExpr& e, Span) {
    expr(e.file);
    within(e.keyword.symbol.valid() ? around_ : Around::unnamed_body, e.block);
    next_ = ExprId{};
  }

  void item(const LetItem& i) { defined(i.name, i.value); }
  void item(const VarItem& i) { defined(i.name, i.value); }
  void item(const AssignItem& i) { expr(i.value); }
  void item(const FunctionItem& i) {
    function(i.parameters, i.value, i.steps);
    locals.push(i.name.symbol);
  }
  void item(const TemplateItem& i) {
    locals.push(i.name.symbol);  // a template may place itself
    function(i.parameters, ExprId{}, i.body);
  }
  void item(const BodyItem& i) {
    const std::size_t outside = locals.size();
    parameters(i.parameters);
    within(i.kind == BodyKind::medium ? Around::medium : Around::material, i.body);
    locals.shrink(outside);
    locals.push(i.name.symbol);
  }
  void item(const ObjectItem& i) {
    function(i.parameters, ExprId{}, i.body);
    locals.push(i.name.symbol);
  }
  void item(const PlaceItem& i) {
    if (!is_local(i.name.symbol)) visitor_.name(i.name.symbol, i.name.span, locals, around_);
    for (const Argument& argument : tree_.list_of_arguments(i.arguments)) expr(argument.value);
    block(i.block);
  }
  void item(const IncludeItem& i) { expr(i.file); }
  void item(const ForItem& i) {
    expr(i.range);
    locals.push(i.name.symbol);
    block(i.body);
    locals.shrink(locals.size() - 1);
  }
  void item(const IfItem& i) {
    expr(i.condition);
    block(i.then_block);
    if (i.else_block.valid()) block(i.else_block);
  }
  void item(const ReturnItem& i) { expr(i.value); }
  void item(const ParameterItem& i) {
    const auto is_choice = [&](ExprId id) {
      const auto* word = std::get_if<NameExpr>(&tree_[id].node);
      return word && choices_ && choices_->is_choice(i.name.symbol, word->symbol);
    };
    if (is_choice(i.value)) return;
    // Each of several may be a word.
    if (const auto* tuple = std::get_if<TupleExpr>(&tree_[i.value].node)) {
      for (const ExprId id : tree_.list_of_exprs(tuple->elements))
        if (!is_choice(id)) expr(id);
      return;
    }
    const auto* call = std::get_if<CallExpr>(&tree_[i.value].node);
    if (!call || !is_choice(call->callee)) return expr(i.value);
    for (const Argument& argument : tree_.list_of_arguments(call->arguments)) expr(argument.value);
  }
  void item(const ThingItem& i) {
    expr(i.file);
    block(i.block);
  }
  void item(const CallItem& i) { expr(i.call); }

  void within(Around around, BlockId id) {
    const Around outer = std::exchange(around_, around);
    block(id);
    around_ = outer;
  }
  void defined(const Name& name, ExprId value) {
    expr(value);
    locals.push(name.symbol);
  }
  void function(ListRef list_of_parameters, ExprId value, BlockId steps) {
    const std::size_t outside = locals.size();
    parameters(list_of_parameters);
    expr(value);
    if (steps.valid()) block(steps);
    locals.shrink(outside);
  }

  const SyntaxTree& tree_;
  const Names* choices_;
  Visitor visitor_;
  ExprId next_;
  Around around_ = Around::outside;
};

}  // namespace

namespace {

struct FoundNames {
  SymbolStack& found;

  void name(SymbolId symbol, Span, const SymbolStack&, Around) const {
    if (!found.contains(symbol)) found.push(symbol);
  }
  void call(const SyntaxTree&, const CallExpr&, const SymbolStack&) const {}
};

}  // namespace

bool is_choice(const Names& names, const SyntaxTree& tree, const Argument& argument) {
  const auto* word = std::get_if<NameExpr>(&tree[argument.value].node);
  if (!word) return false;
  return argument.name.symbol == names.ease ||
         (argument.name.symbol == names.filter && names.is_filter(word->symbol)) ||
         (argument.name.symbol == names.encoding && names.is_encoding(word->symbol));
}

std::vector<SymbolId> free_names(const SyntaxTree& tree, BlockId block) {
  SymbolStack found;
  FreeNames walk(tree, nullptr, FoundNames{found});
  walk.block(block);
  return found.all();
}

// Which inputs are known where names are checked: as the evaluator sees them, none (a def), or a body's.
class NameCheck {
 public:
  NameCheck(Evaluator& ev, const std::shared_ptr<const Scope>& scope) : ev_(ev), scope_(scope) {}

  std::optional<BodyKind> inputs_of{};
  bool in_function = false;
  SymbolId self{};

  void name(SymbolId symbol, Span span, const SymbolStack& locals, Around around) const {
    const Special special = ev_.names().special(symbol);
    if (special == Special::time || special == Special::frame || special == Special::pi) return;
    if (symbol == self) {
      ev_.error(span, fmt::format("'{}' may not use itself", ev_.text(symbol)),
                "loop with for, or give it another name");
      return;
    }
    if (special != Special::none && has_input(around, special)) return;
    if (special != Special::none && !in_function && (inputs_of ? body_has(special) : ev_.sees(special)))
      return;
    if (scope_->find(symbol) || ev_.names().builtin(symbol)) return;
    if (special != Special::none && ev_.report_defined_below(symbol, span)) return;
    if (special != Special::none && in_function)
      ev_.error(span, fmt::format("a function does not see '{}'", ev_.text(symbol)),
                "pass it as an argument");
    else if (special != Special::none && inputs_of)
      ev_.error(span, fmt::format("a medium has no '{}'", ev_.text(symbol)), "its inputs are p, P and time");
    else
      ev_.unknown_name(symbol, span, scope_.get(), locals.all(), inputs(around));
  }

  // Arguments are given to parameters that there are.
  void call(const SyntaxTree& tree, const CallExpr& call, const SymbolStack& locals) const {
    const auto* callee = std::get_if<NameExpr>(&tree[call.callee].node);
    if (!callee || locals.contains(callee->symbol)) return;
    const Binding* binding = scope_->find(callee->symbol);
    const BuiltinEntry* builtin = binding ? nullptr : ev_.names().builtin(callee->symbol);
    const auto arguments = tree.list_of_arguments(call.arguments);
    const auto is_named = [](const Argument& argument) { return argument.name.symbol.valid(); };
    if (std::any_of(arguments.begin(), arguments.end(), is_named))
      named_arguments(arguments, ev_.text(callee->symbol), binding, builtin);
    if (builtin && !builtin->free) options_have_names(tree, call, *builtin->row);
  }

 private:
  void named_arguments(std::span<const Argument> arguments, std::string_view callee, const Binding* binding,
                       const BuiltinEntry* builtin) const {
    std::vector<std::string_view> names;
    Span definition;
    if (binding) {
      const std::optional<Declared> declared = parameters_of(binding->value);
      if (!declared) return;
      const auto parameters = declared->tree->list_of_parameters(declared->parameters);
      names = parameter_names(ev_, parameters);
      if (!parameters.empty()) definition = parameters[0].name.span;
    } else if (builtin) {
      for (const vm::BuiltinParameter& parameter : builtin->row->parameters) names.push_back(parameter.name);
    } else {
      return;
    }
    const std::unordered_set<std::string_view> known(names.begin(), names.end());
    for (const Argument& argument : arguments)
      if (argument.name.symbol.valid() && !known.contains(ev_.text(argument.name.symbol)))
        report_unknown_parameter(ev_, callee, argument.name, names, definition);
  }

  void options_have_names(const SyntaxTree& tree, const CallExpr& call, const vm::Builtin& row) const {
    std::size_t position = 0;
    for (const Argument& argument : tree.list_of_arguments(call.arguments)) {
      const bool is_text = std::holds_alternative<StringExpr>(tree[argument.value].node);
      if (argument.name.symbol.valid() || is_text) return;  // a text is no place: that is told first
      if (position >= row.parameters.size()) return;
      if (row.parameters[position++].named) return report_option_without_name(ev_, row, tree, argument.value);
    }
  }

  bool body_has(Special special) const {
    return inputs_of == BodyKind::material || special == Special::p || special == Special::P;
  }

  std::optional<BodyKind> inputs(Around around) const {
    switch (around) {
      case Around::outside:
        return inputs_of;
      case Around::medium:
        return BodyKind::medium;
      case Around::material:
      case Around::unnamed_body:
        return BodyKind::material;
    }
    return std::nullopt;
  }
  static bool has_input(Around around, Special special) {
    switch (around) {
      case Around::outside:
        return false;
      case Around::medium:
        return special == Special::p || special == Special::P;
      case Around::material:
      case Around::unnamed_body:
        return true;
    }
    return false;
  }
  struct Declared {
    const SyntaxTree* tree;
    ListRef parameters;
  };
  static std::optional<Declared> parameters_of(const Value& value) {
    if (const auto* body = value.get<Body>(); body && body->item)
      return Declared{body->tree, body->item->parameters};
    const auto* function = value.get<Function>();
    if (!function) return std::nullopt;
    if (const auto* item = std::get_if<FunctionItem>(&function->item->node))
      return Declared{function->tree, item->parameters};
    if (const auto* form = std::get_if<TemplateItem>(&function->item->node))
      return Declared{function->tree, form->parameters};
    return std::nullopt;
  }

  Evaluator& ev_;
  const std::shared_ptr<const Scope>& scope_;
};

void Evaluator::check_names(const SyntaxTree& tree, ExprId id, const std::shared_ptr<const Scope>& scope) {
  FreeNames walk(tree, &names(), NameCheck(*this, scope));
  walk.expr(id);
}

void Evaluator::check_names(const SyntaxTree& tree, BlockId id, const std::shared_ptr<const Scope>& scope,
                            ListRef parameters, SymbolId local) {
  FreeNames walk(tree, &names(), NameCheck(*this, scope));
  if (local.valid()) walk.locals.push(local);
  walk.parameters(parameters);
  walk.block(id);
}

void check_definition(Evaluator& ev, const SyntaxTree& tree, const Item& item,
                      const std::shared_ptr<const Scope>& scope) {
  NameCheck check(ev, scope);
  if (const auto* function = std::get_if<FunctionItem>(&item.node)) {
    check.in_function = true;
    check.self = function->name.symbol;
    FreeNames walk(tree, &ev.names(), check);
    walk.parameters(function->parameters);
    walk.expr(function->value);
    if (function->steps.valid()) walk.block(function->steps);
  } else if (const auto* body = std::get_if<BodyItem>(&item.node)) {
    NameCheck defaults = check;
    defaults.in_function = true;
    FreeNames walk_defaults(tree, &ev.names(), defaults);
    walk_defaults.parameters(body->parameters);
    check.inputs_of = body->kind;
    FreeNames walk(tree, &ev.names(), check);
    walk.locals = walk_defaults.locals;
    walk.block(body->body);
  }
}

}  // namespace tyndall::eval
