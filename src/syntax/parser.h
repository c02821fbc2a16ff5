// Text to tokens to tree, and the tree's printed form.
#pragma once

#include <cstddef>
#include <string>

#include "base/diagnostics.h"
#include "base/source.h"
#include "syntax/token.h"
#include "syntax/tree.h"

namespace tyndall::syntax {

// Words, marks and comments of one source: what is made of them takes some hundred bytes each. A mesh of some
// four million numbers is read.
inline constexpr std::size_t max_tokens = 12'000'000;
// Strings of one source, and pieces of strings between values.
inline constexpr std::size_t max_strings = 1'000'000;

// Reads the words of a source. Always ends with end_of_file; problems are reported and lexing goes on, up to
// `most` tokens: of more, none is given.
TokenList lex(const Sources& sources, SourceId source, Diagnostics& diagnostics,
              std::size_t most = max_tokens);

// Reads a token list. Always gives a tree; what could not be read is left out or an ErrorExpr.
SyntaxTree parse(const Sources& sources, SourceId source, const TokenList& tokens, Symbols& symbols,
                 Diagnostics& diagnostics);

// Reads one expression and nothing after it (for --set NAME=EXPR). The tree's only block holds no items.
struct ParsedExpression {
  SyntaxTree tree;
  ExprId expr;
};
ParsedExpression parse_expression(const Sources& sources, SourceId source, const TokenList& tokens,
                                  Symbols& symbols, Diagnostics& diagnostics);

// One token a line (inspect --stage tokens), and the tree as indented s-expressions (inspect --stage tree).
std::string print(const TokenList& tokens, const Sources& sources);
std::string print(const SyntaxTree& tree, const Symbols& symbols);

}  // namespace tyndall::syntax
