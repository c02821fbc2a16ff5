#include "eval/lists.h"

#include <fmt/format.h>

#include <cmath>

namespace tyndall::eval {

using namespace syntax;

std::optional<Rounds> rounds_of(Evaluator& ev, const Value& over, Span span, std::string_view example) {
  if (const auto* range = over.get<RangeValue>()) return Rounds{range, nullptr, count(*range)};
  if (const auto* list = over.get<std::vector<Value>>())
    return Rounds{nullptr, list, static_cast<std::int64_t>(list->size())};
  ev.error(span, fmt::format("'for' wants a range or a list, found {}", describe(over.type)),
           fmt::format("write {}", example));
  return std::nullopt;
}

Value list_of(Evaluator& ev, std::vector<Value> entries, Span span) {
  Value list = Value::list(std::move(entries));
  if (list.list_depth > max_list_depth)
    return ev.error(span, fmt::format("lists nested more than {} deep", max_list_depth),
                    "join lists side by side, not one within another");
  return list;
}

Value joined_lists(Evaluator& ev, const Value& a, const Value& b, Span span) {
  const std::vector<Value>&first = a.as_list(), &second = b.as_list();
  if (second.empty()) return a;
  if (first.empty()) return b;
  if (!ev.may_hold(first.size() + second.size(), span)) return {};
  std::vector<Value> entries;
  entries.reserve(first.size() + second.size());
  entries.insert(entries.end(), first.begin(), first.end());
  entries.insert(entries.end(), second.begin(), second.end());
  return list_of(ev, std::move(entries), span);
}

std::optional<std::size_t> place_in(Evaluator& ev, const std::vector<Value>& list, const Value& index,
                                    Span span) {
  if (index.is_error()) return std::nullopt;
  if (index.type != Type::number) {
    ev.error(span, fmt::format("an index is a number, found {}", describe(index.type)));
    return std::nullopt;
  }
  const double i = index.as_number();
  if (i != std::floor(i)) {
    ev.error(span, fmt::format("an index is a whole number, found {}", text_of(index)),
             "floor(x) makes it one");
    return std::nullopt;
  }
  if (i < 0 || i >= static_cast<double>(list.size())) {
    ev.error(span, fmt::format("index {} in a list of {}", text_of(index), list.size()),
             list.empty() ? "the list is empty" : fmt::format("indices run from 0 to {}", list.size() - 1));
    return std::nullopt;
  }
  return static_cast<std::size_t>(i);
}

namespace {

// Where an entry is to be set, and what; nothing after reporting why it cannot be.
struct NewEntry {
  std::size_t place;
  Value value;
};
std::optional<NewEntry> new_entry(Evaluator& ev, const SyntaxTree& tree, const WithEntryExpr& e,
                                  const Value& list, const std::shared_ptr<Scope>& scope) {
  const Value index = ev.evaluate(tree, e.index, scope);
  Value value = ev.evaluate(tree, e.entry, scope);
  if (index.is_error() || value.is_error() || list.is_error()) return std::nullopt;
  if (list.type != Type::list) {
    ev.error(tree[e.list].span, fmt::format("only a list has elements, found {}", describe(list.type)),
             "a vec is set as a whole: v = (x, v.y, v.z)");
    return std::nullopt;
  }
  if (!index.known()) {
    ev.error(tree[e.index].span,
             "this index differs from place to place, so it cannot say which entry is set",
             "choose entries one by one: [if j == i then x else l[j] for j in 0..<length(l)]");
    return std::nullopt;
  }
  const std::optional<std::size_t> place = place_in(ev, list.as_list(), index, tree[e.index].span);
  if (!place) return std::nullopt;
  return NewEntry{*place, std::move(value)};
}

}  // namespace

Value with_entry(Evaluator& ev, const SyntaxTree& tree, const WithEntryExpr& e, Span span,
                 const std::shared_ptr<Scope>& scope) {
  const Value list = ev.evaluate(tree, e.list, scope);
  std::optional<NewEntry> entry = new_entry(ev, tree, e, list, scope);
  if (!entry || !ev.may_hold(list.as_list().size(), span)) return {};
  std::vector<Value> entries = list.as_list();
  entries[entry->place] = std::move(entry->value);
  return list_of(ev, std::move(entries), span);
}

bool set_entry(Evaluator& ev, const SyntaxTree& tree, const WithEntryExpr& e, Value& list,
               const std::shared_ptr<Scope>& scope) {
  if (list.type != Type::list || list.heavy.use_count() != 1) return false;
  std::optional<NewEntry> entry = new_entry(ev, tree, e, list, scope);
  if (!entry) {
    list = {};
    return true;
  }
  // What was evaluated may have taken a share of the list.
  if (list.heavy.use_count() == 1 && list.list_depth > entry->value.list_depth)
    list.set_own_entry(entry->place, std::move(entry->value));
  else if (!ev.may_hold(list.as_list().size(), tree[e.list].span))
    list = {};
  else {
    std::vector<Value> entries = list.as_list();
    entries[entry->place] = std::move(entry->value);
    list = list_of(ev, std::move(entries), tree[e.list].span);
  }
  return true;
}

namespace {

// Gathers the entries of a comprehension, those of its further `for`s in its rounds.
class Gathering {
 public:
  Gathering(Evaluator& evaluator, const SyntaxTree& tree, Span span)
      : ev_(evaluator), tree_(tree), span_(span) {}

