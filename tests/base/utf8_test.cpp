// UTF-8: every code point there and back, and nothing else is taken for one.
#include "base/utf8.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace UNNAMED {

TEST(Utf8, EveryScalarValueComesBack) {
  for (char32_t c = 0; c <= 0x10ffff; ++c) {
    if (!is_scalar_value(c)) continue;
    std::string text;
    append_utf8(text, c);
    const CodePoint back = decode_utf8(text, 0);
    ASSERT_TRUE(back.valid && back.value == c && back.bytes == text.size()) << static_cast<unsigned>(c);
  }
}

TEST(Utf8, MalformedSequencesAreOneInvalidByte) {
  const std::string_view malformed[] = {
      "\x80",              // a tail byte alone
      "\xc3",              // cut short
      "\xe2\x82",          //
      "\xf0\x9f\x8c",      //
      "\xc0\xaf",          // overlong '/'
      "\xe0\x80\xaf",      //
      "\xed\xa0\x80",      // a surrogate
      "\xf4\x90\x80\x80",  // past U+10FFFF
      "\xff",              //
      "\xc3(",             // no tail byte
  };
  for (const std::string_view text : malformed) {
    const CodePoint c = decode_utf8(text, 0);
    EXPECT_FALSE(c.valid);
    EXPECT_EQ(c.bytes, 1u);
  }
}

}  // namespace
}  // namespace tyndall
