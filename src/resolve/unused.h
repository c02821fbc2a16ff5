// Warnings of names that nothing uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "eval/scope.h"
#include "syntax/tree.h"

namespace tyndall::resolve {

struct Run;
struct Site;

// Blocks of the main file that were passed over, and the names in them: what they use is used, if not this
// time.
struct PassedOver {
  // Where a block stands, as far as names go.
  struct Place {
    std::shared_ptr<const eval::Scope> scope;
    syntax::ListRef parameters;  // of the template that it is
    syntax::SymbolId variable;   // of the loop that it is
  };
  std::unordered_map<std::uint32_t, Place> blocks;
  std::unordered_set<std::uint32_t> names;  // in the first `read` blocks met
  std::size_t read = 0;
};

// Notes a block that is not run now: a branch not taken, a template's body before its first call.
void pass_over(Run& run, const Site& site, syntax::BlockId block, syntax::ListRef parameters = {},
               syntax::SymbolId variable = {});

// Warns of every name of the scope that nothing uses; silent once there are errors, which may hide the uses.
void report_unused(Run& run, const eval::Scope& scope);

}  // namespace tyndall::resolve
