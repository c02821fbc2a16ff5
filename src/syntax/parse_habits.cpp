// What users of POV-Ray, PBRT and Python write out of habit: told once, and passed over or read as it was
// meant.
#include <fmt/format.h>

#include <algorithm>

#include "syntax/foreign_words.h"
#include "syntax/lexer.h"
#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

namespace {

// Directives that an #end ends.
constexpr std::string_view opening_directives[] = {"#if",    "#for",    "#while", "#macro",
                                                   "#ifdef", "#ifndef", "#switch"};

bool opens_directive(std::string_view text) {
  return text.size() > 1 && text.front() == '#' &&
         std::find(std::begin(opening_directives), std::end(opening_directives), text) !=
             std::end(opening_directives);
}

}  // namespace

// Passes over all from a directive to its #end: the directives in it were told as they were lexed, and what
// they define is known to be defined. False where no #end follows.
bool Parser::skip_directive() {
  constexpr std::uint32_t furthest =
      5000;  // in tokens: what is never ended must not be searched again and again
  if (!opens_directive(text(peek()))) return false;
  std::uint32_t open = 0, end = 0;
  for (std::uint32_t ahead = 0; ahead < furthest && kind(ahead) != TokenKind::end_of_file && end == 0;
       ++ahead) {
    if (opens_directive(text(peek(ahead)))) ++open;
    if (text(peek(ahead)) == "#end" && --open == 0) end = ahead + 1;
  }
  for (std::uint32_t i = 0; i < end; ++i) {
    const bool defines = kind() == TokenKind::kw_let || kind() == TokenKind::kw_def;
    if (defines && kind(1) == TokenKind::name)
      tree_.unread_definitions.push_back(symbols_.intern(text(peek(1))));
    take();
  }
  return end != 0;
}

// Goes to the first token of the next line, past groups that are opened on this one, or before the block's
// end.
void Parser::skip_line() {
  while (!ends_everything() && !at(TokenKind::right_brace) && !first_on_line(at_)) skip_group();
}

// True for the steps of a function: something is returned, and nothing is placed.
bool Parser::gives_value(BlockId id) const {
  const auto items_of = [&](BlockId block) { return tree_.list_of_items(tree_[block].items); };
  const auto places = [](const Item& item) {
    return std::holds_alternative<ThingItem>(item.node) || std::holds_alternative<PlaceItem>(item.node) ||
           std::holds_alternative<CallItem>(item.node);
  };
  bool returns = false;
  for (const ItemId item : items_of(id)) {
    if (places(tree_[item])) return false;
    const auto& node = tree_[item].node;
    returns |= std::holds_alternative<ReturnItem>(node);
    if (const auto* loop = std::get_if<ForItem>(&node)) returns |= gives_value(loop->body);
    if (const auto* choice = std::get_if<IfItem>(&node))
      returns |=
          gives_value(choice->then_block) || (choice->else_block.valid() && gives_value(choice->else_block));
  }
  return returns;
}

// A block as Python writes it: ':', then what is further in than the line of the header.
BlockId Parser::indented_block(BlockPlace place, std::string_view owner) {
  const std::uint32_t first = at_;
  const std::uint32_t outer_tallest = std::exchange(tallest_, 0);
  const std::size_t header = diagnostics_.full() ? 0 : indentation(peek().span);
  note_mistake(take().span, fmt::format("expected '{{' after {}, found ':'", owner),
               "what belongs to it goes in braces, however it is indented: { … }");
  std::vector<ItemId> list;
  if (enter()) {
    const BlockPlace outer_place = std::exchange(place_, place);
    const bool in_header = std::exchange(brace_opens_body_, false);
    while (!ends_everything() && !at(TokenKind::right_brace) &&
           !(first_on_line(at_) && indentation(peek().span) <= header))
      read_item(list);
    brace_opens_body_ = in_header;
    place_ = outer_place;
  }
  leave();
  return add_block(first, list, outer_tallest);
}

// True where a block follows the words of a thing.
bool Parser::begins_thing() const {
  if (at(TokenKind::left_brace)) return true;
  const bool one_word = at(TokenKind::name) || at(TokenKind::string);
  if (one_word && kind(1) == TokenKind::left_brace) return true;
  return at(TokenKind::name) && kind(1) == TokenKind::string && kind(2) == TokenKind::left_brace;
}

