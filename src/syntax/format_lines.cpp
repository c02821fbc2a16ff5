// Lines of a formatted text, and keeping the author's tables: cells of the same kind that stood in one column
// in adjacent lines do so again. Aligned text is left as it is by another round, since a column is that of
// the widest cell in it.
#include "syntax/format_lines.h"

#include <algorithm>

namespace tyndall::syntax {

std::size_t columns(std::string_view utf8) {
  return static_cast<std::size_t>(std::count_if(
      utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

void FormatLines::begin_line(std::size_t indent) {
  if (!line_is_empty()) lines_.emplace_back();
  lines_.back().indent = indent;
}

void FormatLines::blank_line() {
  if (line_is_empty()) return;
  lines_.emplace_back();
  lines_.emplace_back();
}

// A comment may go over several lines: those after its first stay as they are.
void FormatLines::put(std::string_view text) {
  for (;;) {
    const std::size_t line_break = text.find('\n');
    const std::string_view part = text.substr(0, line_break);
    lines_.back().text += part;
    lines_.back().width += columns(part);
    if (line_break == std::string_view::npos) return;
    lines_.emplace_back();
    text.remove_prefix(line_break + 1);
  }
}

void FormatLines::put_cell(CellKind kind, std::size_t spaces, std::size_t source_column,
                           std::size_t source_spaces) {
  Line& line = lines_.back();
  line.cells.push_back({kind, line.text.size(), source_column, source_spaces > spaces});
  put(std::string(spaces, ' '));
}

const FormatLines::Cell* FormatLines::cell(std::size_t line, std::size_t index) const {
  const std::vector<Cell>& cells = lines_[line].cells;
  return index < cells.size() && cells[index].kind != CellKind::comment ? &cells[index] : nullptr;
}

const FormatLines::Cell* FormatLines::comment(std::size_t line) const {
  const std::vector<Cell>& cells = lines_[line].cells;
  return !cells.empty() && cells.back().kind == CellKind::comment ? &cells.back() : nullptr;
}

// Brings the cells that `find` gives for each line to common columns.
template <class Find>
void FormatLines::align(const Find& find) {
  const auto same_table = [&](std::size_t line) {  // as the line before
    const Cell *above = find(line - 1), *here = find(line);
    return above != nullptr && here != nullptr && above->kind == here->kind &&
           above->source_column == here->source_column && (above->padded || here->padded) &&
           lines_[line - 1].indent == lines_[line].indent;
  };
  const auto natural = [&](std::size_t line) {
    return columns(std::string_view(lines_[line].text).substr(0, find(line)->offset));
  };
  for (std::size_t first = 0; first < lines_.size();) {
    std::size_t end = first + 1;
    while (end < lines_.size() && same_table(end)) ++end;
    if (end > first + 1) {
      std::size_t widest = 0;
      for (std::size_t i = first; i < end; ++i) widest = std::max(widest, natural(i));
      for (std::size_t i = first; i < end; ++i) {
        const std::size_t padding = widest - natural(i), offset = find(i)->offset;
        lines_[i].text.insert(offset, padding, ' ');
        for (Cell& cell : lines_[i].cells)
          if (cell.offset > offset) cell.offset += padding;
      }
    }
    first = end;
  }
}

std::string FormatLines::text() {
  std::size_t most_cells = 0;
  for (const Line& line : lines_) most_cells = std::max(most_cells, line.cells.size());
  constexpr std::size_t most_columns = 64;  // of a table; longer lines are no work of hands
  for (std::size_t i = 0; i < std::min(most_cells, most_columns); ++i)
    align([&](std::size_t line) { return cell(line, i); });
  align([&](std::size_t line) { return comment(line); });
  std::string out;
  for (const Line& line : lines_) {
    const std::size_t end = line.text.find_last_not_of(" \t\r");
    if (end != std::string::npos) {
      out.append(line.indent, ' ');
      out.append(line.text, 0, end + 1);
    }
    out += '\n';
  }
  while (out.ends_with("\n\n")) out.pop_back();
  return out == "\n" ? std::string() : out;
}

}  // namespace tyndall::syntax
