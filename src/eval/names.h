// The names that the language itself defines, as symbols: inputs, constants and built-ins.
#pragma once

#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "eval/keys.h"
#include "eval/scope.h"
#include "syntax/tree.h"
#include "vm/program/builtins.h"

namespace tyndall::eval {

struct CallSite;
class Evaluator;

// Names that are no bindings: known in a scene (time, frame, pi) or inputs of a body.
enum class Special : std::uint8_t { none, time, frame, pi, p, P, n, N, uv };

// A built-in ready to be called.
struct BuiltinEntry {
  const vm::Builtin* row = nullptr;
  // Evaluates a call whose arguments are bound to the row's parameters.
  Value (*bound)(CallSite&) = nullptr;
  // Instead of `bound`, for calls with any number of arguments or words for values: binds its own.
  Value (*free)(CallSite&) = nullptr;
  std::vector<syntax::SymbolId> parameters;
};

// One run's table, made when first needed.
struct Names {
  explicit Names(syntax::Symbols& symbols);
  ~Names();
  Names(const Names&) = delete;
  Names& operator=(const Names&) = delete;

  Special special(syntax::SymbolId symbol) const {
    return symbol.index < specials.size() ? specials[symbol.index] : Special::none;
  }
  const BuiltinEntry* builtin(syntax::SymbolId symbol) const {
    return symbol.index < builtins_by_symbol.size() ? builtins_by_symbol[symbol.index] : nullptr;
  }

  std::vector<Special> specials;  // by symbol
  std::vector<const BuiltinEntry*> builtins_by_symbol;
  std::vector<std::unique_ptr<BuiltinEntry>> builtins;
  // Words that are looked up before any name: the arguments `ease`, `filter` and `encoding` take some, `auto`
  // stands for a value, the parameter `step` has `adaptive`, `clamp` `off`, and `multiple_scattering` `full`
  // and `approximate`.
  syntax::SymbolId ease, filter, nearest, linear, cubic, encoding, srgb, automatic, step, adaptive, clamp,
      off, multiple_scattering, full, approximate;
  bool is_filter(syntax::SymbolId word) const { return word == nearest || word == linear || word == cubic; }
  bool is_encoding(syntax::SymbolId word) const { return word == srgb || word == linear; }
  // Whether a word stands for a choice as the value of a parameter.
  bool is_choice(syntax::SymbolId parameter, syntax::SymbolId word) const {
    return word == automatic || (parameter == step && word == adaptive) ||
           (parameter == clamp && word == off) ||
           (parameter == multiple_scattering && (word == full || word == approximate));
  }

  // Scopes that hold definitions, or expressions that see `time`, are held by them in turn; the run's end
  // lets go of them.
  std::vector<std::shared_ptr<const Scope>> scopes_with_definitions;

  // Names that a body's block takes from outside of it, by the block's span.
  struct SpanHash {
    std::size_t operator()(const Span& s) const {
      return (std::size_t{s.source.index} << 48) ^ (std::size_t{s.begin} << 24) ^ s.end;
    }
  };
  std::unordered_map<Span, std::vector<syntax::SymbolId>, SpanHash> free_names;

  Keys keys;
};

// Rows of this layer beside vm::builtins(): phase functions.
std::span<const vm::Builtin> phase_builtins();

}  // namespace tyndall::eval
