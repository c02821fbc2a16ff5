// Names in force at a place: a chain of scopes, innermost first.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "base/source.h"
#include "eval/value.h"
#include "syntax/tree.h"

namespace tyndall::eval {

struct Scope;

enum class BindingKind : std::uint8_t { constant, variable, parameter };

// An expression and where it stands.
struct Deferred {
  const syntax::SyntaxTree* tree = nullptr;
  syntax::ExprId expr;
  std::shared_ptr<Scope> scope;
};

struct Binding {
  syntax::SymbolId symbol;
  mutable Value value;  // changes for variables only
  BindingKind kind = BindingKind::constant;
  Span definition;
  mutable bool used = false;
  // Set while the shutter is open for a value that depends on `time`: bodies evaluate it as a function of it.
  mutable std::shared_ptr<const Deferred> timed{};
};

// One scope. Definitions in the same scope must differ in name; an inner scope may hide an outer one's.
// Add bindings with Evaluator::bind, which reports doubled names;
// a value that comes into a scope in another way goes through Evaluator::hold.
struct Scope : std::enable_shared_from_this<Scope> {
  std::shared_ptr<const Scope> parent;
  std::vector<Binding> bindings;  // only ever added to, at the end
  // The scope of a function's parameters: assignments inside do not reach the variables outside.
  bool assignments_end_here = false;
  mutable std::uint64_t variable_reads = 0;  // how often `find` came upon a variable here

  const Binding* find(syntax::SymbolId symbol) const;       // through the parents; marks it used
  const Binding* find_here(syntax::SymbolId symbol) const;  // this scope only; does not mark

 private:
  // The last binding of each name among the first `count`.
  struct Index {
    std::unordered_map<syntax::SymbolId, std::uint32_t> places;
    std::size_t count = 0;
  };
  mutable std::unique_ptr<Index> index_;  // of scopes with many bindings, made when first needed
};

}  // namespace tyndall::eval
