// Warnings of names that nothing uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

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

  // A name where it is used.
  struct Use {
    std::uint32_t begin;
    syntax::SymbolId symbol;
  };
  std::vector<Use> uses;                        // all of the main file; empty until they are needed
  std::vector<std::uint32_t> unread;            // blocks whose names are not among `names` yet
  std::map<std::uint32_t, std::uint32_t> read;  // beginnings and ends of the others
  std::unordered_set<syntax::SymbolId> names;
};

// Notes a block that is not run now: a branch not taken, a template's body before its first call.
void pass_over(Run& run, const Site& site, syntax::BlockId block, syntax::ListRef parameters = {},
               syntax::SymbolId variable = {});

// Warns of every name of the scope that nothing uses; silent once there are errors, which may hide the uses.
void report_unused(Run& run, const eval::Scope& scope);

}  // namespace tyndall::resolve
