// Collecting the user's errors, and writing them with their source line.
#include "base/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/flood.h"
#include "base/utf8.h"

namespace tyndall {

// ------------------------------------------------------------------------------------------------------
// collecting

void Diagnostics::error(Span span, std::string message, std::string help,
                        std::vector<Diagnostic::Note> notes) {
  add({Severity::error, span, std::move(message), std::move(help), std::move(notes)});
}

void Diagnostics::error_once(Span span, std::string message, std::string help,
                             std::vector<Diagnostic::Note> notes) {
  const auto same = [&](const Diagnostic& other) {
    return other.severity == Severity::error && other.message == message;
  };
  if (std::none_of(list_.begin(), list_.end(), same))
    error(span, std::move(message), std::move(help), std::move(notes));
}

void Diagnostics::warning(Span span, std::string message, std::string help,
                          std::vector<Diagnostic::Note> notes) {
  add({Severity::warning, span, std::move(message), std::move(help), std::move(notes)});
}

void Diagnostics::note(Span span, std::string message) {
  const auto is_note = [](const Diagnostic& other) { return other.severity == Severity::note; };
  const auto notes = std::count_if(list_.begin(), list_.end(), is_note);
  if (notes > max_notes) return;
  if (notes == max_notes) message = fmt::format("more than {} notes: the rest is left out", max_notes);
  add({Severity::note, span, std::move(message), {}, {}});
}

void Diagnostics::add(Diagnostic d) {
  const auto same = [&](const Diagnostic& other) {
    return other.severity == d.severity && other.span == d.span && other.message == d.message;
  };
  if (std::any_of(list_.begin(), list_.end(), same)) return;
  if (d.severity != Severity::note) {
    const bool is_error = d.severity == Severity::error;
    int& count = is_error ? error_count_ : warning_count_;
    if (++count > (is_error ? max_errors : max_warnings)) return;
  }
  d.notes.insert(d.notes.end(), context_.rbegin(), context_.rend());
  list_.push_back(std::move(d));
}

// -------------------------------------------------------------------------------------------------------
// text form

namespace {

constexpr std::uint32_t max_columns = 100;    // of a source line that are shown
constexpr std::uint32_t columns_before = 60;  // of them at most before the caret, when the line is cut
constexpr int few_odd = 8;  // characters that cannot be shown, in a line that is shown all the same
constexpr std::string_view ellipsis = "…";

struct Colors {
  std::string_view bold, error, warning, note, caret, off;
};
constexpr Colors no_colors{};
constexpr Colors ansi_colors{"\x1b[1m", "\x1b[1;31m", "\x1b[1;35m", "\x1b[1;36m", "\x1b[1;32m", "\x1b[0m"};

std::string_view color_of(Severity severity, const Colors& colors) {
  switch (severity) {
    case Severity::note:
      return colors.note;
    case Severity::warning:
      return colors.warning;
    case Severity::error:
      return colors.error;
  }
  return {};
}

bool is_control(char32_t c) { return c < 0x20 || (c >= 0x7f && c < 0xa0); }

// The offset `count` columns before `offset`, not before the line's begin.
std::size_t step_back(std::string_view line, std::size_t offset, std::uint32_t count) {
  for (; count > 0 && offset > 0; --count) {
    std::size_t previous = offset - 1;
    while (previous > 0 && offset - previous < 4 &&
           (static_cast<unsigned char>(line[previous]) & 0xc0) == 0x80)
      --previous;
    offset = previous + decode_utf8(line, previous).bytes == offset ? previous : offset - 1;
  }
  return offset;
}

// A source line and the line of carets under it, both cut to a window around the caret.
struct Excerpt {
  std::string line, carets;
  int odd = 0;  // characters that could not be shown
};

// `begin` and `end` are byte offsets in the line. Tabs stay tabs in both lines, so that the caret stands
// right whatever their width; bytes that would disturb a terminal are shown as U+FFFD.
Excerpt excerpt(std::string_view line, std::size_t begin, std::size_t end) {
  Excerpt out;
  std::size_t from = step_back(line, begin, max_columns);
  if (from == 0) {  // uncut if the whole line fits
    std::size_t columns = 0, i = 0;
    for (; i < line.size() && columns <= max_columns; ++columns) i += decode_utf8(line, i).bytes;
    if (columns > max_columns) from = step_back(line, begin, columns_before);
  } else {
    from = step_back(line, begin, columns_before);
  }
  if (from > 0) {
    out.line = ellipsis;
    out.carets = " ";
  }
  std::size_t i = from;
  for (std::uint32_t columns = 0; i < line.size() && columns < max_columns; ++columns) {
    const CodePoint c = decode_utf8(line, i);
    const bool tab = c.valid && c.value == '\t';
    const bool odd = !tab && (!c.valid || is_control(c.value));
    out.odd += odd;
    if (odd)
      append_utf8(out.line, 0xfffd);
    else
      out.line += line.substr(i, c.bytes);
    if (i < begin)
      out.carets += tab ? '\t' : ' ';
    else if (i == begin)
      out.carets += '^';
    else if (i < end)
      out.carets += '~';
    i += c.bytes;
  }
  if (i < line.size()) out.line += ellipsis;
  if (begin >= line.size()) out.carets += '^';
  return out;
}

void write_message(std::string& out, Severity severity, const Span& span, std::string_view message,
                   const Sources& sources, const Colors& colors) {
  if (span.valid()) {
    const Source& source = sources[span.source];
    const LineColumn at = source.locate(span.begin);
    out += fmt::format("{}{}:{}:{}: ", colors.bold, source.name(), at.line, at.column);
  }
  out += fmt::format("{}{}:{} {}{}{}\n", color_of(severity, colors), name(severity), colors.off, colors.bold,
                     message, colors.off);
  if (!span.valid()) return;
  const Source& source = sources[span.source];
  const std::uint32_t number = source.locate(span.begin).line;
  const std::string_view line = source.line(number);
  const auto line_begin = static_cast<std::size_t>(line.data() - source.text().data());
  const std::size_t begin =
      std::clamp<std::size_t>(span.begin, line_begin, line_begin + line.size()) - line_begin;
  const std::size_t end =
      std::clamp<std::size_t>(span.end - std::min<std::size_t>(line_begin, span.end), begin, line.size());
  const Excerpt shown = excerpt(line, begin, end);
  if (shown.odd > few_odd) return;  // no text: nobody could read it, and it may be anything
  out +=
      fmt::format("{:>5} | {}\n      | {}{}{}\n", number, shown.line, colors.caret, shown.carets, colors.off);
}

}  // namespace

std::string_view name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return {};
}

