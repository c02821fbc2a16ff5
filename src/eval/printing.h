// `print(…)` as a statement.
#pragma once

#include "eval/evaluator.h"

namespace tyndall::eval {

// True after evaluating a call that stands as a statement, when what it calls is the built-in `print`.
bool ran_print(Evaluator& evaluator, const syntax::SyntaxTree& tree, const syntax::CallItem& item,
               const std::shared_ptr<Scope>& scope);
bool ran_print(Evaluator& evaluator, const syntax::SyntaxTree& tree, const syntax::Item& item,
               const std::shared_ptr<Scope>& scope);

}  // namespace tyndall::eval