// True after reporting a statement of another program and passing over its line.
bool Parser::statement_of_others(const Name& keyword) {
  const std::string_view help = help_for_foreign_word(ForeignUse::statement, text(keyword));
  if (help.empty()) return false;
  const bool definition = at(TokenKind::name) && !first_on_line(at_);  // `float x = 1`
  fail(keyword.span, fmt::format("no statement '{}'", text(keyword)),
       definition && kind(1) == TokenKind::equals ? fmt::format("write let {} = …", text(peek()))
                                                  : std::string(help));
  if (definition) tree_.unread_definitions.push_back(symbols_.intern(text(peek())));
  skip_line();
  return true;
}

// A word that begins nothing: on a line of its own, or before a name that is set.
std::optional<Parser::ItemNode> Parser::lone_word(const Name& keyword, bool alone) {
  const std::string_view word = text(keyword), next = text(peek());
  fail(keyword.span,
       fmt::format("'{}' does nothing here: expected '{{', '(', ':' or '=' after it, found {}", word,
                   alone ? "the end of the line" : found()),
       alone
           ? fmt::format("write {0} {{ … }} for a thing, {0}(…) for a template, let {0} = … for a name", word)
           : fmt::format("write let {} = …", next));
  if (alone) return std::nullopt;
  tree_.unread_definitions.push_back(symbols_.intern(next));
  skip_line();
  return std::nullopt;
}

// The unit of a number that stands beside it, as in `5 cm`; the number's own where the next word begins
// something else.
Unit Parser::parted_unit(const Token& number, double& value) {
  static constexpr TokenKind beginnings[] = {TokenKind::colon, TokenKind::equals, TokenKind::left_paren,
                                             TokenKind::left_brace, TokenKind::dot};
  if (number.unit != Unit::none || first_on_line(at_) ||
      std::find(std::begin(beginnings), std::end(beginnings), kind(1)) != std::end(beginnings))
    return number.unit;
  const std::string_view word = text(peek());
  if (const std::string_view help = help_for_foreign_word(ForeignUse::unit, word); !help.empty()) {
    note_mistake(take().span, fmt::format("'{}' is not a unit", word), std::string(help));
    return Unit::none;
  }
  const Unit unit = with_unit(word, value);
  if (unit != Unit::none)
    note_mistake(join(number.span, take().span), "a unit is joined to its number",
                 fmt::format("write {}{}", text(number), word));
  return unit;
}

// `rgb <1, 0, 0>`: the word before a vector of POV-Ray.
bool Parser::vector_word(const Name& name) const {
  static constexpr std::string_view words[] = {"rgb", "srgb", "rgbf", "rgbt", "rgbft", "color", "vector"};
  return std::find(std::begin(words), std::end(words), text(name)) != std::end(words);
}

// `place tree` or `place tree()`, read as if `{}` stood there.
PlaceItem Parser::placed_without_braces(const Name& name, ListRef arguments) {
  const bool called = tokens_.tokens[at_ - 1].kind == TokenKind::right_paren;
  note_mistake(name.span, fmt::format("expected '{{' after 'place {}', found {}", text(name), found()),
               fmt::format("write place {}{} {{}}", text(name), called ? "(…)" : ""));
  const std::uint32_t outer_tallest = std::exchange(tallest_, 0);
  return {name, arguments, add_block(at_, {}, outer_tallest)};
}

// The innermost statement of another program in whose braces the next token stands: what is wrong in there is
// no mistake of its own. Asked for errors only.
std::optional<Parser::ForeignStatement> Parser::foreign_statement_around() const {
  constexpr std::uint32_t furthest = 2000;  // tokens
  if (diagnostics_.full()) return std::nullopt;
  std::uint32_t closed = 0;
  for (std::uint32_t i = at_, looked_at = 0; i > 1 && looked_at < furthest; ++looked_at) {
    --i;
    const TokenKind k = tokens_.tokens[i].kind;
    if (k == TokenKind::right_brace) ++closed;
    if (k != TokenKind::left_brace) continue;
    if (closed > 0) {
      --closed;
      continue;
    }
    // `word {`, `word kind {`, `word "file" {`; but not what a definition names.
    std::uint32_t word = i - 1;
    const auto is_name = [&](std::uint32_t t) { return tokens_.tokens[t].kind == TokenKind::name; };
    if (word > 0 && is_name(word - 1) && !first_on_line(word)) --word;
    if (!is_name(word) || (word > 0 && is_reserved(tokens_.tokens[word - 1].kind))) continue;
    const std::string_view name = text(tokens_.tokens[word]);
    const std::string_view help = help_for_foreign_word(ForeignUse::statement, name);
    if (!help.empty()) return ForeignStatement{tokens_.tokens[word].span, name, help};
  }
  return std::nullopt;
}

}  // namespace tyndall::syntax
