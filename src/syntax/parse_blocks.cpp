// Blocks and whole files; the entry points of the parser; adding nodes.
#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

// Room made at once for the expressions of a text; more grows by doubling.
static constexpr std::size_t max_exprs_reserved = std::size_t{1} << 23;

SyntaxTree parse(const Sources& sources, SourceId source, const TokenList& tokens, Symbols& symbols,
                 Diagnostics& diagnostics) {
  return Parser(sources, source, tokens, symbols, diagnostics).file();
}

ParsedExpression parse_expression(const Sources& sources, SourceId source, const TokenList& tokens,
                                  Symbols& symbols, Diagnostics& diagnostics) {
  return Parser(sources, source, tokens, symbols, diagnostics).only_expression();
}

Parser::Parser(const Sources& sources, SourceId source, const TokenList& tokens, Symbols& symbols,
               Diagnostics& diagnostics)
    : source_text_(sources[source].text()), tokens_(tokens), symbols_(symbols), diagnostics_(diagnostics) {
  CHECK(!tokens.tokens.empty() && tokens.tokens.back().kind == TokenKind::end_of_file);
  tree_.source = source;
  // Plain numbers take the most: about every other token is one.
  const std::size_t room = std::min(tokens.tokens.size() / 2 + 16, max_exprs_reserved);
  tree_.exprs.reserve(room);
  expr_heights_.reserve(room);
}

// file = { item }
SyntaxTree Parser::file() {
  std::vector<ItemId> list;
  items(list, std::nullopt);
  tree_.file = add_block(0, list, 0);
  const bool nothing_read = tokens_.tokens.size() == 2 && tokens_.tokens[0].kind == TokenKind::error;
  tree_.gave_up = gave_up_ || nothing_read;
  return std::move(tree_);
}

ParsedExpression Parser::only_expression() {
  const ExprId expr = expression();
  if (!panic_ && !at(TokenKind::end_of_file))
    fail(peek().span, fmt::format("expected nothing after the value, found {}", found()));
  tree_.file = add_block(0, {}, 0);
  return {std::move(tree_), expr};
}

// block = "{" { item } "}"
BlockId Parser::block(BlockPlace place, std::string_view owner) {
  if (at(TokenKind::colon) && !panic_) return indented_block(place, owner);
  const std::uint32_t first = at_;
  const std::uint32_t outer_tallest = std::exchange(tallest_, 0);
  std::vector<ItemId> list;
  // One item on the line of a header, without its braces.
  const bool bare = !panic_ && place != BlockPlace::thing && begins_item(at_) && !first_on_line(at_);
  if (enter() && (bare || open_block(owner))) {
    const BlockPlace outer_place = std::exchange(place_, place);
    const bool in_header = std::exchange(brace_opens_body_, false);
    if (bare) {
      note_mistake(peek().span, fmt::format("expected '{{' after {}, found {}", owner, found()),
                   "what belongs to it goes in braces: { … }");
      if (const std::optional<ItemId> only = item()) list.push_back(*only);
    } else {
      items(list, peek().span);
    }
    brace_opens_body_ = in_header;
    place_ = outer_place;
  }
  leave();
  return add_block(first, list, outer_tallest);
}

// Goes to the `{` that opens a block, which `owner` wants. After an error in the block's header it is looked
// for; where it was forgotten, and parameters follow, they are read as if it stood there.
bool Parser::open_block(std::string_view owner) {
  if (panic_) {
    while (!ends_everything() && !at(TokenKind::left_brace) && !at(TokenKind::right_brace) &&
           !begins_item(at_))
      skip_group();
    if (!at(TokenKind::left_brace)) return false;
    panic_ = false;
  }
  if (at(TokenKind::left_brace)) return true;
  const bool parameters_follow = is_word(kind()) && kind(1) == TokenKind::colon;
  const std::string message = fmt::format("expected '{{' after {}, found {}", owner, found());
  if (!parameters_follow) {
    fail(peek().span, message);
    return false;
  }
  note_mistake(peek().span, message, "parameters stand in braces: { name: value }");
  return true;
}

