// The one sink for problems in the user's input: collected with their place, printed with the source line.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/source.h"

namespace tyndall {

enum class Severity { note, warning, error };
std::string_view name(Severity severity);

// One message. `help` is the way out ("did you mean 'density'?"), empty when there is none.
// Notes point at further places: an earlier definition, the calls and includes that led here.
struct Diagnostic {
  Severity severity = Severity::error;
  Span span;
  std::string message;
  std::string help;
  struct Note {
    Span span;
    std::string message;
  };
  std::vector<Note> notes;
};

// Collects messages. Errors past `max_errors` are counted, not kept; notes past `max_notes` are left out,
// which the last one says. Two messages of the same text at the same place are one.
class Diagnostics {
 public:
  static constexpr int max_errors = 20;
  static constexpr int max_warnings = 20;
  static constexpr int max_notes = 200;

  void error(Span span, std::string message, std::string help = {}, std::vector<Diagnostic::Note> notes = {});
  void warning(Span span, std::string message, std::string help = {},
               std::vector<Diagnostic::Note> notes = {});

  // What the scene asked to be told: `print`.
  void note(Span span, std::string message);

  // The same, unless the message has been reported at any place: what is missing is missed once, however
  // often it is used.
  void error_once(Span span, std::string message, std::string help = {},
                  std::vector<Diagnostic::Note> notes = {});

  bool has_errors() const { return error_count_ > 0; }
  int error_count() const { return error_count_; }
  int warning_count() const { return warning_count_; }
  // True once further errors would not be shown: stages may stop early.
  bool full() const { return error_count_ >= max_errors; }
  const std::vector<Diagnostic>& all() const { return list_; }

  // Context notes that are appended to every message reported while they are pushed (innermost first):
  // the chain of includes and calls.
  void push_context(Span span, std::string message) { context_.push_back({span, std::move(message)}); }
  void pop_context() { context_.pop_back(); }

 private:
  void add(Diagnostic d);

  std::vector<Diagnostic> list_;
  std::vector<Diagnostic::Note> context_;
  int error_count_ = 0, warning_count_ = 0;
};

// Text form: `file:line:column: error: message`, the source line, a caret or underline, help and notes.
std::string render_text(const Diagnostic& d, const Sources& sources, bool color);
std::string render_text(const Diagnostics& all, const Sources& sources, bool color);

// The candidate nearest to `word` by edit distance, whatever the case of letters, or one that begins with it;
// empty when none resembles it. A candidate equal to the word is no candidate; of equally near ones the first
// is taken.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);
// "did you mean 'x'?" or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace tyndall
