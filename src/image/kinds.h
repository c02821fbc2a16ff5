// What kind of picture some bytes begin as.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tyndall::image {

// OpenImageIO's name of the format, of those whose readers have been fed with broken files and stood them:
// "openexr", "png", "jpeg", "tiff", "hdr" or "webp". Empty: any other, or none.
std::string robust_format(std::span<const std::byte> begin);
std::string robust_format_of_file(const std::string& path);

}  // namespace tyndall::image
