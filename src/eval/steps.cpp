// Runs the steps of functions and bodies. A condition that is known picks its branch; one that differs from
// place to place runs both, and what they set is chosen value by value.
#include <fmt/format.h>

#include <algorithm>

#include "eval/branch_changes.h"
#include "eval/evaluator.h"
#include "eval/lists.h"
#include "eval/operators.h"
#include "eval/printing.h"
#include "eval/symbol_stack.h"
#include "syntax/foreign_words.h"

namespace tyndall::eval {

using namespace syntax;

namespace {

// A value returned where `condition` holds, while the function goes on elsewhere.
struct PartialReturn {
  Scalar condition;
  Value value;
  Span span;
};

class Steps {
 public:
  Steps(Evaluator& ev, const SyntaxTree& tree, const Evaluator::Outputs* outputs)
      : ev_(ev), tree_(tree), outputs_(outputs) {}

  std::optional<Value> run_all(BlockId block, const std::shared_ptr<Scope>& scope) {
    std::optional<Value> result = run(block, scope);
    for (auto partial = partial_returns_.rbegin(); result && partial != partial_returns_.rend(); ++partial)
      result = select(ev_, partial->condition, partial->value, *result, partial->span);
    return result;
  }

 private:
  // Runs the items in `scope`; a value when the block returned.
  std::optional<Value> run(BlockId block, const std::shared_ptr<Scope>& scope) {
    for (const ItemId id : tree_.list_of_items(tree_[block].items)) {
      const Item& item = tree_[id];
      std::optional<Value> returned;
      if (const auto* loop = std::get_if<ForItem>(&item.node))
        returned = run_loop(*loop, scope);
      else if (const auto* choice = std::get_if<IfItem>(&item.node))
        returned = run_choice(*choice, item.span, scope);
      else if (const auto* assign = std::get_if<AssignItem>(&item.node))
        this->assign(item, *assign, scope);
      else if (const auto* result = std::get_if<ReturnItem>(&item.node))
        returned = this->result(*result, item.span, scope);
      else if (!ran_print(ev_, tree_, item, scope) && !ev_.define(tree_, item, scope))
        ev_.error(item.span,
                  outputs_ ? "a body only computes: nothing can be placed in it"
                           : "a function only computes: nothing can be placed in it",
                  outputs_ ? "use let, var, if, for and outputs such as density = 1"
                           : "write def name(…) { … } without = for a template that places things");
      if (returned) return returned;
    }
    ev_.report_unused(*scope);
    return std::nullopt;
  }

  static std::shared_ptr<Scope> below(const std::shared_ptr<Scope>& scope) {
    auto inner = std::make_shared<Scope>();
    inner->parent = scope;
    return inner;
  }

  std::optional<Value> result(const ReturnItem& item, Span span, const std::shared_ptr<Scope>& scope) {
    if (!outputs_) return ev_.evaluate(tree_, item.value, scope);
    ev_.error(span, "return belongs in a function", "a body sets outputs, for instance density = 1");
    return std::nullopt;
  }

  struct Found {
    const Scope* scope = nullptr;
    const Binding* binding = nullptr;
    bool outside_of_branch = false;
  };
  // The nearest binding of the name up to the function's edge.
  Found find(SymbolId symbol, const Scope* scope) const {
    bool passed = false;
    for (; scope; scope = scope->parent.get()) {
      passed |= !branches_.empty() && branches_.back()->outside == scope;
      if (const Binding* binding = scope->find_here(symbol)) return {scope, binding, passed};
      if (scope->assignments_end_here) break;
    }
    return {};
  }

  void assign(const Item& item, const AssignItem& assign, const std::shared_ptr<Scope>& scope) {
    const Found found = find(assign.name.symbol, scope.get());
    if (sets_own_entry(found, assign, scope)) return;
    const Value value = ev_.evaluate(tree_, assign.value, scope);
    if (found.binding && found.binding->kind == BindingKind::variable) {
      set(found, value, assign.name.span);
    } else if (outputs_) {
      if (is_output(ev_.text(assign.name.symbol)))
        set_output(item, assign, value);
      else
        ev_.report_no_output(*outputs_, assign.name, variables(scope.get()));
    } else if (found.binding || scope->find(assign.name.symbol)) {
      const Binding* constant = found.binding ? found.binding : scope->find(assign.name.symbol);
      ev_.error(assign.name.span, fmt::format("'{}' cannot be changed here", ev_.text(assign.name.symbol)),
                constant->kind == BindingKind::variable ? "a function changes its own variables only"
                                                        : "define it with var to change it",
                {{constant->definition, "it is defined here"}});
    } else {
      std::string help = did_you_mean(ev_.text(assign.name.symbol), variables(scope.get()));
      if (help.empty()) help = fmt::format("write let {} = … to define it", ev_.text(assign.name.symbol));
      ev_.error(assign.name.span, fmt::format("nothing is named '{}' here", ev_.text(assign.name.symbol)),
                std::move(help));
    }
  }

