// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tyndall::image {

// Writes the bytes into a new file beside `path`, flushes it to the disk and renames it over `path`. On any
// failure nothing is left behind and what was at `path` stays. Returns an error message fit for the user, or
// an empty string.
std::string write_file_whole(const std::string& path, std::span<const std::byte> bytes);

// A message when no file can be made at `path` now, or an empty string. Leaves nothing behind.
std::string check_file_creatable(const std::string& path);

}  // namespace tyndall::image
