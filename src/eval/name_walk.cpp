// Walks trees for their names: which are unknown, and which come from outside.
#include "eval/name_walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::eval {

using namespace syntax;

namespace {

// Visits every name that is looked up in a piece of tree, keeping account of the names that the piece itself
// defines. `Visitor` is called with the name's symbol and place.
template <class Visitor>
class NameWalk {
 public:
  NameWalk(const SyntaxTree& tree, SymbolId ease, Visitor visitor)
      : tree_(tree), ease_(ease), visitor_(std::move(visitor)) {}

  std::vector<SymbolId> locals;

  bool is_local(SymbolId symbol) const {
    return std::find(locals.begin(), locals.end(), symbol) != locals.end();
  }

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
    locals.resize(outside);
  }

  void parameters(ListRef list) {
    for (const Parameter& parameter : tree_.list_of_parameters(list)) {
      expr(parameter.default_value);
      locals.push_back(parameter.name.symbol);
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
    if (!is_local(e.symbol)) visitor_(e.symbol, span, locals);
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
    for (const Argument& argument : tree_.list_of_arguments(e.arguments)) {
      const bool is_word =
          argument.name.symbol == ease_ && std::holds_alternative<NameExpr>(tree_[argument.value].node);
      if (!is_word) expr(argument.value);
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
  void children(const RangeExpr& e, Span) {
    expr(e.first);
    expr(e.last);
    continue_with(e.step);
  }
  void children(const ThingExpr& e, Span) {
    expr(e.file);
    block(e.block);
    next_ = ExprId{};
  }

  void item(const LetItem& i) { defined(i.name, i.value); }
  void item(const VarItem& i) { defined(i.name, i.value); }
  void item(const AssignItem& i) { expr(i.value); }
  void item(const FunctionItem& i) {
    function(i.parameters, i.value, i.steps);
    locals.push_back(i.name.symbol);
  }
  void item(const TemplateItem& i) {
    locals.push_back(i.name.symbol);  // a template may place itself
    function(i.parameters, ExprId{}, i.body);
  }
  void item(const BodyItem& i) {
    function(i.parameters, ExprId{}, i.body);
    locals.push_back(i.name.symbol);
  }
  void item(const ObjectItem& i) {
    block(i.body);
    locals.push_back(i.name.symbol);
  }
  void item(const PlaceItem& i) { block(i.block); }
  void item(const IncludeItem& i) { expr(i.file); }
  void item(const ForItem& i) {
    expr(i.range);
    locals.push_back(i.name.symbol);
    block(i.body);
    locals.pop_back();
  }
  void item(const IfItem& i) {
    expr(i.condition);
    block(i.then_block);
    if (i.else_block.valid()) block(i.else_block);
  }
  void item(const ReturnItem& i) { expr(i.value); }
  void item(const ParameterItem& i) {
    // A bare word may be one of the parameter's choices: only its reader knows.
    if (!std::holds_alternative<NameExpr>(tree_[i.value].node)) expr(i.value);
  }
  void item(const ThingItem& i) {
    expr(i.file);
    block(i.block);
  }
  void item(const CallItem& i) { expr(i.call); }

  void defined(const Name& name, ExprId value) {
    expr(value);
    locals.push_back(name.symbol);
  }
  void function(ListRef list_of_parameters, ExprId value, BlockId steps) {
    const std::size_t outside = locals.size();
    parameters(list_of_parameters);
    expr(value);
    if (steps.valid()) block(steps);
    locals.resize(outside);
  }

  const SyntaxTree& tree_;
  SymbolId ease_;
  Visitor visitor_;
  ExprId next_;
};

}  // namespace

std::vector<SymbolId> free_names(const SyntaxTree& tree, BlockId block) {
  std::vector<SymbolId> found;
  NameWalk walk(tree, SymbolId{}, [&](SymbolId symbol, Span, const std::vector<SymbolId>&) {
    if (std::find(found.begin(), found.end(), symbol) == found.end()) found.push_back(symbol);
  });
  walk.block(block);
  return found;
}

// Which inputs are known where names are checked: as the evaluator sees them, none (a def), or a body's.
class NameCheck {
 public:
  NameCheck(Evaluator& ev, const std::shared_ptr<const Scope>& scope) : ev_(ev), scope_(scope) {}

  std::optional<BodyKind> inputs_of{};
  bool in_function = false;
  SymbolId self{};

  void operator()(SymbolId symbol, Span span, const std::vector<SymbolId>& locals) const {
    const Special special = ev_.names().special(symbol);
    if (special == Special::time || special == Special::frame || special == Special::pi) return;
    if (symbol == self) {
      ev_.error(span, fmt::format("'{}' may not use itself", ev_.text(symbol)),
                "loop with for, or give it another name");
      return;
    }
    if (special != Special::none && !in_function && (inputs_of ? body_has(special) : ev_.sees(special)))
      return;
    if (scope_->find(symbol) || ev_.names().builtin(symbol)) return;
    if (special != Special::none && in_function)
      ev_.error(span, fmt::format("a function does not see '{}'", ev_.text(symbol)),
                "pass it as an argument");
    else if (special != Special::none && inputs_of)
      ev_.error(span, fmt::format("a medium has no '{}'", ev_.text(symbol)), "its inputs are p, P and time");
    else
      ev_.unknown_name(symbol, span, scope_.get(), locals);
  }

 private:
  bool body_has(Special special) const {
    return inputs_of == BodyKind::material || special == Special::p || special == Special::P;
  }

  Evaluator& ev_;
  const std::shared_ptr<const Scope>& scope_;
};

void Evaluator::check_names(const SyntaxTree& tree, ExprId id, const std::shared_ptr<const Scope>& scope) {
  NameWalk walk(tree, names().ease, NameCheck(*this, scope));
  walk.expr(id);
}

void Evaluator::check_names(const SyntaxTree& tree, BlockId id, const std::shared_ptr<const Scope>& scope) {
  NameWalk walk(tree, names().ease, NameCheck(*this, scope));
  walk.block(id);
}

void check_definition(Evaluator& ev, const SyntaxTree& tree, const Item& item,
                      const std::shared_ptr<const Scope>& scope) {
  NameCheck check(ev, scope);
  if (const auto* function = std::get_if<FunctionItem>(&item.node)) {
    check.in_function = true;
    check.self = function->name.symbol;
    NameWalk walk(tree, ev.names().ease, check);
    walk.parameters(function->parameters);
    walk.expr(function->value);
    if (function->steps.valid()) walk.block(function->steps);
  } else if (const auto* body = std::get_if<BodyItem>(&item.node)) {
    NameCheck defaults = check;
    defaults.in_function = true;
    NameWalk walk_defaults(tree, ev.names().ease, defaults);
    walk_defaults.parameters(body->parameters);
    check.inputs_of = body->kind;
    NameWalk walk(tree, ev.names().ease, check);
    walk.locals = walk_defaults.locals;
    walk.block(body->body);
  }
}

}  // namespace tyndall::eval
