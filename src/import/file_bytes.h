// A file's bytes, whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace tyndall {

// Throws Malformed with what is wrong of the file itself ("is a directory").
std::vector<std::byte> read_file_bytes(const std::filesystem::path& path);

}  // namespace tyndall
