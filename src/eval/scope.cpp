// Looking names up.
#include "eval/scope.h"

namespace tyndall::eval {

const Binding* Scope::find_here(syntax::SymbolId symbol) const {
  for (auto it = bindings.rbegin(); it != bindings.rend(); ++it)
    if (it->symbol == symbol) return &*it;
  return nullptr;
}

const Binding* Scope::find(syntax::SymbolId symbol) const {
  for (const Scope* scope = this; scope; scope = scope->parent.get())
    if (const Binding* binding = scope->find_here(symbol)) {
      binding->used = true;
      return binding;
    }
  return nullptr;
}

}  // namespace tyndall::eval
