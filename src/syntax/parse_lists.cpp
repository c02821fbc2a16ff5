// What follows an element of a list in ( ) or [ ]: a comma, the end, or a mistake.
#include <fmt/format.h>

#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

Parser::AfterElement Parser::after_element(TokenKind close, const Span& open) {
  if (take_if(TokenKind::comma)) {
    while (at(TokenKind::comma)) note_mistake(take().span, "a value is missing before this ','");
    return AfterElement::next;
  }
  if (take_if(close)) return AfterElement::done;
  const std::string_view opener = close == TokenKind::right_paren ? "(" : "[";
  const std::vector<Diagnostic::Note> notes{{open, fmt::format("the '{}' is here", opener)}};
  if ((begins_value(kind()) || at(TokenKind::minus)) && closes_ahead(close)) {
    note_mistake(peek().span, fmt::format("a ',' is missing before {}", found()),
                 fmt::format("values in '{} {}' are parted by commas", opener, spelling(close)));
    return AfterElement::next;
  }
  if (at(TokenKind::right_paren) || at(TokenKind::right_bracket)) {
    note_mistake(take().span, fmt::format("expected '{}' to close '{}'", spelling(close), opener), {}, notes);
    return AfterElement::broken;
  }
  const bool ends_here = ends_everything() || at(TokenKind::right_brace) || begins_item(at_);
  if (ends_here && !closes_ahead(close)) {
    note_mistake(peek().span, fmt::format("expected ',' or '{}' before {}", spelling(close), found()),
                 fmt::format("'{}' is not closed", opener), notes);
    return AfterElement::broken;
  }
  fail(peek().span, fmt::format("expected ',' or '{}', found {}", spelling(close), found()), {}, notes);
  return recover_in_list(close) ? AfterElement::next : AfterElement::broken;
}

// After an error in a list: goes to its next element or before its end, which is true; or to where the list
// can reach no further.
bool Parser::recover_in_list(TokenKind close) {
  while (!ends_everything() && !at(TokenKind::right_brace)) {
    if (at(close) || take_if(TokenKind::comma)) {
      panic_ = false;
      return true;
    }
    if (at(TokenKind::right_paren) || at(TokenKind::right_bracket)) break;
    if (is_word(kind()) && kind(1) != TokenKind::colon && !at(TokenKind::name) && begins_item(at_)) break;
    skip_group();
  }
  return false;
}

// True if the list is closed before the block or the next definition: then a comma is what is missing here.
bool Parser::closes_ahead(TokenKind close) const {
  constexpr std::uint32_t tokens_looked_at = 256;
  std::uint32_t open = 0;  // brackets of any kind
  for (std::uint32_t ahead = 0; ahead < tokens_looked_at; ++ahead) {
    const TokenKind k = kind(ahead);
    if (k == TokenKind::end_of_file) return false;
    if (open == 0) {
      if (k == close) return true;
      if (is_word(k) && kind(ahead + 1) == TokenKind::equals) return false;
      if (is_reserved(k) && kind(ahead + 1) != TokenKind::colon && begins_item(at_ + ahead)) return false;
    }
    const bool opens = closer_of(k).has_value();
    const bool closes = k == TokenKind::right_paren || k == TokenKind::right_bracket ||
                        k == TokenKind::right_brace || k == TokenKind::string_tail;
    if (closes && open == 0) return false;
    open = open + (opens ? 1 : 0) - (closes ? 1 : 0);
  }
  return false;
}

}  // namespace tyndall::syntax
