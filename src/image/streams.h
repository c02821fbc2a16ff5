// Writing to what cannot be replaced: devices, pipes, the program's own standard streams. Waiting for pipes.
#pragma once

#include <sys/stat.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace tyndall::image {

// The descriptor of the program's standard output or error that is this very file.
std::optional<int> standard_stream(const struct stat& file);

// Waits for whoever uses the other end of a named pipe, two seconds in all.
class PipeWait {
 public:
  // Sleeps a little; false when it has been long enough.
  bool goes_on();

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_ = Clock::now() + std::chrono::seconds(2);
};

// Writes the bytes of all pieces and flushes them to the disk; zero, or the error number of the first call
// that failed.
int write_all(int file, std::span<const std::span<const std::byte>> pieces);

// Writes them to the device, pipe or standard stream at `path`, which is `file`; why not, or an empty
// string.
std::string write_through(const std::string& path, const struct stat& file,
                          std::span<const std::span<const std::byte>> pieces);

}  // namespace tyndall::image
