// Warnings of names that nothing uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>

#include "eval/scope.h"
#include "syntax/tree.h"

namespace tyndall::resolve {

struct Run;

// Blocks of the main file that were passed over, and the names in them: what they use is used, if not this
// time.
struct PassedOver {
  std::unordered_set<std::uint32_t> blocks;
  std::unordered_set<std::uint32_t> names;  // in the first `read` blocks met
  std::size_t read = 0;
};

// Notes a block that is not run now: a branch not taken, a template's body before its first call.
void pass_over(Run& run, const syntax::SyntaxTree& tree, syntax::BlockId block);

// Warns of every name of the scope that nothing uses; silent once there are errors, which may hide the uses.
void report_unused(Run& run, const eval::Scope& scope);

}  // namespace tyndall::resolve
