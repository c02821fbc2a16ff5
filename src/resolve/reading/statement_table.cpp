#include "resolve/reading/statement_table.h"

#include <algorithm>
#include <utility>

namespace tyndall::resolve {

Statements::Statements(std::vector<Statement> rows, syntax::Symbols& symbols) : rows_(std::move(rows)) {
  for (Statement& row : rows_) {
    const std::size_t space = row.name.find(' ');
    row.keyword = symbols.intern(row.name.substr(0, space));
    if (space != std::string_view::npos) row.kind = symbols.intern(row.name.substr(space + 1));
  }
}

const Statement* Statements::find(syntax::SymbolId keyword, syntax::SymbolId kind) const {
  const auto row = std::find_if(rows_.begin(), rows_.end(),
                                [&](const Statement& s) { return s.keyword == keyword && s.kind == kind; });
  return row == rows_.end() ? nullptr : &*row;
}

const Statement* Statements::of_file(const Statement& row) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const Statement& s) {
    return s.of_file && s.keyword == row.keyword && s.kind == row.kind;
  });
  return found == rows_.end() ? nullptr : &*found;
}

}  // namespace tyndall::resolve