// Reads the items of a block, whose `{` stands at `open`, up to and with its `}`; or of a file.
void Parser::items(std::vector<ItemId>& out, const std::optional<Span>& open) {
  if (open) take_if(TokenKind::left_brace);
  for (;;) {
    if (open && at(TokenKind::right_brace)) {
      const Span close = take().span;
      if (!doubtful_brace_.valid() && first_on_line(at_ - 1) && indentation(close) < indentation(*open))
        doubtful_brace_ = *open;
      return;
    }
    if (at(TokenKind::end_of_file) || (open && ends_everything())) break;
    read_item(out);
  }
  if (open) never_closed(*open);
}

void Parser::read_item(std::vector<ItemId>& out) {
  if (source_text_[peek().span.begin] == '#' && skip_directive()) return;
  const std::uint32_t first = at_;
  const std::optional<ItemId> id = item();
  if (id)
    out.push_back(*id);
  else
    note_unread_definition(first);
  if (panic_) synchronize(first);
  if (at_ == first) take();  // never stand still
  after_item(id);
}

// A definition that could not be read has a name all the same: its uses are no mistakes.
void Parser::note_unread_definition(std::uint32_t first_token) {
  static constexpr TokenKind defining[] = {TokenKind::kw_let,      TokenKind::kw_var,
                                           TokenKind::kw_def,      TokenKind::kw_medium,
                                           TokenKind::kw_material, TokenKind::kw_object};
  if (std::find(std::begin(defining), std::end(defining), tokens_.tokens[first_token].kind) ==
      std::end(defining))
    return;
  const Token& name = tokens_.tokens[first_token + 1];  // there is the end of the file at least
  if (name.kind == TokenKind::name) tree_.unread_definitions.push_back(symbols_.intern(text(name)));
}

// Missing braces show at the end of the file only; indentation tells where one is likely to be missing.
void Parser::never_closed(const Span& open) {
  std::vector<Diagnostic::Note> notes;
  if (doubtful_brace_.valid() && doubtful_brace_.begin > open.begin)
    notes.push_back({doubtful_brace_, "judging by the indentation, the '}' of this '{' is missing"});
  note_mistake(open, "this '{' is never closed", "a '}' is missing, here or in a block inside",
               std::move(notes));
}

// Blank columns at the beginning of the line on which `place` stands.
std::size_t Parser::indentation(const Span& place) const {
  const std::size_t line_end = source_text_.rfind('\n', place.begin);
  const std::size_t begin = line_end == std::string_view::npos ? 0 : line_end + 1;
  const std::size_t word = source_text_.find_first_not_of(" \t", begin);
  return (word == std::string_view::npos ? source_text_.size() : word) - begin;
}

BlockId Parser::add_block(std::uint32_t first_token, const std::vector<ItemId>& list,
                          std::uint32_t outer_tallest) {
  const std::uint32_t own = 1 + tallest_;
  const Span span = span_from(first_token);
  if (own > max_nesting) too_deep(span);
  tree_.blocks.push_back({span, append(tree_.item_list, list)});
  block_heights_.push_back(own);
  tallest_ = std::max(outer_tallest, own);
  return BlockId(tree_.blocks.size() - 1);
}

ExprId Parser::add(std::uint32_t first_token, ExprNode node, std::uint32_t subtree_height) {
  const Span span = span_from(first_token);
  if (subtree_height > max_nesting) {
    too_deep(tokens_.tokens[first_token].span);
    node = ErrorExpr{};
    subtree_height = 1;
  }
  tree_.exprs.push_back({span, std::move(node)});
  expr_heights_.push_back(subtree_height);
  tallest_ = std::max(tallest_, subtree_height);
  return ExprId(tree_.exprs.size() - 1);
}

}  // namespace tyndall::syntax