  // `l[i] = x` in place, where nothing else has the list.
  bool sets_own_entry(const Found& found, const AssignItem& assign, const std::shared_ptr<Scope>& scope) {
    const auto* entry = std::get_if<WithEntryExpr>(&tree_[assign.value].node);
    if (!entry || !found.binding || found.binding->kind != BindingKind::variable || found.outside_of_branch)
      return false;
    if (!set_entry(ev_, tree_, *entry, found.binding->value, scope)) return false;
    found.binding->used = true;
    ev_.hold(*found.scope, found.binding->value);
    return true;
  }

  bool is_output(std::string_view name) const {
    return std::find(outputs_->names.begin(), outputs_->names.end(), name) != outputs_->names.end();
  }

  // What may be set from here, the body's outputs first.
  std::vector<std::string_view> settable(const Scope* scope) const {
    std::vector<std::string_view> names = variables(scope);
    if (outputs_) names.insert(names.begin(), outputs_->names.begin(), outputs_->names.end());
    return names;
  }

  // Variables that can be set from here.
  std::vector<std::string_view> variables(const Scope* scope) const {
    std::vector<std::string_view> names;
    for (; scope; scope = scope->parent.get()) {
      for (const Binding& binding : scope->bindings)
        if (binding.kind == BindingKind::variable) names.push_back(ev_.text(binding.symbol));
      if (scope->assignments_end_here) break;
    }
    return names;
  }

  void set(const Found& found, const Value& value, Span span) {
    const Binding& binding = *found.binding;
    if (!value.is_error() && !binding.value.is_error() && value.type != binding.value.type &&
        !(is_numeric(value.type) && is_numeric(binding.value.type))) {
      ev_.error(span,
                fmt::format("'{}' is {}, but this is {}", ev_.text(binding.symbol),
                            describe(binding.value.type), describe(value.type)),
                "a variable keeps its kind", {{binding.definition, "it is defined here"}});
      return;
    }
    if (found.outside_of_branch) branches_.back()->note(binding);
    ev_.hold(*found.scope, value);
    binding.value = value;
  }

  void set_output(const Item& item, const AssignItem& assign, const Value& value) {
    const Value read = outputs_->read(assign, value);
    set_output({&item, &assign, read, {{item.span}, Scalar{0}, read.known()}});
  }
  void set_output(Changes::Output output) {
    if (branches_.empty())
      outputs_->assign(*output.item, *output.assign, output.value, output.branches);
    else
      branches_.back()->outputs.push_back(std::move(output));
  }

  std::optional<Value> run_loop(const ForItem& loop, const std::shared_ptr<Scope>& scope) {
    const Span span = tree_[loop.range].span;
    const Value over = ev_.evaluate(tree_, loop.range, scope);
    if (over.is_error()) {
      poison(loop.body, scope);
      return std::nullopt;
    }
    const std::optional<Rounds> found = rounds_of(ev_, over, span, "for i in 0..<8 { … }");
    if (!found) return std::nullopt;
    const RangeValue* range = found->range;
    const std::int64_t rounds = found->count;
    if (rounds == 0) {
      const auto inner = below(scope);
      inner->bindings.push_back(
          {loop.name.symbol, Value::number(0), BindingKind::parameter, loop.name.span, false});
      ev_.check_names(tree_, loop.body, inner);
    }
    if (!ev_.may_iterate(rounds, span)) return std::nullopt;
    for (std::int64_t i = 0; i < rounds; ++i) {
      const auto inner = below(scope);
      const Value value = found->at(i);
      ev_.bind(inner, {loop.name.symbol, value, BindingKind::parameter, loop.name.span, false});
      if (range && range->differs())
        run_round(*range, value.scalars[0], loop, span, inner);
      else if (std::optional<Value> returned = run(loop.body, inner))
        return returned;
      if (ev_.context().diagnostics->full()) break;
    }
    return std::nullopt;
  }

