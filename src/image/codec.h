// Picture files as bytes: what the module around OpenImageIO does for image.cpp.
//
// Debian's OpenImageIO brings some 250 shared libraries, a quarter of a second of every start. So it lives in
// a module of its own that is loaded when the first picture is written or read, and never for `check` or
// `--help`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"

namespace tyndall::image {

enum class Format : std::uint8_t { exr, png };

// The module's functions.
struct Codec {
  // The file's bytes; gives an error message, or an empty string. PNG samples are `display`, of the whole
  // picture, EXR those of the image.
  std::string (*encode)(const Image& image, const std::vector<std::uint8_t>& display,
                        const Metadata& metadata, Format format, std::vector<unsigned char>& bytes);
  // The picture of an existing file, its samples as stored (8 bits as 0 to 1).
  ReadResult (*decode)(const std::string& path);
  // Any picture that OpenImageIO knows, up to that many pixels, with colours as they are where there is
  // alpha. `encoded`: whether its numbers are sRGB's.
  ReadResult (*decode_any)(const std::string& path, std::size_t most_pixels, bool& encoded);
};

// The name under which the module exports its `const Codec`.
inline constexpr const char* codec_symbol = "tyndall_codec";

}  // namespace tyndall::image
