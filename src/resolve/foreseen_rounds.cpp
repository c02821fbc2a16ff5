#include "resolve/foreseen_rounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/overloaded.h"

namespace tyndall::resolve {

namespace {

// The number that an expression is by its text alone.
std::optional<double> literal(const syntax::SyntaxTree& tree, syntax::ExprId id) {
  if (!id.valid()) return std::nullopt;
  if (const auto* number = std::get_if<syntax::NumberExpr>(&tree[id].node)) return number->value;
  return std::nullopt;
}

// What a `for` goes over, when that is a range of literal numbers or a list: zero when it is not known.
double literal_rounds(const syntax::SyntaxTree& tree, syntax::ExprId id) {
  if (const auto* list = std::get_if<syntax::ListExpr>(&tree[id].node)) return list->elements.count;
  const auto* range = std::get_if<syntax::RangeExpr>(&tree[id].node);
  if (!range || range->step.valid()) return 0;
  const auto first = literal(tree, range->first), last = literal(tree, range->last);
  if (!first || !last || *last < *first) return 0;
  const double length = *last - *first;
  return range->excludes_last ? std::ceil(length) : std::floor(length) + 1;
}

// Counts in one body: that of a template, or a block of the file.
class Count {
 public:
  Count(Run& run, const syntax::SyntaxTree& tree) : run_(run), tree_(tree) {}

  void hide(syntax::SymbolId name) { hidden_.push_back(name); }

  double block(syntax::BlockId id) {
    if (!id.valid()) return 0;
    const auto items = tree_.list_of_items(tree_[id].items);
    // What an include brings may hide any name.
    const bool includes = std::any_of(items.begin(), items.end(), [&](syntax::ItemId item) {
      return std::holds_alternative<syntax::IncludeItem>(tree_[item].node);
    });
    if (includes) return 0;
    const std::size_t outer = hidden_.size();
    for (const syntax::ItemId item : items) hide_defined(tree_[item]);
    double sum = 0;
    for (const syntax::ItemId item : items) sum += of_item(tree_[item]);
    hidden_.resize(outer);
    return sum;
  }

 private:
  void hide_defined(const syntax::Item& item) {
    std::visit(Overloaded{[&](const syntax::LetItem& i) { hide(i.name.symbol); },
                          [&](const syntax::VarItem& i) { hide(i.name.symbol); },
                          [&](const syntax::FunctionItem& i) { hide(i.name.symbol); },
                          [&](const syntax::TemplateItem& i) { hide(i.name.symbol); },
                          [&](const syntax::BodyItem& i) { hide(i.name.symbol); },
                          [&](const syntax::ObjectItem& i) { hide(i.name.symbol); }, [](const auto&) {}},
               item.node);
  }

  double of_item(const syntax::Item& item) {
    return std::visit(
        Overloaded{
            [&](const syntax::CallItem& i) { return call(i); },
            [&](const syntax::ForItem& i) { return loop(i); },
            [&](const syntax::IfItem& i) { return std::min(block(i.then_block), block(i.else_block)); },
            [&](const syntax::ThingItem& i) { return block(i.block); },
            [](const syntax::PlaceItem&) { return 1.0; }, [](const auto&) { return 0.0; }},
        item.node);
  }

  double call(const syntax::CallItem& item) {
    const auto* call = std::get_if<syntax::CallExpr>(&tree_[item.call].node);
    const auto* name = call ? std::get_if<syntax::NameExpr>(&tree_[call->callee].node) : nullptr;
    if (!name || std::find(hidden_.begin(), hidden_.end(), name->symbol) != hidden_.end()) return 0;
    const eval::Binding* binding = run_.file_scope->find_here(name->symbol);
    const auto* called = binding ? binding->value.get<eval::Function>() : nullptr;
    return called ? foreseen_rounds(run_, *called) : 0;
  }

  double loop(const syntax::ForItem& item) {
    const double rounds = literal_rounds(tree_, item.range);
    if (rounds == 0) return 0;
    hide(item.name.symbol);
    const double inside = block(item.body);
    hidden_.pop_back();
    return rounds * (1 + inside);
  }

  Run& run_;
  const syntax::SyntaxTree& tree_;
  std::vector<syntax::SymbolId> hidden_;  // names that mean something else here than in the file's scope
};

}  // namespace

double foreseen_rounds(Run& run, const syntax::SyntaxTree& tree, syntax::BlockId block) {
  return Count(run, tree).block(block);
}

double foreseen_rounds(Run& run, const eval::Function& called) {
  const auto* definition = std::get_if<syntax::TemplateItem>(&called.item->node);
  if (!definition || called.scope != run.file_scope) return 0;
  // While it is counted it counts nothing: one that calls itself is told by its depth.
  const auto [known, is_new] = run.foreseen_calls.try_emplace(definition, 0);
  if (!is_new) return known->second;
  Count count(run, *called.tree);
  for (const syntax::Parameter& p : called.tree->list_of_parameters(definition->parameters))
    count.hide(p.name.symbol);
  const double rounds = 1 + count.block(definition->body);
  return run.foreseen_calls[definition] = rounds;
}

}  // namespace tyndall::resolve
