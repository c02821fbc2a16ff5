// The lexer's state; its parts by job: lexer.cpp (the loop, words, comments, punctuation), lex_number.cpp,
// lex_string.cpp, lex_mistakes.cpp (spellings of other languages and texts that are no scene).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/utf8.h"
#include "syntax/parser.h"

namespace tyndall::syntax {

// Longer names and units are refused: they are data, not words, and would flood the messages that quote them.
inline constexpr std::size_t max_word_bytes = 256;

// Far more than the parser reads (max_nesting), even where many were forgotten to be closed.
inline constexpr std::uint32_t most_open_brackets = 10'000;

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_word_begin(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
constexpr bool is_word_part(char c) { return is_word_begin(c) || is_digit(c); }

// The number in the base unit of what is named, deg or cm; `none`, and nothing done, when that is no unit.
Unit with_unit(std::string_view name, double& value);

class Lexer {
 public:
  Lexer(const Sources& sources, SourceId source, Diagnostics& diagnostics, std::size_t most)
      : source_(source), text_(sources[source].text()), diagnostics_(diagnostics), max_tokens_(most) {}

  TokenList run();

 private:
  // A mistake that whoever makes it makes all over the file: reported once, with the number of places.
  struct Habit {
    Span first;
    int count = 0;
  };

  // lexer.cpp
  bool too_much();
  void next_token();
  void word();
  bool skip_comment();
  void block_comment();
  void comment_text(std::uint32_t begin);
  void punctuation();
  // lex_number.cpp
  void number();
  // lex_string.cpp
  void string(std::uint32_t begin, TokenKind kind_if_whole, TokenKind kind_if_split);
  void escape(std::string& piece, std::uint32_t string_begin);
  void unicode_escape(std::string& piece, std::uint32_t begin);
  void open_interpolation();
  bool inside_interpolation(char c);
  void end_interpolations();
  // lex_mistakes.cpp
  bool not_text();
  bool mistaken_mark();
  bool absolute_bars();
  bool degree_sign(std::uint32_t begin);
  bool triple_quotes(std::uint32_t begin);
  void hash();
  void single_quotes();
  void mistaken_character();
  void foreign_character();
  void undecodable();
  void report_habits();

  // The character `ahead` bytes after the next one; NUL past the end.
  char peek(std::uint32_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool at_end() const { return at_ >= text_.size(); }
  Span span_from(std::uint32_t begin) const { return {source_, begin, at_}; }
  bool starts_with(std::string_view s) const { return text_.substr(at_).starts_with(s); }

  Token& emit(TokenKind kind, std::uint32_t begin) {
    Token& token = out_.tokens.emplace_back();
    token.kind = kind;
    token.span = span_from(begin);
    return token;
  }
  // Reports the text from `begin` to here; an `error` token keeps the parser silent about it.
  void fail(std::uint32_t begin, std::string message, std::string help = {}) {
    diagnostics_.error(span_from(begin), std::move(message), std::move(help));
    emit(TokenKind::error, begin);
  }
  void count_bracket(TokenKind kind) {
    if (kind == TokenKind::left_paren || kind == TokenKind::left_bracket || kind == TokenKind::left_brace)
      ++open_brackets_;
    else if (kind == TokenKind::right_paren || kind == TokenKind::right_bracket ||
             kind == TokenKind::right_brace)
      open_brackets_ -= open_brackets_ > 0;
  }
  void count(Habit& habit, std::uint32_t begin) {
    if (habit.count++ == 0) habit.first = span_from(begin);
  }

  SourceId source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::size_t max_tokens_;
  std::uint32_t open_brackets_ = 0;
  std::uint32_t at_ = 0;  // the offset of the next character
  TokenList out_;
  // Open interpolations, innermost last: the place of each `{` and the braces opened inside it.
  struct Interpolation {
    std::uint32_t begin = 0, open_braces = 0;
  };
  std::vector<Interpolation> interpolations_;
  std::uint32_t bad_escape_in_ = 0xffffffffu;  // begin of the last string with an unknown escape
  std::uint32_t closing_bar_ = 0xffffffffu;    // of `|x|`
  bool after_directive_ = false;  // of POV-Ray, told already: the `;` that ends it is not told, too
  Habit semicolons_, undecodable_, control_characters_, odd_spaces_;
};

}  // namespace tyndall::syntax
