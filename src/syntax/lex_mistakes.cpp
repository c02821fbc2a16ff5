// What is no scene text: spellings of other languages, typographic characters, bytes that are not UTF-8. Each
// gets an error that says what to write, and where the meaning is plain the token that was meant, so that
// reading goes on.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "syntax/lexer.h"

namespace tyndall::syntax {

// Files that are no text, and texts in another encoding, are told once and not read.
bool Lexer::not_text() {
  if (starts_with("\xff\xfe") || starts_with("\xfe\xff")) {
    diagnostics_.error({source_, 0, 2}, "this file is not UTF-8 text",
                       "it seems to be UTF-16: save it as UTF-8");
    return true;
  }
  constexpr std::size_t bytes_looked_at = 4096, few = 8;
  constexpr std::size_t share = 10;  // one byte in so many that belongs to no text makes a binary file
  const std::size_t size = std::min(text_.size(), bytes_looked_at);
  std::size_t odd = 0;
  for (std::size_t i = 0; i < size;) {
    const CodePoint c = decode_utf8(text_, i);
    const bool blank = c.value == '\t' || c.value == '\n' || c.value == '\r' || c.value == '\f';
    if (!c.valid || (c.value < 0x20 && !blank)) ++odd;
    i += c.bytes;
  }
  if (odd < few || odd * share < size) return false;
  diagnostics_.error({source_, 0, 1}, "this file is not text", "a scene is plain UTF-8 text");
  return true;
}

// Marks of other languages that begin with a mark of ours. True if one stood here.
bool Lexer::mistaken_mark() {
  struct Mistake {
    std::string_view text;
    TokenKind meant;
    std::string_view message, help;
  };
  static constexpr std::string_view assign = "there is no such assignment";
  static constexpr Mistake mistakes[] = {
      {"...", TokenKind::error, "a range is written with two dots",
       "write a..b (both ends) or a..<b (without b)"},
      {"..=", TokenKind::dot_dot, "'..=' is written '..'", "a..b includes both ends"},
      {"===", TokenKind::equal_equal, "'===' is written '=='", ""},
      {"!==", TokenKind::not_equal, "'!==' is written '!='", ""},
      {"=>", TokenKind::error, "'=>' means nothing here",
       "'greater or equal' is '>='; a parameter takes ':', a definition '='"},
      {"->", TokenKind::error, "'->' means nothing here", "a function is written: def f(x) = x * x"},
      {"<>", TokenKind::not_equal, "'not equal' is written '!='", ""},
      {":=", TokenKind::error, "':=' means nothing here", "a parameter takes ':', a definition '='"},
      {"**", TokenKind::caret, "a power is written with '^'", ""},
      {"+=", TokenKind::error, assign, "write a = a + b"},
      {"-=", TokenKind::error, assign, "write a = a - b"},
      {"*=", TokenKind::error, assign, "write a = a * b"},
      {"/=", TokenKind::error, assign, "write a = a / b"},
      {"%=", TokenKind::error, assign, "write a = mod(a, b)"},
      {"^=", TokenKind::error, assign, "write a = a ^ b"},
      {"++", TokenKind::error, "'++' means nothing here", "write a = a + 1"},
      {"<!--", TokenKind::error, "'<!--' means nothing here", "a comment begins with '//', or is /* … */"},
      {"<<", TokenKind::error, "'<<' means nothing here", "write a * 2^b"},
      {">>", TokenKind::error, "'>>' means nothing here", "write floor(a / 2^b)"},
      {"*/", TokenKind::error, "no comment is open here", "'/*' opens one"},
      {"&&", TokenKind::kw_and, "'&&' is written 'and'", ""},
      {"&", TokenKind::kw_and, "'&' is written 'and'", ""},
      {"||", TokenKind::kw_or, "'||' is written 'or'", ""},
      {"|", TokenKind::kw_or, "'|' is written 'or'", ""},
      {"?", TokenKind::error, "'?' means nothing here", "a choice is written: if a then b else c"},
      {"%", TokenKind::error, "'%' is joined to a number (50%)", "a remainder is mod(a, b)"},
  };
  const std::uint32_t begin = at_;
  if (peek() == '|' && absolute_bars()) return true;
  for (const Mistake& mistake : mistakes) {
    if (!starts_with(mistake.text)) continue;
    at_ += static_cast<std::uint32_t>(mistake.text.size());
    diagnostics_.error(span_from(begin), std::string(mistake.message), std::string(mistake.help));
    if (mistake.text == "<!--") {
      while (!at_end() && peek() != '\n') ++at_;
      return true;
    }
    emit(mistake.meant, begin);
    return true;
  }
  if (peek() == '!' && peek(1) != '=') {
    ++at_;
    diagnostics_.error(span_from(begin), "'!' is written 'not'");
    emit(TokenKind::kw_not, begin);
    return true;
  }
  return false;
}

// `|x|`: a bar where a value begins, up to the next one of its line. Read as parentheses. True if it, or its
// end, stood here.
bool Lexer::absolute_bars() {
  const std::uint32_t begin = at_;
  if (begin == closing_bar_) {
    ++at_;
    emit(TokenKind::right_paren, begin);
    return true;
  }
  const TokenKind last = out_.tokens.empty() ? TokenKind::comma : out_.tokens.back().kind;
  static constexpr TokenKind ends_of_values[] = {
      TokenKind::name,        TokenKind::number,  TokenKind::color,        TokenKind::string,
      TokenKind::string_tail, TokenKind::kw_true, TokenKind::kw_false,     TokenKind::right_paren,
      TokenKind::right_brace, TokenKind::error,   TokenKind::right_bracket};
  const std::size_t end = text_.find_first_of("|\n", begin + 1);
  if (std::find(std::begin(ends_of_values), std::end(ends_of_values), last) != std::end(ends_of_values) ||
      end == std::string_view::npos || end == begin + 1 || text_[end] != '|')
    return false;
  closing_bar_ = static_cast<std::uint32_t>(end);
  ++at_;
  diagnostics_.error({source_, begin, closing_bar_ + 1}, "'|' are no brackets",
                     fmt::format("write abs({})", text_.substr(begin + 1, end - begin - 1).substr(0, 80)));
  emit(TokenKind::left_paren, begin);
  return true;
}

// `30°` and `30 °`, read as degrees. False after what is no plain number.
bool Lexer::degree_sign(std::uint32_t begin) {
  if (out_.tokens.empty()) return false;
  Token& number = out_.tokens.back();
  if (number.kind != TokenKind::number || number.unit != Unit::none) return false;
  const std::string_view digits = text_.substr(number.span.begin, number.span.end - number.span.begin);
  number.unit = with_unit("deg", number.number);
  diagnostics_.error(span_from(begin), "'°' is not of this language", fmt::format("write {}deg", digits));
  return true;
}

// `#rgb`, `#rrggbb`, and the directives of other languages.
void Lexer::hash() {
  const std::uint32_t begin = at_++;
  while (is_word_part(peek())) ++at_;
  const std::string_view digits = text_.substr(begin + 1, at_ - begin - 1);
  const auto is_hex = [](char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); };
  if (std::all_of(digits.begin(), digits.end(), is_hex) && (digits.size() == 3 || digits.size() == 6)) {
    std::uint32_t rgb = 0;
    for (const char c : digits) {
      const auto digit = static_cast<std::uint32_t>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
      rgb = digits.size() == 3 ? rgb << 8 | digit * 0x11 : rgb << 4 | digit;
    }
    emit(TokenKind::color, begin).text = rgb;
    return;
  }
  struct Directive {
    std::string_view name;
    TokenKind meant;
    std::string_view help;
  };
  static constexpr Directive directives[] = {
      {"declare", TokenKind::kw_let, "write let name = value"},
      {"local", TokenKind::kw_let, "write let name = value"},
      {"define", TokenKind::error, "write let name = value or def name(x) = value"},
      {"macro", TokenKind::kw_def, "write def name(parameters) { … }"},
      {"include", TokenKind::kw_include, "write include \"file.tyn\""},
      {"version", TokenKind::error, "leave it out"},
      {"debug", TokenKind::error, "write print(\"x\", x)"},
      {"ifdef", TokenKind::error, "write if condition { … } else { … }"},
      {"ifndef", TokenKind::error, "write if condition { … } else { … }"},
      {"if", TokenKind::kw_if, "write if condition { … } else { … }"},
      {"for", TokenKind::kw_for, "write for i in 0..<10 { … }"},
      {"while", TokenKind::error, "write for i in 0..<10 { … }"},
      {"else", TokenKind::kw_else, "write if condition { … } else { … }"},
      {"end", TokenKind::error, "a block ends with '}'"},
  };
  for (const Directive& directive : directives) {
    if (directive.name != digits) continue;
    diagnostics_.error(span_from(begin), fmt::format("'#{}' is not of this language", digits),
                       std::string(directive.help));
    emit(directive.meant, begin);
    after_directive_ = directive.meant == TokenKind::kw_let || directive.meant == TokenKind::kw_include;
    return;
  }
  if (digits.empty()) {  // most likely a comment
    while (!at_end() && peek() != '\n') ++at_;
    diagnostics_.error({source_, begin, begin + 1}, "'#' begins a colour", "a comment begins with '//'");
    return;
  }
  fail(begin, "a colour has 3 or 6 hexadecimal digits after '#'",
       digits.size() == 8 || digits.size() == 4 ? "there is no alpha: use opacity" : "as in #f80 or #ff8800");
}

