// Text to tokens: the loop, words, comments and punctuation. Grammar: grammar/tyndall.ebnf, "Words".
#include "syntax/lexer.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/flood.h"
#include "base/line_ends.h"

namespace tyndall::syntax {

namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// The mark of one character, if nothing that continues it follows; `error` for characters that are none.
constexpr TokenKind plain_mark(char c) {
  switch (c) {
    case '(':
      return TokenKind::left_paren;
    case ')':
      return TokenKind::right_paren;
    case '[':
      return TokenKind::left_bracket;
    case ']':
      return TokenKind::right_bracket;
    case '{':
      return TokenKind::left_brace;
    case '}':
      return TokenKind::right_brace;
    case ',':
      return TokenKind::comma;
    case ':':
      return TokenKind::colon;
    case '-':
      return TokenKind::minus;
    default:  // what occurs rarely, or in pairs
      return TokenKind::error;
  }
}
// Whether a character after one of those may belong to a longer mark, ours or another language's.
constexpr bool continues_mark(char c) { return c == '=' || c == '>' || c == '-'; }

}  // namespace

TokenList lex(const Sources& sources, SourceId source, Diagnostics& diagnostics, std::size_t most) {
  return Lexer(sources, source, diagnostics, most).run();
}

TokenList Lexer::run() {
  CHECK_LT(text_.size(), std::size_t{0xffffffff});
  // No more than are read, so that growing seldom copies them: what is not used takes no memory.
  out_.tokens.reserve(std::min(text_.size() / 2 + 16, max_tokens_ + 16));
  if (!not_text()) {
    if (starts_with(byte_order_mark)) at_ = byte_order_mark.size();
    while (!at_end() && !too_much()) next_token();
    end_interpolations();
    report_habits();
  }
  at_ = static_cast<std::uint32_t>(text_.size());
  emit(TokenKind::end_of_file, at_);
  return std::move(out_);
}

// Whether the text can be no scene, for all that may follow: then nothing more is read.
bool Lexer::too_much() {
  // The parser, which tells of nesting, reads no such depth.
  if (open_brackets_ + interpolations_.size() > most_open_brackets) return true;
  if (flooded(diagnostics_)) return true;
  const std::size_t words = out_.tokens.size() + out_.comments.size();
  const bool too_many_strings = out_.strings.size() > max_strings;
  if (words < max_tokens_ && !too_many_strings) return false;
  // Their tree would take several times the memory, for nothing.
  out_ = {};
  interpolations_.clear();
  fail(at_,
       too_many_strings ? fmt::format("more than {} strings", max_strings)
                        : fmt::format("more than {} words, marks and comments", max_tokens_),
       "split the file: each of those it includes may have as many");
  return true;
}

void Lexer::next_token() {
  const char c = peek();
  if (!interpolations_.empty() && inside_interpolation(c)) return;
  if (is_blank(c)) {
    do ++at_;
    while (is_blank(peek()));
  } else if (is_word_begin(c)) {
    word();
  } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
    number();
  } else if (c == '"') {
    string(at_, TokenKind::string, TokenKind::string_head);
  } else if (!skip_comment()) {
    punctuation();
  }
}

void Lexer::word() {
  const std::uint32_t begin = at_;
  while (is_word_part(peek())) ++at_;
  if (static_cast<unsigned char>(peek()) >= 0x80 && decode_utf8(text_, at_).valid) {
    at_ = begin;
    return foreign_character();
  }
  const std::string_view text = text_.substr(begin, at_ - begin);
  if (text.size() > max_word_bytes)
    return fail(begin, fmt::format("this name has {} characters", text.size()),
                fmt::format("a name may have {}", max_word_bytes));
  emit(word_kind(text), begin);
}

// Skips a comment if one begins here.
bool Lexer::skip_comment() {
  const std::uint32_t begin = at_;
  if (starts_with("//")) {
    while (!at_end() && peek() != '\n' && peek() != '\r') ++at_;
  } else if (starts_with("/*")) {
    block_comment();
  } else {
    return false;
  }
  out_.comments.push_back(span_from(begin));
  comment_text(begin);
  return true;
}

// A comment may hold any text, but text it must be.
void Lexer::comment_text(std::uint32_t begin) {
  const std::uint32_t end = at_;
  for (at_ = begin; at_ < end;) {
    const auto c = static_cast<unsigned char>(peek());
    const CodePoint point = c < 0x80 ? CodePoint{} : decode_utf8(text_, at_);
    if (c >= 0x80 && !point.valid) {
      undecodable();
    } else {
      const std::uint32_t place = at_;
      at_ += c < 0x80 ? 1 : point.bytes;
      if (c < 0x20 && c != '\t' && c != '\n' && c != '\r') count(control_characters_, place);
    }
  }
}

void Lexer::block_comment() {
  const std::uint32_t begin = at_;
  std::uint32_t depth = 0;
  while (!at_end()) {
    if (starts_with("/*")) {
      ++depth;
      at_ += 2;
    } else if (starts_with("*/")) {
      at_ += 2;
      if (--depth == 0) return;
    } else {
      ++at_;
    }
  }
  diagnostics_.error(
      {source_, begin, begin + 2}, "this comment is never closed",
      depth > 1 ? fmt::format("comments nest: {} '*/' are missing", depth) : "close it with '*/'");
}

void Lexer::punctuation() {
  if (const TokenKind kind = plain_mark(peek()); kind != TokenKind::error && !continues_mark(peek(1))) {
    const std::uint32_t mark = at_++;
    emit(kind, mark);
    count_bracket(kind);
    return;
  }
  struct Mark {
    std::string_view text;
    TokenKind kind;
  };
  // Longer marks before their beginnings.
  static constexpr Mark marks[] = {
      {"..<", TokenKind::dot_dot_less}, {"..", TokenKind::dot_dot},     {"<=", TokenKind::less_equal},
      {">=", TokenKind::greater_equal}, {"==", TokenKind::equal_equal}, {"!=", TokenKind::not_equal},
      {"(", TokenKind::left_paren},     {")", TokenKind::right_paren},  {"[", TokenKind::left_bracket},
      {"]", TokenKind::right_bracket},  {"{", TokenKind::left_brace},   {"}", TokenKind::right_brace},
      {",", TokenKind::comma},          {":", TokenKind::colon},        {".", TokenKind::dot},
      {"=", TokenKind::equals},         {"+", TokenKind::plus},         {"-", TokenKind::minus},
      {"*", TokenKind::star},           {"/", TokenKind::slash},        {"^", TokenKind::caret},
      {"<", TokenKind::less},           {">", TokenKind::greater},
  };
  if (mistaken_mark()) return;
  const std::uint32_t begin = at_;
  for (const Mark& mark : marks) {
    if (!starts_with(mark.text)) continue;
    at_ += static_cast<std::uint32_t>(mark.text.size());
    emit(mark.kind, begin);
    count_bracket(mark.kind);
    return;
  }
  mistaken_character();
}

}  // namespace tyndall::syntax
