// EXR and PNG as bytes: what the module around OpenEXR and libpng does for image.cpp.
//
// Nearly every run writes one of the two and reads no picture at all. OpenImageIO (codec.h), which can do it
// too, takes a fifth of a second and 130 MB to load.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace tyndall::image {

// The module's functions. They give an error message, or an empty string.
struct Encoder {
  // Of floats, as they are, with these texts.
  std::string (*exr)(const Image& image, const Metadata& metadata, std::vector<unsigned char>& bytes);
  // Of one channel or three, from 0 to 1, in 8 bits of sRGB.
  std::string (*png)(const Image& image, const Metadata& metadata, std::vector<unsigned char>& bytes);
};

// The name under which the module exports its `const Encoder`.
inline constexpr const char* encoder_symbol = "tyndall_encoder";

}  // namespace tyndall::image
