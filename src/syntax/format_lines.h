// The lines of a formatted text while they are written, and the tables that the author laid out in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::syntax {

// The number of code points, which is taken for the number of columns.
std::size_t columns(std::string_view utf8);

// What may stand in a column of a table.
enum class CellKind : std::uint8_t { equals, brace, parameter, argument, comment };

class FormatLines {
 public:
  // Begins a line `indent` columns in.
  void begin_line(std::size_t indent);
  // After text: an empty line, and a new one.
  void blank_line();
  void put(std::string_view text);
  // Puts `spaces` that may grow, so that what follows stands in one column with the same of the lines around,
  // if the author wrote it so: at `source_column`, after `source_spaces`.
  void put_cell(CellKind kind, std::size_t spaces, std::size_t source_column, std::size_t source_spaces);

  bool line_is_empty() const { return lines_.back().text.empty(); }
  // The column at which the next text would stand, before tables are aligned.
  std::size_t column() const { return lines_.back().indent + lines_.back().width; }
  std::size_t indent() const { return lines_.back().indent; }
  std::size_t count() const { return lines_.size(); }

  // All lines, tables aligned, without blanks at their ends.
  std::string text();

 private:
  struct Cell {
    CellKind kind;
    std::size_t offset;  // in bytes of the line's text, where padding goes in
    std::size_t source_column;
    bool padded;  // in the source
  };
  struct Line {
    std::size_t indent = 0, width = 0;
    std::string text;
    std::vector<Cell> cells;
  };

  const Cell* cell(std::size_t line, std::size_t index) const;
  const Cell* comment(std::size_t line) const;
  template <class Find>
  void align(const Find& find);

  std::vector<Line> lines_{Line{}};
};

}  // namespace tyndall::syntax
