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
  if (at(TokenKind::kw_for)) {
    note_mistake(peek().span, "'for' stands behind the first entry of a list in [ ]",
                 "write [i * i for i in 0..<10]; things are repeated by for i in 0..<10 { … }");
    while (!ends_everything() && !at(close) && !at(TokenKind::right_brace)) skip_group();
    take_if(close);
    return AfterElement::broken;
  }
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

// Whether a name with an index is followed by '='.
bool Parser::sets_entry() const {
  constexpr std::uint32_t tokens_looked_at = 1024;
  if (!at(TokenKind::name) || kind(1) != TokenKind::left_bracket) return false;
  std::uint32_t open = 0;
  for (std::uint32_t ahead = 1; ahead < tokens_looked_at; ++ahead) {
    const TokenKind k = kind(ahead);
    if (k == TokenKind::end_of_file) return false;
    if (k == TokenKind::left_bracket) ++open;
    if (k == TokenKind::right_bracket && --open == 0) return kind(ahead + 1) == TokenKind::equals;
  }
  return false;
}

// assign = name "[" expression "]" "=" expression, which sets the name to the list with another entry.
std::optional<Parser::ItemNode> Parser::assign_entry() {
  const std::uint32_t first = at_;
  const Name name = take_name();
  const ExprId list = add(first, NameExpr{name.symbol}, 1);
  const ExprId indexed = index(list, first);
  if (!take_if(TokenKind::equals)) return std::nullopt;  // after an error in the index
  const ExprId entry = expression();
  const auto* place = std::get_if<IndexExpr>(&tree_[indexed].node);
  if (!place) return AssignItem{name, error_expr()};  // told already
  const WithEntryExpr set{list, place->index, entry};
  return AssignItem{name, add(first, set, 1 + std::max(height(indexed), height(entry)))};
}

// each = "for" name "in" header_value [ "if" header_value ], behind the element of a list; the last one turns
// fastest.
ExprId Parser::each(ExprId element, std::uint32_t first_token) {
  const std::optional<Name> name = name_of_rounds("a list is written: [i * i for i in 0..<10]");
  const ExprId over = header_value();
  ExprId condition;
  if (!panic_ && take_if(TokenKind::kw_if)) condition = header_value();
  if (!panic_ && (at(TokenKind::kw_then) || at(TokenKind::kw_else)))
    fail(peek().span, fmt::format("expected ']' after the condition, found {}", found()),
         "a choice stands before 'for': [if a then b else c for i in 0..<10]");
  const bool nests = !panic_ && at(TokenKind::kw_for);
  if (nests) element = each(element, first_token);
  std::uint32_t tallest = std::max(height(over), height(element));
  if (condition.valid()) tallest = std::max(tallest, height(condition));
  if (panic_ || !name) return error_expr();
  tree_.comprehensions.push_back({*name, over, condition, element, nests});
  return add(first_token, ComprehensionExpr{static_cast<std::uint32_t>(tree_.comprehensions.size() - 1)},
             1 + tallest);
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
