// Strings: escapes and {interpolations}. A string is cut at its interpolations; the tokens between are lexed
// by the common loop, so their places in the file are right without further work.
#include <fmt/format.h>

#include "syntax/lexer.h"

namespace tyndall::syntax {

// Reads from the `"` (or the `}` that ends an interpolation) at `at_` to the closing `"` or the next `{`.
void Lexer::string(std::uint32_t begin, TokenKind kind_if_whole, TokenKind kind_if_split) {
  ++at_;
  std::string piece;
  TokenKind kind = kind_if_whole;
  for (;;) {
    if ((at_end() || peek() == '\n') && kind_if_whole == TokenKind::string &&
        !interpolations_.empty()) {  // told of the '{' that is open
      emit(TokenKind::error, begin);
      return;
    }
    if (at_end() || peek() == '\n') {
      diagnostics_.error(span_from(begin), "this string is never closed",
                         "close it with '\"' on the same line");
      break;
    }
    const char c = peek();
    if (c == '"') {
      ++at_;
      if (at_ == begin + 2 && peek() == '"' && triple_quotes(begin)) return;
      break;
    }
    if (c == '{') {
      kind = kind_if_split;
      break;
    }
    if (c == '\\') {
      escape(piece, begin);
    } else if (static_cast<unsigned char>(c) < 0x80) {
      if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r') count(control_characters_, at_);
      piece += c;
      ++at_;
    } else if (const CodePoint point = decode_utf8(text_, at_); point.valid) {
      piece += text_.substr(at_, point.bytes);
      at_ += point.bytes;
    } else {
      undecodable();
    }
  }
  emit(kind, begin).text = static_cast<std::uint32_t>(out_.strings.size());
  out_.strings.push_back(std::move(piece));
  if (kind == kind_if_split) open_interpolation();
}

// A text in three quotes, over several lines perhaps. False where it never ends.
bool Lexer::triple_quotes(std::uint32_t begin) {
  const std::size_t end = text_.find("\"\"\"", begin + 3);
  if (text_[begin] != '"' || end == std::string_view::npos) return false;
  at_ = begin + 3;
  diagnostics_.error(span_from(begin), "a string has one quote on each side",
                     "write \"…\" on one line; \\n in it begins a new one");
  at_ = static_cast<std::uint32_t>(end + 3);
  emit(TokenKind::string, begin).text = static_cast<std::uint32_t>(out_.strings.size());
  out_.strings.emplace_back(text_.substr(begin + 3, end - begin - 3));
  return true;
}

void Lexer::open_interpolation() {
  interpolations_.push_back({at_, 0});
  ++at_;
}

// Inside an interpolation braces are counted: the one that matches its `{` goes on with the string. A line
// break ends all open strings. True if the character was used up.
bool Lexer::inside_interpolation(char c) {
  Interpolation& inner = interpolations_.back();
  if (c == '{') ++inner.open_braces;
  if (c == '\n') {
    end_interpolations();
    return false;
  }
  if (c != '}') return false;
  if (inner.open_braces > 0) {
    --inner.open_braces;
    return false;
  }
  interpolations_.pop_back();
  string(at_, TokenKind::string_tail, TokenKind::string_middle);
  return true;
}

// Reports interpolations that are still open, and gives their strings an empty rest.
void Lexer::end_interpolations() {
  if (interpolations_.empty()) return;
  const std::uint32_t begin = interpolations_.front().begin;
  diagnostics_.error({source_, begin, begin + 1}, "this '{' of a string is never closed",
                     "close it with '}' on the same line; a brace as such is written '\\{'");
  for (; !interpolations_.empty(); interpolations_.pop_back()) {
    emit(TokenKind::error, at_);
    emit(TokenKind::string_tail, at_).text = static_cast<std::uint32_t>(out_.strings.size());
    out_.strings.emplace_back();
  }
}

void Lexer::escape(std::string& piece, std::uint32_t string_begin) {
  const std::uint32_t begin = at_;
  ++at_;
  if (at_end() || peek() == '\n') return;  // an unclosed string, reported as that
  const char c = peek();
  ++at_;
  switch (c) {
    case 'n':
      piece += '\n';
      return;
    case 't':
      piece += '\t';
      return;
    case '"':
    case '\\':
    case '{':
    case '}':
      piece += c;
      return;
    case 'u':
      return unicode_escape(piece, begin);
  }
  // A Windows path is told once for the string, not at each of its backslashes.
  while (static_cast<unsigned char>(c) >= 0x80 && (static_cast<unsigned char>(peek()) & 0xc0) == 0x80) ++at_;
  const std::string_view before = text_.substr(string_begin, begin - string_begin);
  piece += text_.substr(begin, at_ - begin);
  if (bad_escape_in_ == string_begin) return;
  bad_escape_in_ = string_begin;
  diagnostics_.error(span_from(begin), "unknown escape",
                     before.find(':') != std::string_view::npos || is_word_begin(c)
                         ? "a backslash is written '\\\\'; folders are parted by '/'"
                         : "the escapes are \\n \\t \\\" \\\\ \\{ \\} and \\u{…}");
}

// Reads `{1f32b}` after `\u`.
void Lexer::unicode_escape(std::string& piece, std::uint32_t begin) {
  char32_t value = 0;
  std::uint32_t digits = 0;
  if (peek() == '{') {
    ++at_;
    for (; std::string_view("0123456789abcdefABCDEF").find(peek()) != std::string_view::npos && !at_end();
         ++at_, ++digits) {
      const char c = peek();
      const int digit = is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10;
      if (digits < 7) value = value << 4 | static_cast<char32_t>(digit);
    }
    if (digits > 0 && digits <= 6 && peek() == '}' && is_scalar_value(value)) {
      ++at_;
      append_utf8(piece, value);
      return;
    }
    if (peek() == '}') ++at_;
  }
  diagnostics_.error(span_from(begin), "this escape names no character",
                     "write one to six hexadecimal digits, as in \\u{e9} or \\u{1f32b}");
}

}  // namespace tyndall::syntax
