// Lists that are made: by `for`, by + and by built-ins (internal to this layer).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "eval/evaluator.h"

namespace tyndall::eval {

// What a `for` goes over: a range or a list, which outlives it.
struct Rounds {
  const RangeValue* range = nullptr;
  const std::vector<Value>* list = nullptr;
  std::int64_t count = 0;

  Value at(std::int64_t i) const {
    return range ? Value::number(eval::at(*range, i)) : (*list)[static_cast<std::size_t>(i)];
  }
};

// Nothing after reporting a value that is neither; `example` shows what may be written.
std::optional<Rounds> rounds_of(Evaluator& evaluator, const Value& over, Span span, std::string_view example);

// The list of these entries, or an error value after reporting one that is too deep.
Value list_of(Evaluator& evaluator, std::vector<Value> entries, Span span);

// The entries of a, then those of b.
Value joined_lists(Evaluator& evaluator, const Value& a, const Value& b, Span span);

// The place that a known index names; nothing after reporting one that is none.
std::optional<std::size_t> place_in(Evaluator& evaluator, const std::vector<Value>& list, const Value& index,
                                    Span span);

// The list with another entry, for `l[i] = x`.
Value with_entry(Evaluator& evaluator, const syntax::SyntaxTree& tree, const syntax::WithEntryExpr& e,
                 Span span, const std::shared_ptr<Scope>& scope);
// The same in place, where `list`, the value of the variable that is set, shares its entries with no other
// value: false where it does. An error value after reporting an error.
bool set_entry(Evaluator& evaluator, const syntax::SyntaxTree& tree, const syntax::WithEntryExpr& e,
               Value& list, const std::shared_ptr<Scope>& scope);

// [element for name in over if condition]
Value comprehension(Evaluator& evaluator, const syntax::SyntaxTree& tree, const syntax::ComprehensionExpr& e,
                    Span span, const std::shared_ptr<Scope>& scope);

}  // namespace tyndall::eval