// 'text' in single quotes is read as a string if it ends on its line.
void Lexer::single_quotes() {
  const std::uint32_t begin = at_++;
  const std::size_t end = text_.find_first_of("'\n", at_);
  const bool closed = end != std::string_view::npos && text_[end] == '\'';
  if (!closed) return fail(begin, "a stray quote", "strings are written in \"double quotes\"");
  std::string piece(text_.substr(at_, end - at_));
  at_ = static_cast<std::uint32_t>(end + 1);
  diagnostics_.error(span_from(begin), "strings are written in double quotes");
  emit(TokenKind::string, begin).text = static_cast<std::uint32_t>(out_.strings.size());
  out_.strings.push_back(std::move(piece));
}

// One character that begins nothing in the language.
void Lexer::mistaken_character() {
  const std::uint32_t begin = at_;
  const char c = peek();
  if (c == '#') return hash();
  if (c == '\'') return single_quotes();
  if (static_cast<unsigned char>(c) >= 0x80) return foreign_character();
  ++at_;
  if (c == ';') {
    if (!std::exchange(after_directive_, false)) count(semicolons_, begin);
    return;
  }
  if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
    while (!at_end() && static_cast<unsigned char>(peek()) < 0x20 && peek() != '\n' && peek() != '\t') ++at_;
    count(control_characters_, begin);
    emit(TokenKind::error, begin);
    return;
  }
  const std::string_view help = c == '`'    ? "strings are written in \"double quotes\""
                                : c == '~'  ? "'not' turns true and false round; '!=' is 'not equal'"
                                : c == '\\' ? "leave it out: a line may be broken anywhere"
                                            : "leave it out: a name has letters, digits and _";
  if (c == '~' && peek() == '=') ++at_;
  fail(begin, fmt::format("'{}' means nothing here", text_.substr(begin, at_ - begin)), std::string(help));
}

