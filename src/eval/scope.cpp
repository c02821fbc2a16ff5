// Looking names up.
#include "eval/scope.h"

namespace tyndall::eval {

// Up to so many bindings are looked through faster than a table is asked.
static constexpr std::size_t few_bindings = 16;

const Binding* Scope::find_here(syntax::SymbolId symbol) const {
  if (bindings.size() <= few_bindings) {
    for (auto it = bindings.rbegin(); it != bindings.rend(); ++it)
      if (it->symbol == symbol) return &*it;
    return nullptr;
  }
  if (!index_) index_ = std::make_unique<Index>();
  for (; index_->count < bindings.size(); ++index_->count)
    index_->places[bindings[index_->count].symbol] = static_cast<std::uint32_t>(index_->count);
  const auto found = index_->places.find(symbol);
  return found == index_->places.end() ? nullptr : &bindings[found->second];
}

const Binding* Scope::find(syntax::SymbolId symbol) const {
  for (const Scope* scope = this; scope; scope = scope->parent.get())
    if (const Binding* binding = scope->find_here(symbol)) {
      binding->used = true;
      if (binding->kind == BindingKind::variable) ++scope->variable_reads;
      return binding;
    }
  return nullptr;
}

}  // namespace tyndall::eval
