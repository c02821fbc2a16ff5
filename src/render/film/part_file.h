// Parts of a picture as files (.tynpart): a film's sums, exactly, with what is told of it.
//
// The format, numbers little-endian: "TYNPART\n", the version of the format (u32), 0 (u32), and these
// sections, each with its name (four letters), 0 (u32), the number of its bytes (u64), the bytes, and the
// ContentHash of all that (u64):
//   TEXT  what the writer tells of the part: JSON, for others to read
//   FILM  width, height, groups, AOVs, and the window x0, y0, x1, y1 (i32 each)
//   SUMS  of each pixel and group: red, green, blue (i128, in 2^-64ths), samples (u32), 12 bytes of 0
//   AOVS  planes of sums (i128)
//   REST  what a render needs to go on; may be empty
// Nothing follows. A reader refuses whatever differs.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>

#include "render/film/film.h"

namespace tyndall::render {

struct Part {
  std::string text;
  Film film;
  std::string rest;
};

// Writes it whole or not at all (image::write_file_whole). A message, or an empty string.
std::string write_part(const std::string& path, const std::string& text, const Film& film,
                       const std::string& rest);

struct PartResult {
  std::optional<Part> part{};
  std::string error{};  // fit for the user; empty when there is a part
};
PartResult read_part(const std::string& path);
// The same of `size` bytes; an error is the rest of "cannot read 'a.tynpart': ".
PartResult read_part(std::istream& in, std::uint64_t size);

struct PartText {
  std::string text{}, error{};
};
// Reads the text alone: of a damaged film nothing is told.
PartText read_part_text(const std::string& path);

}  // namespace tyndall::render
