// Errors, and how reading goes on after one: at the next item or closing bracket, so that one mistake is one
// error and several mistakes are several.
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/flood.h"
#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

// Reports what stands at `span`, unless that is what follows an error; reading goes on at a safe place.
void Parser::fail(const Span& span, std::string message, std::string help,
                  std::vector<Diagnostic::Note> notes) {
  if (!at(TokenKind::error)) note_mistake(span, std::move(message), std::move(help), std::move(notes));
  panic_ = true;
}

// Reports a mistake whose meaning is plain: reading goes on right here.
void Parser::note_mistake(const Span& span, std::string message, std::string help,
                          std::vector<Diagnostic::Note> notes) {
  if (panic_ || gave_up_) return;
  if (const std::optional<ForeignStatement> around = foreign_statement_around())
    diagnostics_.error(around->place, fmt::format("no statement '{}'", around->word),
                       std::string(around->help));
  else
    diagnostics_.error(span, std::move(message), std::move(help), std::move(notes));
  if (flooded(diagnostics_)) give_up();
}

// The rest of the file is not read.
void Parser::give_up() {
  gave_up_ = true;
  at_ = static_cast<std::uint32_t>(tokens_.tokens.size() - 1);
}

void Parser::too_deep(const Span& span) {
  fail(span, fmt::format("nested too deeply: at most {} levels are read", max_nesting),
       "give parts names with 'let', or repeat with 'for'");
  give_up();
}

// One level deeper; false, and an error, when that is too deep.
bool Parser::enter() {
  if (++depth_ <= max_nesting) return true;
  too_deep(peek().span);
  return false;
}

bool Parser::expect(TokenKind k, std::string_view after) {
  if (take_if(k)) return true;
  fail(peek().span, fmt::format("expected '{}' after {}, found {}", spelling(k), after, found()));
  return false;
}

// The next token as an error names it.
std::string Parser::found() const {
  if (at(TokenKind::name) || at(TokenKind::number) || at(TokenKind::color))
    return fmt::format("'{}'", text(peek()).substr(0, 80));
  const bool described = kind() <= TokenKind::string_tail;
  return described ? std::string(spelling(kind())) : fmt::format("'{}'", spelling(kind()));
}

// True where no recovery may go past: the end, and the end of the interpolation that we may be in.
bool Parser::ends_everything() const {
  return at(TokenKind::end_of_file) || at(TokenKind::string_middle) || at(TokenKind::string_tail);
}

// The token that closes what `k` opens; nothing when `k` opens nothing.
std::optional<TokenKind> Parser::closer_of(TokenKind k) {
  if (k == TokenKind::left_paren) return TokenKind::right_paren;
  if (k == TokenKind::left_bracket) return TokenKind::right_bracket;
  if (k == TokenKind::left_brace) return TokenKind::right_brace;
  if (k == TokenKind::string_head) return TokenKind::string_tail;
  return std::nullopt;
}

// Skips one token, or a whole bracketed group or string if one begins here.
void Parser::skip_group() {
  std::vector<TokenKind> closers;
  do {
    if (at(TokenKind::end_of_file)) return;
    if (const std::optional<TokenKind> closer = closer_of(kind())) {
      closers.push_back(*closer);
    } else if (at(TokenKind::string_middle) || at(TokenKind::string_tail)) {
      // Brackets left open inside an interpolation end with it.
      while (!closers.empty() && closers.back() != TokenKind::string_tail) closers.pop_back();
      if (closers.empty()) return;
      if (at(TokenKind::string_tail)) closers.pop_back();
    } else if (!closers.empty() && at(closers.back())) {
      closers.pop_back();
    }
    take();
  } while (!closers.empty());
}

// After an error in the item that began at `first_token`: goes to the next item, or the `}` of the block. A
// word at the beginning of a line that is not further in than the item's is one, whatever it is.
void Parser::synchronize(std::uint32_t first_token) {
  const std::size_t margin = diagnostics_.full() ? 0 : indentation(tokens_.tokens[first_token].span);
  const auto begins_line = [&] {
    return !diagnostics_.full() && is_word(kind()) && first_on_line(at_) &&
           indentation(peek().span) <= margin;
  };
  while (!ends_everything() && !at(TokenKind::right_brace)) {
    if (at_ > first_token && (begins_item(at_) || begins_line())) break;
    skip_group();
  }
  panic_ = false;
}

bool Parser::first_on_line(std::uint32_t token) const {
  if (token == 0) return true;
  const std::uint32_t begin = tokens_.tokens[token - 1].span.end;
  return source_text_.substr(begin, tokens_.tokens[token].span.begin - begin).find('\n') !=
         std::string_view::npos;
}

namespace {

// Reserved words that begin an item and no value; `if` begins both.
constexpr TokenKind item_words[] = {TokenKind::kw_let,    TokenKind::kw_var,    TokenKind::kw_def,
                                    TokenKind::kw_return, TokenKind::kw_medium, TokenKind::kw_material,
                                    TokenKind::kw_object, TokenKind::kw_place,  TokenKind::kw_include,
                                    TokenKind::kw_for};
// Beginnings of values; a `-` may stand before them.
constexpr TokenKind value_beginnings[] = {
    TokenKind::name,        TokenKind::number,     TokenKind::color,        TokenKind::string,
    TokenKind::string_head, TokenKind::kw_if,      TokenKind::kw_not,       TokenKind::kw_true,
    TokenKind::kw_false,    TokenKind::left_paren, TokenKind::left_bracket, TokenKind::left_brace};

bool is_one_of(std::span<const TokenKind> kinds, TokenKind k) {
  return std::find(kinds.begin(), kinds.end(), k) != kinds.end();
}

}  // namespace

// True if an item is likely to begin at this token: read only after an error.
bool Parser::begins_item(std::uint32_t token) const {
  const auto kind_at = [&](std::uint32_t i) {
    return i < tokens_.tokens.size() ? tokens_.tokens[i].kind : TokenKind::end_of_file;
  };
  const TokenKind word = kind_at(token), next = kind_at(token + 1);
  if (!is_word(word)) return false;
  if (next == TokenKind::colon || next == TokenKind::equals || is_one_of(item_words, word)) return true;
  if (word == TokenKind::kw_if) return first_on_line(token);
  if (word != TokenKind::name) return false;
  if (next == TokenKind::name || next == TokenKind::string)
    return kind_at(token + 2) == TokenKind::left_brace;
  return next == TokenKind::left_brace || (next == TokenKind::left_paren && first_on_line(token));
}

bool Parser::begins_value(TokenKind k) const { return is_one_of(value_beginnings, k); }

}  // namespace tyndall::syntax
