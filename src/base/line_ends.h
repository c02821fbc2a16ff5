// How the lines of a text end, and the mark that may stand before all.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tyndall {

inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";  // says UTF-8, which we know

// How many lines end with LF, with CR LF (Windows), and with CR alone (the Mac of old).
struct LineEnds {
  std::size_t lf = 0, crlf = 0, cr = 0;

  // The one that most lines have; LF where there are none.
  std::string_view usual() const;
  bool alike() const { return (lf > 0) + (crlf > 0) + (cr > 0) <= 1; }
};
LineEnds line_ends_of(std::string_view text);

// Whether the character at `i` is a CR that ends a line by itself.
inline bool is_lone_cr(std::string_view text, std::size_t i) {
  return text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n');
}

// The text, whose lines end with LF, with that in its place.
std::string with_line_ends(std::string_view text, std::string_view line_end);

}  // namespace tyndall
