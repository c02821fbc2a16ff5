// Items written wrong in ways whose meaning is plain: each is told with what to write, and read as it was
// meant.
#include <fmt/format.h>

#include <algorithm>

#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

// What begins no item is reported.
std::optional<Parser::ItemNode> Parser::not_an_item() {
  if (at(TokenKind::right_brace) || at(TokenKind::right_paren) || at(TokenKind::right_bracket)) {
    fail(peek().span, fmt::format("{} closes nothing", found()));
    take();
  } else if (at(TokenKind::comma)) {
    fail(peek().span, "no ',' is needed here");
  } else if (at(TokenKind::kw_else)) {
    fail(peek().span, "'else' without 'if'", "it follows the '}' of an 'if'");
  } else {
    fail(peek().span, fmt::format("expected a statement, found {}", found()),
         place_ == BlockPlace::thing && at(TokenKind::less) ? "parameters have names, as in center: (x, y, z)"
         : begins_value(kind())                             ? "is an operator or a comma missing before it?"
                                                            : "statements begin with a word");
  }
  return std::nullopt;
}

// True where the value of a parameter stands and its ':' was forgotten.
bool Parser::value_without_colon() const {
  static constexpr TokenKind beginnings[] = {TokenKind::number,      TokenKind::color,    TokenKind::less,
                                             TokenKind::kw_true,     TokenKind::kw_false, TokenKind::minus,
                                             TokenKind::left_bracket};
  if (place_ != BlockPlace::thing) return false;
  if (std::find(std::begin(beginnings), std::end(beginnings), kind()) != std::end(beginnings)) return true;
  return at(TokenKind::name) &&
         (kind(1) == TokenKind::right_brace || (is_word(kind(1)) && kind(2) == TokenKind::colon));
}

Parser::ItemNode Parser::parameter_without_colon(const Name& name) {
  const bool angle_bracket = at(TokenKind::less);
  note_mistake(
      peek().span, fmt::format("expected ':' after '{}', found {}", text(name), found()),
      fmt::format("a parameter is written {}: {}", text(name), angle_bracket ? "(x, y, z)" : "value"));
  if (!angle_bracket) return ParameterItem{name, expression()};
  while (!ends_everything() && !at(TokenKind::greater) && !at(TokenKind::right_brace) && !begins_item(at_))
    skip_group();
  take_if(TokenKind::greater);
  return ParameterItem{name, error_expr()};
}

// True if `medium` or `material`, which stands here, begins a definition; else it is a parameter's name.
bool Parser::begins_body() const {
  // In tokens: brackets that are never closed must not be read to the end again and again.
  constexpr std::uint32_t furthest = 500;
  std::uint32_t ahead = 2;
  if (kind(1) == TokenKind::name && kind(ahead) == TokenKind::left_paren) {
    std::uint32_t open = 0;
    do {
      if (kind(ahead) == TokenKind::end_of_file || ahead > furthest) return true;
      if (kind(ahead) == TokenKind::left_paren) ++open;
      if (kind(ahead) == TokenKind::right_paren) --open;
      ++ahead;
    } while (open > 0);
  }
  return kind(1) != TokenKind::name || kind(ahead) == TokenKind::left_brace ||
         kind(ahead) == TokenKind::equals;
}

// The name of a file without its quotes, as in lib/fire.tyn; nothing where something else is included.
std::optional<Parser::ItemNode> Parser::include_without_quotes() {
  const auto joins = [](TokenKind k) {
    return k == TokenKind::dot || k == TokenKind::slash || k == TokenKind::minus;
  };
  if (!at(TokenKind::name)) return std::nullopt;
  std::uint32_t tokens = 1;
  while (joins(kind(tokens)) && is_word(kind(tokens + 1))) tokens += 2;
  if (tokens < 3 || kind(tokens - 2) != TokenKind::dot || text(peek(tokens - 1)) != "tyn")
    return std::nullopt;
  const std::uint32_t first = at_;
  at_ += tokens;
  const Span file = span_from(first);
  note_mistake(file, "the name of a file stands in quotes",
               fmt::format("write include \"{}\"", source_text_.substr(file.begin, file.end - file.begin)));
  return IncludeItem{error_expr()};
}

}  // namespace tyndall::syntax
