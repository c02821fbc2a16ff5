// Source texts and places in them. Every token, tree node and message carries a Span from birth.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/id.h"

namespace tyndall {

class Source;
using SourceId = Id<Source>;

// Bytes [begin, end) of one source. A default-made span is "nowhere".
struct Span {
  SourceId source;
  std::uint32_t begin = 0, end = 0;

  bool operator==(const Span&) const = default;
  bool valid() const { return source.valid(); }
};

// The smallest span that holds both (which must be of one source; a "nowhere" gives way to the other).
Span join(const Span& a, const Span& b);

// Line and column, both counted from 1; a column is a Unicode code point.
struct LineColumn {
  std::uint32_t line = 1, column = 1;
};

// One text and the name it was read under ("scene.tyn", "<command line>").
class Source {
 public:
  Source(std::string name, std::string text);

  const std::string& name() const { return name_; }
  std::string_view text() const { return text_; }
  LineColumn locate(std::uint32_t offset) const;
  // The text of a line (counted from 1) without its line break.
  std::string_view line(std::uint32_t number) const;

 private:
  std::string name_, text_;
  std::vector<std::uint32_t> line_begins_;
};

// All sources of one run; ids index it.
class Sources {
 public:
  SourceId add(std::string name, std::string text);
  const Source& operator[](SourceId id) const { return *sources_[id.index]; }
  std::size_t size() const { return sources_.size(); }
  std::string_view text(const Span& span) const;

 private:
  std::vector<std::unique_ptr<Source>>
      sources_;  // stable addresses: views into texts outlive later additions
};

}  // namespace tyndall
