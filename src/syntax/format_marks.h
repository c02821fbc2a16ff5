// What the formatter knows of each token before it lays out the text: read from the tree once (internal).
#pragma once

#include <cstdint>
#include <vector>

#include "base/source.h"
#include "syntax/token.h"
#include "syntax/tree.h"

namespace tyndall::syntax {

inline constexpr std::uint32_t no_token = 0xffffffffu;

struct TokenMark {
  std::uint32_t item_end = no_token;     // last token of the item that begins here; no_token: none begins
  std::uint32_t match = no_token;        // of a bracket or a string's head: what closes it
  std::uint32_t first_brace = no_token;  // of a `{` of an `if` statement: the `{` of its first branch
  std::uint32_t last_brace = no_token;   // of that one: the `}` of the last branch
  bool parameter = false;                // the item that begins here is `name: value`
  bool defines = false;                  // an `=` after the name that it gives a value to
  bool names_value = false;              // the `:` of a parameter
  bool opens_statement = false;          // the `{` of a statement
  bool else_statement = false;           // the `else` of an `if` statement, not of a value
  bool loose_range = false;              // a `..` beside sums: spaces help to read it
  bool dropped = false;                  // a comma that means nothing
};

// One mark for each token.
std::vector<TokenMark> mark_tokens(std::string_view text, const TokenList& tokens, const SyntaxTree& tree);

}  // namespace tyndall::syntax
