#include "base/source.h"

#include <algorithm>

#include "base/check.h"
#include "base/line_ends.h"

namespace tyndall {

Span join(const Span& a, const Span& b) {
  if (!a.valid()) return b;
  if (!b.valid()) return a;
  CHECK_EQ(a.source.index, b.source.index);
  return {a.source, std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

// A CR that ends a line by itself becomes LF: nobody else needs to know those. Lines begin after a byte order
// mark.
Source::Source(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
  line_begins_.push_back(
      text_.starts_with(byte_order_mark) ? static_cast<std::uint32_t>(byte_order_mark.size()) : 0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (is_lone_cr(text_, i)) text_[i] = '\n';
    if (text_[i] == '\n') line_begins_.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

LineColumn Source::locate(std::uint32_t offset) const {
  offset = std::clamp(offset, line_begins_.front(), static_cast<std::uint32_t>(text_.size()));
  const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
  const auto line = static_cast<std::uint32_t>(after - line_begins_.begin());
  std::uint32_t column = 1;
  for (std::uint32_t i = line_begins_[line - 1]; i < offset; ++i)
    if ((static_cast<unsigned char>(text_[i]) & 0xc0) != 0x80) ++column;  // count UTF-8 lead bytes
  return {line, column};
}

std::string_view Source::line(std::uint32_t number) const {
  if (number < 1 || number > line_begins_.size()) return {};
  const std::uint32_t begin = line_begins_[number - 1];
  std::size_t end = number < line_begins_.size() ? line_begins_[number] - 1 : text_.size();
  if (end > begin && text_[end - 1] == '\r') --end;
  return text().substr(begin, end - begin);
}

SourceId Sources::add(std::string name, std::string text) {
  sources_.push_back(std::make_unique<Source>(std::move(name), std::move(text)));
  return SourceId(sources_.size() - 1);
}

std::string_view Sources::text(const Span& span) const {
  if (!span.valid()) return {};
  return (*this)[span.source].text().substr(span.begin, span.end - span.begin);
}

}  // namespace tyndall
