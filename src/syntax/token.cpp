// The spelling of every token kind, in one table; the reserved words are read from it too.
#include "syntax/token.h"

#include <array>

namespace tyndall::syntax {

std::string_view spelling(TokenKind kind) {
  switch (kind) {
    case TokenKind::end_of_file:
      return "the end of the file";
    case TokenKind::error:
      return "unreadable text";
    case TokenKind::name:
      return "a name";
    case TokenKind::number:
      return "a number";
    case TokenKind::color:
      return "a colour";
    case TokenKind::string:
      return "a string";
    case TokenKind::string_head:
      return "a string with values";
    case TokenKind::string_middle:
      return "the middle of a string";
    case TokenKind::string_tail:
      return "the rest of a string";
    case TokenKind::kw_let:
      return "let";
    case TokenKind::kw_var:
      return "var";
    case TokenKind::kw_def:
      return "def";
    case TokenKind::kw_return:
      return "return";
    case TokenKind::kw_medium:
      return "medium";
    case TokenKind::kw_material:
      return "material";
    case TokenKind::kw_object:
      return "object";
    case TokenKind::kw_place:
      return "place";
    case TokenKind::kw_include:
      return "include";
    case TokenKind::kw_if:
      return "if";
    case TokenKind::kw_then:
      return "then";
    case TokenKind::kw_else:
      return "else";
    case TokenKind::kw_for:
      return "for";
    case TokenKind::kw_in:
      return "in";
    case TokenKind::kw_and:
      return "and";
    case TokenKind::kw_or:
      return "or";
    case TokenKind::kw_not:
      return "not";
    case TokenKind::kw_true:
      return "true";
    case TokenKind::kw_false:
      return "false";
    case TokenKind::left_paren:
      return "(";
    case TokenKind::right_paren:
      return ")";
    case TokenKind::left_bracket:
      return "[";
    case TokenKind::right_bracket:
      return "]";
    case TokenKind::left_brace:
      return "{";
    case TokenKind::right_brace:
      return "}";
    case TokenKind::comma:
      return ",";
    case TokenKind::colon:
      return ":";
    case TokenKind::dot:
      return ".";
    case TokenKind::equals:
      return "=";
    case TokenKind::plus:
      return "+";
    case TokenKind::minus:
      return "-";
    case TokenKind::star:
      return "*";
    case TokenKind::slash:
      return "/";
    case TokenKind::caret:
      return "^";
    case TokenKind::less:
      return "<";
    case TokenKind::less_equal:
      return "<=";
    case TokenKind::greater:
      return ">";
    case TokenKind::greater_equal:
      return ">=";
    case TokenKind::equal_equal:
      return "==";
    case TokenKind::not_equal:
      return "!=";
    case TokenKind::dot_dot:
      return "..";
    case TokenKind::dot_dot_less:
      return "..<";
  }
  return {};
}

std::string_view spelling(Unit unit) {
  switch (unit) {
    case Unit::none:
      return "";
    case Unit::length:
      return "m";
    case Unit::time:
      return "s";
    case Unit::temperature:
      return "K";
    case Unit::angle:
      return "rad";
  }
  return {};
}

namespace {

// The letters of a word of up to eight as one number.
std::uint64_t packed(std::string_view word) {
  std::uint64_t letters = 0;
  for (const char c : word) letters = letters << 8 | static_cast<unsigned char>(c);
  return letters;
}

}  // namespace

TokenKind word_kind(std::string_view word) {
  constexpr std::size_t first = static_cast<std::size_t>(TokenKind::kw_let),
                        count = static_cast<std::size_t>(TokenKind::kw_false) - first + 1;
  static const auto reserved = [] {
    std::array<std::uint64_t, count> table{};
    for (std::size_t k = 0; k < count; ++k) table[k] = packed(spelling(static_cast<TokenKind>(first + k)));
    return table;
  }();
  if (word.size() > 8) return TokenKind::name;  // "material" is the longest
  const std::uint64_t letters = packed(word);
  for (std::size_t k = 0; k < count; ++k)
    if (reserved[k] == letters) return static_cast<TokenKind>(first + k);
  return TokenKind::name;
}

}  // namespace tyndall::syntax
