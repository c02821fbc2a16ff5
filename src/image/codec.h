// Picture files as bytes: what the module around OpenImageIO does for image.cpp.
//
// Debian's OpenImageIO brings some 250 shared libraries, a quarter of a second of every start. So it lives in
// a module of its own that is loaded when the first picture is read or a JPEG or TIFF is written (encoder.h
// has what writes the others), and never for `check` or `--help`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/rows.h"

namespace tyndall::image {

enum class Format : std::uint8_t { exr, png, jpeg, tiff };

// OpenImageIO's name of it.
inline const char* name_of(Format format) {
  switch (format) {
    case Format::exr:
      return "openexr";
    case Format::png:
      return "png";
    case Format::jpeg:
      return "jpeg";
    case Format::tiff:
      return "tiff";
  }
  return "";
}

// The channels to be read of those that a picture has.
using ChooseChannels = std::vector<std::size_t> (*)(const std::vector<std::string>& channels,
                                                    const void* wish);

// A picture in a file, or in memory, of a format (kinds.h). None: of any that OpenImageIO knows; it is then
// decoded by one thread, in a process that has no others.
struct Picture {
  std::string path, format;
  std::span<const std::byte> bytes{};
};

// The module's functions.
struct Codec {
  // The bytes of a JPEG or TIFF, of numbers from 0 to 1. Gives an error message, or an empty string.
  std::string (*encode)(const Image& image, const Metadata& metadata, Format format,
                        std::vector<unsigned char>& bytes);
  // The bytes of an EXR with these texts in place of its own.
  std::string (*retell)(const Picture& picture, const Metadata& metadata, std::vector<unsigned char>& bytes);
  // The picture of an existing file, its samples as stored (8 bits as 0 to 1).
  ReadResult (*decode)(const Picture& picture);
  // Its texts alone.
  ReadResult (*decode_texts)(const Picture& picture);
  // The chosen channels' rows, their numbers as stored; why not, or an empty text.
  std::string (*decode_rows)(const Picture& picture, ChooseChannels choose, const void* wish,
                             RowTaker& taker);
  // Fills `to`, of the same channels, with what the other one shows, filtered.
  std::string (*resize)(const Image& from, Image& to);
  // Writes a line of text, light, in the middle of a part of an image of R, G and B, as large as fits.
  std::string (*draw_text)(Image& image, const std::string& text, const Image::Place& part);
};

// The name under which the module exports its `const Codec`.
inline constexpr const char* codec_symbol = "tyndall_codec";

}  // namespace tyndall::image
