// Bytes as a file that has a path, for what is read from paths alone: in memory, gone when it goes.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace tyndall::fuzz {

class File {
 public:
  File(const std::uint8_t* data, std::size_t size) : file_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    whole_ = file_ >= 0 && ::write(file_, data, size) == static_cast<::ssize_t>(size);
  }
  ~File() {
    if (file_ >= 0) ::close(file_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool whole() const { return whole_; }
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
  bool whole_ = false;
};

}  // namespace tyndall::fuzz
