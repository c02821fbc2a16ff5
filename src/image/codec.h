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

// The channels to be read of those that a picture has.
using ChooseChannels = std::vector<std::size_t> (*)(const std::vector<std::string>& channels,
                                                    const void* wish);

// The module's functions.
struct Codec {
  // The file's bytes; gives an error message, or an empty string. PNG samples are `display`, of the whole
  // picture, EXR those of the image.
  std::string (*encode)(const Image& image, const std::vector<std::uint8_t>& display,
                        const Metadata& metadata, Format format, std::vector<unsigned char>& bytes);
  // The picture of an existing file, its samples as stored (8 bits as 0 to 1).
  ReadResult (*decode)(const std::string& path);
  // As read_planes, its numbers as stored. `encoded`: whether those are sRGB's.
  PlanesResult (*decode_planes)(const std::string& path, ChooseChannels choose, const void* wish,
                                std::uint64_t most_bytes, bool& encoded);
};

// The name under which the module exports its `const Codec`.
inline constexpr const char* codec_symbol = "tyndall_codec";

}  // namespace tyndall::image
