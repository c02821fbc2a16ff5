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
  } else if (is_comment_of_others()) {
    fail(peek().span, "expected a statement, found '--'", "a comment begins with '//'");
    skip_line();
  } else if (place_ == BlockPlace::thing && at(TokenKind::string) && kind(1) == TokenKind::colon) {
    note_mistake(peek().span, "the name of a parameter is written without quotes",
                 fmt::format("write {}: value", tokens_.strings[peek().text]));
    const Name name{symbols_.intern(tokens_.strings[peek().text]), take().span};
    take();
    return ParameterItem{name, expression()};
  } else if (at(TokenKind::kw_else)) {
    fail(peek().span, "'else' without 'if'", "it follows the '}' of an 'if'");
  } else {
    fail(peek().span, fmt::format("expected a statement, found {}", found()),
         place_ == BlockPlace::thing && (at(TokenKind::less) || at(TokenKind::left_paren))
             ? "parameters have names, as in center: (x, y, z)"
         : begins_value(kind()) ? "is an operator or a comma missing before it?"
                                : "statements begin with a word");
  }
  return std::nullopt;
}

// `albedo.x = 1`, `sphere [ radius: 1 ]`: what follows a word that begins an item.
void Parser::part_of_a_word(const std::string& owner) {
  if (at(TokenKind::left_bracket) && is_word(kind(1)) && kind(2) == TokenKind::colon)
    return fail(peek().span, fmt::format("expected '{{' after '{}', found '['", owner),
                "parameters stand in braces: { name: value }");
  note_mistake(peek().span, fmt::format("parts of '{}' cannot be set or used as a statement", owner),
               "set the whole: name = value");
  while (at(TokenKind::dot) || at(TokenKind::left_bracket) || at(TokenKind::name)) {
    if (at(TokenKind::name) && tokens_.tokens[at_ - 1].kind != TokenKind::dot) break;
    skip_group();
  }
  if (at(TokenKind::left_paren)) skip_group();
  if (take_if(TokenKind::equals)) expression();
}

// `let a, b`, `let a`, `let a-b = 3`: true after reporting a definition without its '='.
bool Parser::no_value_defined(const Name& name) {
  if (at(TokenKind::minus)) {
    fail(peek().span, fmt::format("expected '=' after '{}', found '-'", text(name)),
         "a name has letters, digits and _");
    skip_line();
    return true;
  }
  if (!at(TokenKind::comma) && !first_on_line(at_)) return false;
  fail(name.span, fmt::format("'{}' has no value", text(name)),
       fmt::format("write let {} = value, each name with a let of its own", text(name)));
  for (std::uint32_t i = 0; kind(i) == TokenKind::comma && kind(i + 1) == TokenKind::name; i += 2)
    tree_.unread_definitions.push_back(symbols_.intern(text(peek(i + 1))));
  return true;
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
  if (at(TokenKind::less)) {
    const Span open = take().span;
    while (!ends_everything() && !at(TokenKind::greater) && !first_on_line(at_)) take();
    const Span file = join(open, peek().span);
    note_mistake(
        file, "the name of a file goes in quotes",
        fmt::format("write include \"{}\"", source_text_.substr(open.end, peek().span.begin - open.end)));
    take_if(TokenKind::greater);
    return IncludeItem{error_expr()};
  }
  if (!at(TokenKind::name)) return std::nullopt;
  std::uint32_t tokens = 1;
  while (joins(kind(tokens)) && is_word(kind(tokens + 1))) tokens += 2;
  if (tokens < 3 || kind(tokens - 2) != TokenKind::dot || text(peek(tokens - 1)) != "tyn")
    return std::nullopt;
  const std::uint32_t first = at_;
  at_ += tokens;
  const Span file = span_from(first);
  note_mistake(file, "the name of a file goes in quotes",
               fmt::format("write include \"{}\"", source_text_.substr(file.begin, file.end - file.begin)));
  return IncludeItem{error_expr()};
}

}  // namespace tyndall::syntax
