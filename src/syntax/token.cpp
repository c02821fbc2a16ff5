// The spelling of every token kind, in one table; the reserved words are read from it too.
#include "syntax/token.h"

#include <array>
#include <unordered_map>

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

TokenKind word_kind(std::string_view word) {
  static const auto reserved = [] {
    std::unordered_map<std::string_view, TokenKind> table;
    for (int k = static_cast<int>(TokenKind::kw_let); k <= static_cast<int>(TokenKind::kw_false); ++k)
      table.emplace(spelling(static_cast<TokenKind>(k)), static_cast<TokenKind>(k));
    return table;
  }();
  if (word.size() > 8) return TokenKind::name;  // "material" is the longest
  const auto found = reserved.find(word);
  return found == reserved.end() ? TokenKind::name : found->second;
}

}  // namespace tyndall::syntax