namespace {

// Characters that stand for one of ours in typeset text.
struct Lookalike {
  char32_t character;
  TokenKind meant;
  std::string_view help;
};
constexpr Lookalike lookalikes[] = {
    {0x2212, TokenKind::minus, "write '-'"},
    {0x2013, TokenKind::minus, "write '-'"},
    {0x2014, TokenKind::minus, "write '-'"},
    {0x00d7, TokenKind::star, "write '*'"},
    {0x00b7, TokenKind::star, "write '*'"},
    {0x22c5, TokenKind::star, "write '*'"},
    {0x00f7, TokenKind::slash, "write '/'"},
    {0x2264, TokenKind::less_equal, "write '<='"},
    {0x2265, TokenKind::greater_equal, "write '>='"},
    {0x2260, TokenKind::not_equal, "write '!='"},
    {0x2026, TokenKind::error, "write what was left out, or '..' for a range"},
    {0x00b0, TokenKind::error, "write 30deg"},
    {0x00b2, TokenKind::error, "write x^2"},
    {0x00b3, TokenKind::error, "write x^3"},
    {0x03c0, TokenKind::error, "write pi"},
    {0x221a, TokenKind::error, "write sqrt(x)"},
    {0x00bd, TokenKind::error, "write 0.5"},
    {0x221e, TokenKind::error, "no number is infinite: write a large one, such as 1e9"},
    {0xff0c, TokenKind::comma, "write ','"},
    {0xff1a, TokenKind::colon, "write ':'"},
    {0xff08, TokenKind::left_paren, "write '('"},
    {0xff09, TokenKind::right_paren, "write ')'"},
};
const Lookalike* find_lookalike(char32_t c) {
  const auto* found = std::find_if(std::begin(lookalikes), std::end(lookalikes),
                                   [c](const Lookalike& row) { return row.character == c; });
  return found == std::end(lookalikes) ? nullptr : found;
}

bool is_curly_quote(char32_t c) { return c >= 0x2018 && c <= 0x201f; }
// Spaces of no or unusual width, and the byte order mark inside a text.
bool is_odd_space(char32_t c) {
  return c == 0xa0 || (c >= 0x2000 && c <= 0x200d) || c == 0x2028 || c == 0x2029 || c == 0x202f ||
         c == 0x3000 || c == 0xfeff;
}
bool can_be_in_word(char32_t c) {
  return c >= 0x80 && !is_odd_space(c) && !is_curly_quote(c) && find_lookalike(c) == nullptr;
}

}  // namespace

