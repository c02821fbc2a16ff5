// The words of the language, from the tables of the code.
#pragma once

#include <set>
#include <string>

#include "eval/names.h"
#include "resolve/statements/statements.h"
#include "syntax/token.h"
#include "vm/program/builtins.h"

namespace tyndall::docs {

struct Words {
  std::set<std::string> constants{"pi"}, operators, definitions, control, inputs, builtins, statements, kinds;

  Words() {
    using enum syntax::TokenKind;
    for (int k = static_cast<int>(kw_let); k <= static_cast<int>(kw_false); ++k) {
      const auto kind = static_cast<syntax::TokenKind>(k);
      const bool defines = kind == kw_let || kind == kw_var || kind == kw_def || kind == kw_medium ||
                           kind == kw_material || kind == kw_object;
      const bool operates = kind == kw_and || kind == kw_or || kind == kw_not;
      const bool constant = kind == kw_true || kind == kw_false;
      (constant   ? constants
       : operates ? operators
       : defines  ? definitions
                  : control)
          .emplace(syntax::spelling(kind));
    }
    syntax::Symbols symbols;
    const eval::Names names(symbols);
    for (std::uint32_t i = 0; i < names.specials.size(); ++i)
      if (names.specials[i] != eval::Special::none && names.specials[i] != eval::Special::pi)
        inputs.emplace(symbols.text(syntax::SymbolId(i)));
    for (const auto rows : {vm::builtins(), eval::phase_builtins()})
      for (const vm::Builtin& row : rows) builtins.emplace(row.name);
    const resolve::Statements table(resolve::all_statements(), symbols);
    for (const resolve::Statement& row : table.rows()) {
      const std::size_t space = row.name.find(' ');
      statements.emplace(row.name.substr(0, space));
      if (space != std::string_view::npos) kinds.emplace(row.name.substr(space + 1));
    }
  }
};

inline std::string joined(const std::set<std::string>& words, std::string_view between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : std::string(between)) + word;
  return out;
}

}  // namespace tyndall::docs