  // A round that only some lanes take: those where the loop's end is not reached yet.
  void run_round(const RangeValue& range, const Scalar& at, const ForItem& loop, Span span,
                 const std::shared_ptr<Scope>& inner) {
    const Scalar taken =
        ev_.emit(range.excludes_last ? vm::Op::less : vm::Op::less_equal, {at, range.lane_last}, span);
    Changes changes;
    std::vector<PartialReturn> partial;
    const std::optional<Value> returned = run_branch(loop.body, inner, changes, partial);
    for (PartialReturn& p : partial) {
      p.condition = ev_.emit(vm::Op::logical_and, {taken, p.condition}, span);
      partial_returns_.push_back(p);
    }
    if (returned) partial_returns_.push_back({taken, *returned, span});
    for (const Changes::Output& output : changes.outputs)
      ev_.error(output.assign->name.span,
                fmt::format("'{}' is set in a loop that may end before its first round",
                            ev_.text(output.assign->name.symbol)),
                "gather the value in a var and set the output after the loop");
    merge(taken, changes, {}, returned.has_value(), false, *inner, span);
  }

  // After an error in a header: nothing inside is known, and nothing is complained of that follows from it.
  void poison(BlockId block, const std::shared_ptr<Scope>& scope) {
    for (const ItemId id : tree_.list_of_items(tree_[block].items)) {
      const Item& item = tree_[id];
      if (const auto* assign = std::get_if<AssignItem>(&item.node)) {
        const Found found = find(assign->name.symbol, scope.get());
        if (found.binding && found.binding->kind == BindingKind::variable)
          set(found, {}, assign->name.span);
        else if (outputs_ && is_output(ev_.text(assign->name.symbol)))
          set_output(item, *assign, {});
      } else if (const auto* choice = std::get_if<IfItem>(&item.node)) {
        poison(choice->then_block, scope);
      } else if (const auto* loop = std::get_if<ForItem>(&item.node)) {
        poison(loop->body, scope);
      }
    }
  }

  // Outputs that a block sets, by what is written: variables of its own or of `scope` are none.
  // One that is misspelt, and told so, counts as what was meant.
  struct SetOutput {
    const AssignItem* assign;
    std::string_view meant;
  };
  void outputs_of(BlockId block, const Scope* scope, SymbolStack& own, std::vector<SetOutput>& found) const {
    for (const ItemId id : tree_.list_of_items(tree_[block].items)) {
      const Item& item = tree_[id];
      if (const auto* var = std::get_if<VarItem>(&item.node)) own.push(var->name.symbol);
      if (const auto* loop = std::get_if<ForItem>(&item.node)) outputs_of(loop->body, scope, own, found);
      if (const auto* choice = std::get_if<IfItem>(&item.node))
        outputs_of(choice->then_block, scope, own, found);
      const auto* assign = std::get_if<AssignItem>(&item.node);
      if (!assign || own.contains(assign->name.symbol)) continue;
      const Found variable = find(assign->name.symbol, scope);
      if (variable.binding && variable.binding->kind == BindingKind::variable) continue;
      const std::string_view name = ev_.text(assign->name.symbol);
      const std::string_view meant = is_output(name) ? name : nearest(name, settable(scope));
      if (!meant.empty()) found.push_back({assign, meant});
    }
  }

  // Reports outputs that only one of the branches sets.
  void compare_outputs(const IfItem& item, const Scope* scope) {
    std::vector<SetOutput> in_then, in_else;
    SymbolStack own;
    outputs_of(item.then_block, scope, own, in_then);
    own.shrink(0);
    if (item.else_block.valid()) outputs_of(item.else_block, scope, own, in_else);
    const auto lacks = [](const std::vector<SetOutput>& list, std::string_view name) {
      return std::none_of(list.begin(), list.end(), [&](const SetOutput& set) { return set.meant == name; });
    };
    for (const auto& [here, there] : {std::pair{&in_then, &in_else}, std::pair{&in_else, &in_then}})
      for (const auto& [assign, meant] : *here)
        if (is_output(ev_.text(assign->name.symbol)) && lacks(*there, meant))
          ev_.error(assign->name.span, fmt::format("'{}' is set in one branch only", meant),
                    item.else_block.valid() ? "set it in the other branch too"
                                            : "add an else branch that sets it too");
  }

