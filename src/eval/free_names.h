// Names in a piece of tree, without evaluating it (internal to this layer).
#pragma once

#include "eval/calls.h"
#include "eval/evaluator.h"

namespace tyndall::eval {

// The names that a block uses and does not define itself, each once.
std::vector<syntax::SymbolId> free_names(const syntax::SyntaxTree& tree, syntax::BlockId block);

// True when an argument's value is one of the words that its parameter chooses from, not a name: `ease:
// smooth`.
bool is_choice(const Names& names, const syntax::SyntaxTree& tree, const syntax::Argument& argument);

// Checks the names inside a def or body at its definition: parameters and inputs of its own are known there,
// it must not name itself.
void check_definition(Evaluator& evaluator, const syntax::SyntaxTree& tree, const syntax::Item& item,
                      const std::shared_ptr<const Scope>& scope);

}  // namespace tyndall::eval