// Characters outside ASCII, outside strings and comments; also a word that has some.
void Lexer::foreign_character() {
  const std::uint32_t begin = at_;
  while (is_word_part(peek())) ++at_;
  const std::uint32_t word_end = at_;
  while (!at_end()) {
    const CodePoint c = decode_utf8(text_, at_);
    if (!c.valid || (c.value < 0x80 ? !is_word_part(peek()) : !can_be_in_word(c.value))) break;
    at_ += c.bytes;
  }
  if (at_ > word_end) {
    diagnostics_.error(span_from(begin), "a name has only the letters A to Z, a to z, digits and _");
    emit(at_ - begin > max_word_bytes ? TokenKind::error : TokenKind::name, begin);
    return;
  }
  if (word_end > begin) {  // a plain word that such a character follows
    emit(word_end - begin > max_word_bytes ? TokenKind::error
                                           : word_kind(text_.substr(begin, word_end - begin)),
         begin);
    return;
  }
  const CodePoint c = decode_utf8(text_, at_);
  if (!c.valid) {
    undecodable();
    emit(TokenKind::error, begin);
    return;
  }
  at_ += c.bytes;
  if (is_odd_space(c.value)) return count(odd_spaces_, begin);
  if (c.value == 0xb0 && degree_sign(begin)) return;
  if (const Lookalike* row = find_lookalike(c.value)) {
    diagnostics_.error(span_from(begin),
                       fmt::format("'{}' is not of this language", text_.substr(begin, c.bytes)),
                       std::string(row->help));
    emit(row->meant, begin);
    return;
  }
  // A curly quote: a string up to the next one, if that is on the same line.
  const std::uint32_t text_begin = at_;
  while (!at_end() && peek() != '\n' && peek() != '"') {
    const CodePoint inner = decode_utf8(text_, at_);
    at_ += inner.bytes;
    if (!inner.valid || !is_curly_quote(inner.value)) continue;
    diagnostics_.error(span_from(begin), "curly quotes are not of this language",
                       "strings are written in straight quotes: \"…\"");
    emit(TokenKind::string, begin).text = static_cast<std::uint32_t>(out_.strings.size());
    out_.strings.emplace_back(text_.substr(text_begin, at_ - inner.bytes - text_begin));
    return;
  }
  at_ = text_begin;
  fail(begin, "curly quotes are not of this language", "strings are written in straight quotes: \"…\"");
}

// A run of bytes that are not UTF-8.
void Lexer::undecodable() {
  const std::uint32_t begin = at_;
  while (!at_end() && !decode_utf8(text_, at_).valid) ++at_;
  count(undecodable_, begin);
}

// Says once what occurs all over the file.
void Lexer::report_habits() {
  const auto report = [&](const Habit& habit, std::string_view message, std::string_view help) {
    if (habit.count == 0) return;
    const std::string places = habit.count > 1 ? fmt::format(" ({} places in this file)", habit.count) : "";
    diagnostics_.error(habit.first, std::string(message) + places, std::string(help));
  };
  report(undecodable_, "these bytes are not UTF-8 text", "save the file as UTF-8");
  report(control_characters_, "a control character or NUL byte", "remove it: scenes are plain text");
  report(odd_spaces_, "an invisible character that is no plain space", "replace it by a space");
  report(semicolons_, "';' ends nothing here", "leave it out: statements need no mark at their end");
}

}  // namespace tyndall::syntax