  std::vector<Value> entries;

  // False after an error.
  bool gather(const Comprehension& e, const std::shared_ptr<Scope>& scope) {
    const Span place = tree_[e.over].span;
    const Value over = ev_.evaluate(tree_, e.over, scope);
    if (over.is_error()) return false;
    const std::optional<Rounds> rounds = rounds_of(ev_, over, place, "[i * i for i in 0..<8]");
    if (!rounds) return false;
    if (rounds->range && rounds->range->differs()) {
      ev_.error(place, "the end of this range differs from place to place, and with it the list",
                "a list has one length: end the range at a known number");
      return false;
    }
    if (ev_.in_body() ? !ev_.may_iterate(rounds->count, place)
                      : !ev_.may_hold(static_cast<std::size_t>(rounds->count), place))
      return false;
    if (rounds->count == 0) check_names(e, scope);
    std::shared_ptr<Scope> inner;
    for (std::int64_t i = 0; i < rounds->count; ++i)
      if (!round(e, rounds->at(i), scope, inner)) return false;
    return true;
  }

 private:
  static std::shared_ptr<Scope> below(const std::shared_ptr<Scope>& scope) {
    auto inner = std::make_shared<Scope>();
    inner->parent = scope;
    return inner;
  }

  // Of a list without rounds, in which names are looked up no less.
  void check_names(const Comprehension& e, const std::shared_ptr<Scope>& scope) {
    const auto inner = below(scope);
    inner->bindings.push_back({e.name.symbol, Value::number(0), BindingKind::parameter, e.name.span, false});
    if (e.condition.valid()) ev_.check_names(tree_, e.condition, inner);
    ev_.check_names(tree_, e.element, inner);
  }

  // `inner` is the scope of the round before, which serves again where nothing holds it.
  bool round(const Comprehension& e, Value value, const std::shared_ptr<Scope>& scope,
             std::shared_ptr<Scope>& inner) {
    if (inner && inner.use_count() == 1 && !value.holds_scope()) {
      inner->bindings.front().value = std::move(value);
    } else {
      inner = below(scope);
      ev_.bind(inner, {e.name.symbol, std::move(value), BindingKind::parameter, e.name.span, false});
      if (inner->bindings.empty()) return false;
    }
    if (e.condition.valid()) {
      const Value condition = ev_.evaluate_as(Type::boolean, tree_, e.condition, inner, "'if'");
      if (condition.is_error()) return false;
      if (!condition.known()) {
        ev_.error(tree_[e.condition].span, "this condition differs from place to place, and with it the list",
                  "a list has one length: choose the entry, [if a then b else 0 for …]");
        return false;
      }
      if (!condition.as_bool()) return true;
    }
    if (e.nests) {
      const auto& nested = std::get<ComprehensionExpr>(tree_[e.element].node);
      return gather(tree_.comprehensions[nested.comprehension], inner);
    }
    entries.push_back(ev_.evaluate(tree_, e.element, inner));
    if (entries.back().is_error()) return false;
    if (entries.size() <= max_list_entries) return true;
    return ev_.may_hold(entries.size(), span_);
  }

  Evaluator& ev_;
  const SyntaxTree& tree_;
  Span span_;
};

}  // namespace

Value comprehension(Evaluator& ev, const SyntaxTree& tree, const ComprehensionExpr& e, Span span,
                    const std::shared_ptr<Scope>& scope) {
  Gathering gathering(ev, tree, span);
  if (!gathering.gather(tree.comprehensions[e.comprehension], scope)) return {};
  return list_of(ev, std::move(gathering.entries), span);
}

}  // namespace tyndall::eval
