// Unused names: see unused_names.h.
#include "resolve/checks/unused_names.h"

#include <algorithm>
#include <vector>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// Every name that the main file uses, in the order of the text.
std::vector<PassedOver::Use> uses_of(const syntax::SyntaxTree& tree) {
  std::vector<PassedOver::Use> uses;
  for (const syntax::Expr& expr : tree.exprs)
    if (const auto* name = std::get_if<syntax::NameExpr>(&expr.node))
      uses.push_back({expr.span.begin, name->symbol});
  for (const syntax::Item& item : tree.items)
    if (const auto* place = std::get_if<syntax::PlaceItem>(&item.node))
      uses.push_back({place->name.span.begin, place->name.symbol});
  std::sort(uses.begin(), uses.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return uses;
}

// Collects the names in the blocks passed over since the last time. Of blocks within others the outer come
// first, as they are met, so each part of the text is read once.
void read_names(Run& run) {
  PassedOver& passed = run.passed_over;
  if (passed.uses.empty()) passed.uses = uses_of(*run.main);
  const auto is_before = [](const PassedOver::Use& use, std::uint32_t begin) { return use.begin < begin; };
  for (const std::uint32_t block : passed.unread) {
    const Span& span = run.main->blocks[block].span;
    const auto around = passed.read.upper_bound(span.begin);
    if (around != passed.read.begin() && std::prev(around)->second >= span.end) continue;
    passed.read[span.begin] = span.end;
    auto use = std::lower_bound(passed.uses.begin(), passed.uses.end(), span.begin, is_before);
    for (; use != passed.uses.end() && use->begin < span.end; ++use) passed.names.insert(use->symbol);
  }
  passed.unread.clear();
}

}  // namespace

void pass_over(Run& run, const Site& site, syntax::BlockId block, syntax::ListRef parameters,
               syntax::SymbolId variable) {
  if (site.tree != run.main) return;
  const PassedOver::Place place{site.scope, parameters, variable};
  if (run.passed_over.blocks.try_emplace(block.index, place).second)
    run.passed_over.unread.push_back(block.index);
}

void report_unused(Run& run, const eval::Scope& scope) {
  if (run.diagnostics.has_errors()) return;
  const auto unused = [](const eval::Binding& b) {
    return !b.used && b.kind != eval::BindingKind::parameter;
  };
  if (std::none_of(scope.bindings.begin(), scope.bindings.end(), unused)) return;
  read_names(run);
  for (const eval::Binding& binding : scope.bindings)
    if (run.passed_over.names.contains(binding.symbol)) binding.used = true;
  run.evaluator.report_unused(scope);
}

}  // namespace tyndall::resolve