  std::optional<Value> run_choice(const IfItem& item, Span span, const std::shared_ptr<Scope>& scope) {
    if (outputs_) compare_outputs(item, scope.get());
    const Value condition = ev_.evaluate_as(Type::boolean, tree_, item.condition, scope, "'if'");
    if (condition.is_error()) {
      poison(item.then_block, scope);
      return std::nullopt;
    }
    const bool has_else = item.else_block.valid();
    if (condition.scalars[0].known()) {
      const bool taken = condition.as_bool();
      const BlockId run_block = taken ? item.then_block : item.else_block;
      const BlockId other = taken ? item.else_block : item.then_block;
      if (other.valid()) ev_.check_names(tree_, other, scope);
      return run_block.valid() ? run(run_block, below(scope)) : std::nullopt;
    }
    Changes then_changes, else_changes;
    std::vector<PartialReturn> then_partial, else_partial;
    const std::optional<Value> then_value = run_branch(item.then_block, scope, then_changes, then_partial);
    std::optional<Value> else_value;
    if (has_else) else_value = run_branch(item.else_block, scope, else_changes, else_partial);
    const Scalar c = condition.scalars[0];
    const Scalar not_c = ev_.emit(vm::Op::logical_not, {c}, span);
    // Returns inside a branch hold where the branch is taken.
    for (const auto& [partials, where] : {std::pair{&then_partial, c}, std::pair{&else_partial, not_c}})
      for (PartialReturn& partial : *partials) {
        partial.condition = ev_.emit(vm::Op::logical_and, {where, partial.condition}, span);
        partial_returns_.push_back(partial);
      }
    if (then_value && else_value) return select(ev_, c, *then_value, *else_value, span);
    if (then_value) partial_returns_.push_back({c, *then_value, span});
    if (else_value) partial_returns_.push_back({not_c, *else_value, span});
    merge(c, then_changes, else_changes, then_value.has_value(), else_value.has_value(), *scope, span);
    return std::nullopt;
  }

  // Runs a branch and takes its changes back.
  std::optional<Value> run_branch(BlockId block, const std::shared_ptr<Scope>& scope, Changes& changes,
                                  std::vector<PartialReturn>& partial) {
    changes.outside = scope.get();
    branches_.push_back(&changes);
    std::swap(partial, partial_returns_);
    std::optional<Value> returned = run(block, below(scope));
    std::swap(partial, partial_returns_);
    branches_.pop_back();
    for (Changes::Variable& variable : changes.variables) {
      variable.after = variable.binding->value;
      variable.binding->value = variable.before;
    }
    return returned;
  }

  // Sets what the branches changed; a branch that returned leaves the other's values.
  void merge(const Scalar& condition, const Changes& a, const Changes& b, bool a_returned, bool b_returned,
             const Scope& scope, Span span) {
    std::vector<const Binding*> changed;
    for (const Changes::Variable& v : a.variables) changed.push_back(v.binding);
    for (const Changes::Variable& v : b.variables)
      if (!a.changed(*v.binding)) changed.push_back(v.binding);
    for (const Binding* binding : changed) {
      const Value from_a = a.after(*binding), from_b = b.after(*binding);
      const Value merged = a_returned   ? from_b
                           : b_returned ? from_a
                                        : select(ev_, condition, from_a, from_b, span);
      set(find(binding->symbol, &scope), merged, span);
    }
    for (const Changes::Output& output : a.outputs)
      for (const Changes::Output& other : b.outputs)
        if (other.assign->name.symbol == output.assign->name.symbol)
          set_output({output.item, output.assign,
                      select(ev_, condition, output.value, other.value, output.item->span),
                      either(condition, output.branches, other.branches, output.item->span)});
  }

  // The statements of both, those of `b` counted after those of `a`.
  Evaluator::Branches either(const Scalar& condition, const Evaluator::Branches& a,
                             const Evaluator::Branches& b, Span span) {
    Evaluator::Branches both = a;
    both.places.insert(both.places.end(), b.places.begin(), b.places.end());
    both.constant = a.constant && b.constant;
    const Scalar behind = sum(ev_, b.taken, Scalar{static_cast<double>(a.places.size())}, span);
    both.taken = ev_.emit(vm::Op::select, {condition, a.taken, behind}, span);
    return both;
  }

  Evaluator& ev_;
  const SyntaxTree& tree_;
  const Evaluator::Outputs* outputs_;  // null in functions
  std::vector<Changes*> branches_;
  std::vector<PartialReturn> partial_returns_;
};

}  // namespace

void Evaluator::report_no_output(const Outputs& outputs, const Name& name,
                                 const std::vector<std::string_view>& variables) {
  const std::string_view word = text(name.symbol);
  std::vector<std::string_view> candidates = outputs.names;
  candidates.insert(candidates.end(), variables.begin(), variables.end());
  std::string guess(help_for_foreign_word(ForeignUse::output, word));
  if (guess.empty()) guess = did_you_mean(word, candidates);
  error(name.span, fmt::format("'{}' has no output '{}'", outputs.owner, word),
        guess.empty()
            ? fmt::format("outputs are {}; let {} = … defines a name", fmt::join(outputs.names, ", "), word)
            : guess);
}

std::optional<Value> Evaluator::run_steps(const SyntaxTree& tree, BlockId block,
                                          const std::shared_ptr<Scope>& scope, const Outputs* outputs) {
  return Steps(*this, tree, outputs).run_all(block, scope);
}

}  // namespace tyndall::eval
