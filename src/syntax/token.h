// Tokens: the words of the scene language.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"

namespace tyndall::syntax {

enum class TokenKind : std::uint8_t {
  end_of_file,
  error,   // text that is no word of the language; already reported, so whoever meets it stays silent
  name,    // any word that is not reserved
  number,  // value and unit
  color,   // #rrggbb or #rgb
  string,  // without interpolations
  // "a{x}b{y}c" is string_head a, the tokens of x, string_middle b, the tokens of y, string_tail c. Heads and
  // tails always match, whatever the text.
  string_head,
  string_middle,
  string_tail,
  // reserved words
  kw_let,
  kw_var,
  kw_def,
  kw_return,
  kw_medium,
  kw_material,
  kw_object,
  kw_place,
  kw_include,
  kw_if,
  kw_then,
  kw_else,
  kw_for,
  kw_in,
  kw_and,
  kw_or,
  kw_not,
  kw_true,
  kw_false,
  // punctuation
  left_paren,
  right_paren,
  left_bracket,
  right_bracket,
  left_brace,
  right_brace,
  comma,
  colon,
  dot,
  equals,
  plus,
  minus,
  star,
  slash,
  caret,
  less,
  less_equal,
  greater,
  greater_equal,
  equal_equal,
  not_equal,
  dot_dot,       // a..b
  dot_dot_less,  // a..<b
};

// The word as it stands in a scene ("let", "..<"), or a description ("a name", "a number") for open classes.
std::string_view spelling(TokenKind kind);

// True for the reserved words.
constexpr bool is_reserved(TokenKind kind) {
  return kind >= TokenKind::kw_let && kind <= TokenKind::kw_false;
}
// True for names and reserved words: whatever may stand before a `:`.
constexpr bool is_word(TokenKind kind) { return kind == TokenKind::name || is_reserved(kind); }
// The reserved word of this spelling, or `name`.
TokenKind word_kind(std::string_view word);

// Units that may be joined to a number. The number's value is already in the base unit (m, s, K, rad, 1).
enum class Unit : std::uint8_t { none, length, time, temperature, angle };
// The base unit as it is written: "m", "s", "K", "rad", or nothing.
std::string_view spelling(Unit unit);

struct Token {
  TokenKind kind = TokenKind::end_of_file;
  Unit unit = Unit::none;  // number
  Span span;
  union {
    double number = 0;   // number: in base units
    std::uint32_t text;  // string…: index into TokenList::strings; color: 0xrrggbb as written (sRGB)
  };
};
static_assert(sizeof(Token) == 24);  // long lists of numbers are many tokens

struct TokenList {
  std::vector<Token> tokens;         // ends with end_of_file
  std::vector<std::string> strings;  // texts of string tokens, escapes resolved
  std::vector<Span> comments;        // in order; without the line break that ends a `//` comment
};

}  // namespace tyndall::syntax
