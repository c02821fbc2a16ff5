// Writing to what cannot be replaced: devices, pipes, the program's own standard streams.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace tyndall::image {

// The descriptor of the program's standard output or error that is this very file.
std::optional<int> standard_stream(const struct stat& file);

// Writes all bytes and flushes them to the disk; zero, or the error number of the first call that failed.
int write_all(int file, std::span<const std::byte> bytes);

// Writes all bytes to the device, pipe or standard stream at `path`, which is `file`; why not, or an empty
// string.
std::string write_through(const std::string& path, const struct stat& file, std::span<const std::byte> bytes);

}  // namespace tyndall::image
