// Text to tokens to tree, and the tree's printed form.
#pragma once

#include <string>

#include "base/diagnostics.h"
#include "base/source.h"
#include "syntax/token.h"
#include "syntax/tree.h"

namespace tyndall::syntax {

// Reads the words of a source. Always ends with end_of_file; problems are reported and lexing goes on.
TokenList lex(const Sources& sources, SourceId source, Diagnostics& diagnostics);

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
