// Rounds of loops and calls of templates, counted in the text before any is run: calls that double thirty
// times over are told at once, not after ten million of them.
#pragma once

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

// How many rounds and calls there are at least in a block that stands in the file's scope: what conditions
// and values decide is not counted.
double foreseen_rounds(Run& run, const syntax::SyntaxTree& tree, syntax::BlockId block);

// The same for a call of a template.
double foreseen_rounds(Run& run, const eval::Function& called);

}  // namespace tyndall::resolve
