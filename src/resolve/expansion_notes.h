// Templates and objects that are run within each other, and how messages tell it.
#pragma once

#include <fmt/format.h>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

// Messages tell this many of the outermost calls that led to their place: trees grow by hundreds.
inline constexpr int max_told_calls = 8;

// Counts a template or object that is being run; after an error, when too many are within each other,
// it is not entered and the run stops.
class Nested {
 public:
  Nested(Run& run, Span span) : run_(run), entered_(run.template_depth < max_template_depth) {
    if (!entered_) {
      run.diagnostics.error(span, fmt::format("templates nested more than {} deep", max_template_depth),
                            "a template that places itself needs an `if` that ends it");
      run.stopped = true;
      return;
    }
    told_ = ++run.template_depth <= max_told_calls;
    if (told_) run.diagnostics.push_context(span, "called from here");
  }
  ~Nested() {
    if (told_) run_.diagnostics.pop_context();
    if (entered_) --run_.template_depth;
  }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  bool entered() const { return entered_; }

 private:
  Run& run_;
  bool entered_, told_ = false;
};

}  // namespace tyndall::resolve