std::string render_text(const Diagnostic& d, const Sources& sources, bool color) {
  const Colors& colors = color ? ansi_colors : no_colors;
  std::string out;
  write_message(out, d.severity, d.span, d.message, sources, colors);
  if (!d.help.empty()) out += fmt::format("      = {}help:{} {}\n", colors.note, colors.off, d.help);
  for (const Diagnostic::Note& note : d.notes)
    write_message(out, Severity::note, note.span, note.message, sources, colors);
  return out;
}

std::string render_text(const Diagnostics& all, const Sources& sources, bool color) {
  std::string out;
  // In the order of the text, whichever stage found them.
  std::vector<const Diagnostic*> sorted;
  for (const Diagnostic& d : all.all()) sorted.push_back(&d);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic* a, const Diagnostic* b) {
    return std::pair(a->span.source.index, a->span.begin) < std::pair(b->span.source.index, b->span.begin);
  });
  for (const Diagnostic* d : sorted) out += render_text(*d, sources, color);
  const auto write_rest = [&](int count, int shown, std::string_view noun, std::string_view at_least) {
    if (count > shown)
      out +=
          fmt::format("… and {}{} more {}{}\n", at_least, count - shown, noun, count - shown == 1 ? "" : "s");
  };
  write_rest(all.error_count(), Diagnostics::max_errors, "error", flooded(all) ? "at least " : "");
  write_rest(all.warning_count(), Diagnostics::max_warnings, "warning", "");
  return out;
}

}  // namespace tyndall
