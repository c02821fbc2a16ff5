// What an evaluator complains of: errors with the calls that led to them, values that are no numbers, loops
// that are too long.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "eval/evaluator.h"

namespace tyndall::eval {

using namespace syntax;

// Calls that an error names, from the innermost.
static constexpr int max_calls_shown = 8;

std::vector<Diagnostic::Note> Evaluator::calls_that_led_here() const {
  std::vector<Diagnostic::Note> notes;
  int calls = 0;
  for (auto frame = frames_.rbegin(); frame != frames_.rend() && calls <= max_calls_shown; ++frame) {
    if (!frame->item) continue;  // a default's, whose place is the call's
    const auto& name = std::get<FunctionItem>(frame->item->node).name;
    notes.push_back({frame->call, ++calls > max_calls_shown
                                      ? "and so on, through further calls"
                                      : fmt::format("in this call of '{}'", text(name.symbol))});
  }
  return notes;
}

static void append(std::vector<Diagnostic::Note>& notes, std::vector<Diagnostic::Note> more) {
  notes.insert(notes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

Value Evaluator::error_once(Span span, std::string message, std::string help,
                            std::vector<Diagnostic::Note> notes) {
  ++errors_reported_;
  append(notes, calls_that_led_here());
  context_.diagnostics->error_once(span, std::move(message), std::move(help), std::move(notes));
  return {};
}

Value Evaluator::error(Span span, std::string message, std::string help,
                       std::vector<Diagnostic::Note> notes) {
  ++errors_reported_;
  append(notes, calls_that_led_here());
  context_.diagnostics->error(span, std::move(message), std::move(help), std::move(notes));
  return {};
}

// What a function wants of its arguments, for values that it has not; any other: nothing to go by.
static std::string help_for_range(std::string_view name) {
  struct Row {
    std::string_view name, help;
  };
  static constexpr Row rows[] = {
      {"sqrt", "a root needs at least 0: sqrt(max(x, 0)), or sqrt(abs(x))"},
      {"log", "a logarithm needs a number above 0: log(max(x, 1e-9))"},
      {"asin", "it needs a number in [-1, 1]: asin(clamp(x, -1, 1))"},
      {"acos", "it needs a number in [-1, 1]: acos(clamp(x, -1, 1))"},
      {"pow", "a negative number has whole powers only: pow(abs(x), y)"},
      {"exp", "it is too large to be represented: exp(min(x, 700))"},
      {"normalize", "a vec of length 0 has no direction"},
      {"mod", "there is no remainder of a division by 0"},
  };
  const auto* row =
      std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) { return r.name == name; });
  return std::string(row == std::end(rows) ? "look at what it is made of" : row->help);
}

Value Evaluator::finite(const Value& value, Span span, std::string_view function) {
  if (in_body()) return value;
  for (int i = 0; i < value.width(); ++i) {
    const double s = value.scalars[static_cast<std::size_t>(i)].value;
    if (std::isnan(s)) return error(span, "this has no value (it is not a number)", help_for_range(function));
    if (std::isinf(s)) return error(span, "this is infinite", help_for_range(function));
  }
  return value;
}

std::string Evaluator::help_for_member(SymbolId member, std::string_view otherwise) const {
  return names().builtin(member) ? fmt::format("it is a function: write {}(…)", text(member))
                                 : std::string(otherwise);
}

bool Evaluator::may_iterate(std::int64_t iterations, Span span) {
  const std::int64_t once = in_body() ? max_unrolled_iterations : max_loop_iterations;
  const std::int64_t all = in_body() ? max_total_unrolled : max_total_iterations;
  iterations_ += std::min(iterations, all);
  if (iterations <= once && iterations_ <= all) return true;
  error(span,
        iterations > once ? fmt::format("a loop of {} rounds", iterations)
                          : fmt::format("more than {} rounds of loops in all", all),
        fmt::format("at most {} rounds a loop and {} in all are allowed {}", once, all,
                    in_body() ? "in a body, where loops are unrolled" : "in a function"));
  return false;
}

bool Evaluator::may_hold(std::size_t entries, Span span) {
  const auto counted = static_cast<std::int64_t>(std::min<std::size_t>(entries, max_scene_list_entries));
  list_entries_ += counted;
  all_list_entries_ += counted;
  if (entries > max_list_entries)
    error(span, fmt::format("a list of {} entries", entries),
          fmt::format("a list has at most {} entries", max_list_entries));
  else if (list_entries_ > max_total_list_entries || all_list_entries_ > max_scene_list_entries)
    error_once(span,
               list_entries_ > max_total_list_entries
                   ? fmt::format("more than {} entries of lists are made here in all", max_total_list_entries)
                   : fmt::format("more than {} entries of lists are made in all", max_scene_list_entries),
               "a list that grows is made anew each time: [f(i) for i in 0..<n] makes it at once", {});
  else
    return true;
  return false;
}

}  // namespace tyndall::eval
