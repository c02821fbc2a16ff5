// Built-ins on lists: append, sort, sum, and the least and greatest entry.
#include <fmt/format.h>

#include <algorithm>

#include "eval/calls.h"
#include "eval/lists.h"
#include "eval/operators.h"

namespace tyndall::eval {

using syntax::BinaryOp;

namespace {

Value append(CallSite& site) {
  bool ok = true;
  const Value list = site.as(Type::list, 0, ok);
  if (!ok) return {};
  return joined_lists(site.ev, list, Value::list({site.arguments[1]}), site.span);
}

Value sum_of(CallSite& site) {
  bool ok = true;
  const Value list = site.as(Type::list, 0, ok);
  if (!ok) return {};
  const std::vector<Value>& entries = list.as_list();
  if (entries.empty()) return Value::number(0);
  Value total = entries.front();
  if (total.width() == 0 || total.type == Type::boolean)
    return site.ev.error(site.spans[0], fmt::format("'sum' of {}", describe(total.type)),
                         "it adds numbers, angles, pairs or vecs");
  for (std::size_t i = 1; i < entries.size() && !total.is_error(); ++i)
    total = binary(site.ev, BinaryOp::add, total, entries[i], {site.span, site.spans[0], site.spans[0]});
  return total;
}

// The type that all entries have in common, of those that have an order; nothing after reporting others.
std::optional<Type> ordered_type(CallSite& site, const std::vector<Value>& entries) {
  const Type type = entries.front().type;
  for (const Value& entry : entries) {
    const bool ordered = type == Type::number || type == Type::angle || type == Type::string;
    if (ordered && entry.type == type && entry.known()) continue;
    const std::string found = ordered && entry.type == type ? "a number that differs from place to place"
                              : ordered ? fmt::format("{} and {}", describe(type), describe(entry.type))
                                        : std::string(describe(type));
    site.ev.error(site.spans[0], fmt::format("'sort' of {}", found),
                  "it takes known numbers, angles or strings, all alike");
    return std::nullopt;
  }
  return type;
}

Value sorted(CallSite& site) {
  bool ok = true;
  const Value list = site.as(Type::list, 0, ok);
  if (!ok) return {};
  std::vector<Value> entries = list.as_list();
  if (entries.empty()) return list;
  if (!site.ev.may_hold(entries.size(), site.span)) return {};
  const std::optional<Type> type = ordered_type(site, entries);
  if (!type) return {};
  std::stable_sort(entries.begin(), entries.end(), [&](const Value& a, const Value& b) {
    return *type == Type::string ? a.as_string() < b.as_string() : a.scalars[0].value < b.scalars[0].value;
  });
  return Value::list(std::move(entries));
}

}  // namespace

std::optional<Value> extreme_entry(CallSite& site) {
  const vm::Op op = site.entry.row->op();
  const bool one_list = (op == vm::Op::min || op == vm::Op::max) && site.given[0] && !site.given[1] &&
                        site.arguments[0].type == Type::list;
  if (!one_list) return std::nullopt;
  const std::vector<Value>& entries = site.arguments[0].as_list();
  if (entries.empty())
    return site.ev.error(site.spans[0], fmt::format("'{}' of an empty list", site.name()),
                         "begin it with a value that is always there: [0] + list");
  Value extreme = entries.front();
  for (const Value& entry : entries) {
    const std::optional<Type> type = entry.type == Type::angle && extreme.type == Type::angle
                                         ? std::optional(Type::angle)
                                         : common_type(extreme.type, entry.type);
    if (!type)
      return site.ev.error(site.spans[0],
                           fmt::format("'{}' of a list that holds {} and {}", site.name(),
                                       describe(extreme.type), describe(entry.type)),
                           "it takes numbers, angles, pairs or vecs");
    const Value a = widened(*type, extreme), b = widened(*type, entry);
    for (std::size_t c = 0; c < static_cast<std::size_t>(a.width()); ++c)
      extreme.scalars[c] = site.ev.emit(op, {a.scalars[c], b.scalars[c]}, site.span);
    extreme.type = *type;
  }
  return extreme;
}

Handlers list_handler(std::string_view name) {
  if (name == "append") return {append};
  if (name == "sum") return {sum_of};
  if (name == "sort") return {sorted};
  return {};
}

}  // namespace tyndall::eval
