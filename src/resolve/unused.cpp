// Unused names: see unused.h.
#include "resolve/unused.h"

#include <algorithm>
#include <vector>

#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

// Collects the names in all blocks passed over.
void read_names(Run& run) {
  PassedOver& passed = run.passed_over;
  const syntax::SyntaxTree& tree = *run.main;
  std::vector<Span> spans;
  for (const auto& [block, place] : passed.blocks) spans.push_back(tree.blocks[block].span);
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
  // Blocks are apart or inside one another: with the inner ones left out they stand in order.
  std::vector<Span> outer;
  for (const Span& span : spans)
    if (outer.empty() || span.begin >= outer.back().end) outer.push_back(span);
  const auto note = [&](syntax::SymbolId name, const Span& at) {
    const auto after = std::upper_bound(outer.begin(), outer.end(), at.begin,
                                        [](std::uint32_t begin, const Span& s) { return begin < s.begin; });
    if (after != outer.begin() && at.begin < std::prev(after)->end) passed.names.insert(name.index);
  };
  for (const syntax::Expr& expr : tree.exprs)
    if (const auto* name = std::get_if<syntax::NameExpr>(&expr.node)) note(name->symbol, expr.span);
  for (const syntax::Item& item : tree.items)
    if (const auto* place = std::get_if<syntax::PlaceItem>(&item.node))
      note(place->name.symbol, place->name.span);
  passed.read = passed.blocks.size();
}

}  // namespace

void pass_over(Run& run, const Site& site, syntax::BlockId block, syntax::ListRef parameters,
               syntax::SymbolId variable) {
  if (site.tree == run.main)
    run.passed_over.blocks.try_emplace(block.index, PassedOver::Place{site.scope, parameters, variable});
}

void report_unused(Run& run, const eval::Scope& scope) {
  if (run.diagnostics.has_errors()) return;
  const auto unused = [](const eval::Binding& b) {
    return !b.used && b.kind != eval::BindingKind::parameter;
  };
  if (std::none_of(scope.bindings.begin(), scope.bindings.end(), unused)) return;
  if (run.passed_over.read < run.passed_over.blocks.size()) read_names(run);
  for (const eval::Binding& binding : scope.bindings)
    if (run.passed_over.names.contains(binding.symbol.index)) binding.used = true;
  run.evaluator.report_unused(scope);
}

}  // namespace tyndall::resolve
