#include "tools/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace tyndall::tools {
namespace {

void print_placeless(std::string_view severity, std::string_view color, std::string_view message) {
  if (error_output_has_color()) {
    print_message(fmt::format("tyndall: \x1b[1;{}m{}:\x1b[0m {}\n", color, severity, message));
  } else {
    print_message(fmt::format("tyndall: {}: {}\n", severity, message));
  }
}

void add_place(nlohmann::json& object, const Span& span, const Sources& sources) {
  if (!span.valid()) return;
  const Source& source = sources[span.source];
  const LineColumn begin = source.locate(span.begin), end = source.locate(span.end);
  object["file"] = source.name();
  object["line"] = begin.line;
  object["column"] = begin.column;
  object["end_line"] = end.line;
  object["end_column"] = end.column;
}

}  // namespace

bool error_output_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

bool error_output_has_color() {
  const char* no_color = std::getenv("NO_COLOR");
  return error_output_is_terminal() && (no_color == nullptr || *no_color == '\0');
}

void print_message(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }
void print_result(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_diagnostics(const Diagnostics& diagnostics, const Sources& sources) {
  print_message(render_text(diagnostics, sources, error_output_has_color()));
}

void print_error(std::string_view message) { print_placeless("error", "31", message); }
void print_warning(std::string_view message) { print_placeless("warning", "35", message); }

ExitStatus misuse(std::string_view message) {
  print_error(message);
  return ExitStatus::misuse;
}

nlohmann::json to_json(const Diagnostics& diagnostics, const Sources& sources) {
  nlohmann::json list = nlohmann::json::array();
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    nlohmann::json object{{"severity", name(diagnostic.severity)}, {"message", diagnostic.message}};
    add_place(object, diagnostic.span, sources);
    if (!diagnostic.help.empty()) object["help"] = diagnostic.help;
    for (const Diagnostic::Note& note : diagnostic.notes) {
      nlohmann::json note_object{{"message", note.message}};
      add_place(note_object, note.span, sources);
      object["notes"].push_back(std::move(note_object));
    }
    list.push_back(std::move(object));
  }
  return list;
}

void print_json_line(const nlohmann::json& value) {
  print_result(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  std::fflush(stdout);
}

void print_json(const nlohmann::json& value) {
  print_result(value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace tyndall::tools
