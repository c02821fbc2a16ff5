// Picture files that end too early, where the libraries that read them would show grey or black instead, or
// lose memory (OpenImageIO's PNG reader leaves by a jump that passes destructors over).
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tyndall::image {

// Whether the file is a JPEG or a PNG without its end, an EXR without the end of its header, or an IFF that
// is shorter than it says. Others, and what cannot be read, are left to their libraries.
bool is_cut_short(const std::string& path);
bool is_cut_short(std::span<const std::byte> bytes);

}  // namespace tyndall::image
