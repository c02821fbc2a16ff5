// UTF-8: reading one code point at a time, and writing one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tyndall {

// One code point and the number of bytes it takes; `valid` is false for a byte that begins no well-formed
// sequence (overlong forms, surrogates and values past U+10FFFF included), and `bytes` is then 1.
struct CodePoint {
  char32_t value = 0;
  std::uint32_t bytes = 1;
  bool valid = false;
};

// The code point that begins at `offset`, which must lie inside `text`.
CodePoint decode_utf8(std::string_view text, std::size_t offset);

// Appends a code point, which must be a Unicode scalar value (see is_scalar_value).
void append_utf8(std::string& text, char32_t code_point);

// True for what UTF-8 can hold: up to U+10FFFF without the surrogates.
constexpr bool is_scalar_value(char32_t c) { return c < 0xd800 || (c > 0xdfff && c <= 0x10ffff); }

}  // namespace tyndall
