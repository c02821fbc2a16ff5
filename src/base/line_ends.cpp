#include "base/line_ends.h"

#include <algorithm>

namespace tyndall {

LineEnds line_ends_of(std::string_view text) {
  LineEnds ends;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_lone_cr(text, i))
      ++ends.cr;
    else if (text[i] == '\n')
      ++(i > 0 && text[i - 1] == '\r' ? ends.crlf : ends.lf);
  }
  return ends;
}

std::string_view LineEnds::usual() const {
  if (lf >= crlf && lf >= cr) return "\n";
  return crlf >= cr ? "\r\n" : "\r";
}

std::string with_line_ends(std::string_view text, std::string_view line_end) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '\n')
      out += line_end;
    else
      out += c;
  }
  return out;
}

}  // namespace tyndall
