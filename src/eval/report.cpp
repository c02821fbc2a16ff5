// What an evaluator complains of: errors with the calls that led to them, values that are no numbers, loops
// that are too long.
#include <fmt/format.h>

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

Value Evaluator::finite(const Value& value, Span span) {
  if (in_body()) return value;
  for (int i = 0; i < value.width(); ++i) {
    const double s = value.scalars[static_cast<std::size_t>(i)].value;
    if (std::isnan(s))
      return error(span, "this has no value (it is not a number)", "look at what it is made of");
    if (std::isinf(s)) return error(span, "this is infinite", "look at what it is made of");
  }
  return value;
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

}  // namespace tyndall::eval
