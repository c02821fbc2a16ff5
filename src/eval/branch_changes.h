// What one branch of an `if` changes while both are run.
#pragma once

#include <unordered_map>
#include <vector>

#include "eval/evaluator.h"
#include "eval/scope.h"
#include "eval/value.h"
#include "syntax/tree.h"

namespace tyndall::eval {

// What a branch changed: variables of the scopes outside of it, and outputs.
struct Changes {
  struct Variable {
    const Binding* binding;
    Value before, after;
  };
  struct Output {
    const syntax::Item* item;
    const syntax::AssignItem* assign;
    Value value;
    Evaluator::Branches branches;
  };
  const Scope* outside = nullptr;
  std::vector<Variable> variables;
  std::vector<Output> outputs;

  // Notes a variable that is about to change, the first time.
  void note(const Binding& binding) {
    if (places_.try_emplace(&binding, variables.size()).second)
      variables.push_back({&binding, binding.value, {}});
  }
  // What it was left at here; its value outside where this branch did not change it.
  const Value& after(const Binding& binding) const {
    const auto place = places_.find(&binding);
    return place == places_.end() ? binding.value : variables[place->second].after;
  }
  bool changed(const Binding& binding) const { return places_.contains(&binding); }

 private:
  std::unordered_map<const Binding*, std::size_t> places_;
};

}  // namespace tyndall::eval
