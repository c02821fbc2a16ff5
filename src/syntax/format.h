// The canonical layout of a scene file: `tyndall format`.
#pragma once

#include <string>

#include "syntax/parser.h"

namespace tyndall::syntax {

// Columns that a block may reach on one line; a longer one gets a line for each item.
inline constexpr std::size_t max_columns = 110;

// The text of a source laid out anew: the same tree, the same comments in the same order, and the same text
// when it is formatted again; all lines end with LF, and there is no byte order mark. Tokens and tree must be
// of that source and free of errors.
std::string format(const Sources& sources, SourceId source, const TokenList& tokens, const SyntaxTree& tree);

}  // namespace tyndall::syntax
