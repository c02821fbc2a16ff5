// The stream that OpenVDB reads a file from: it ends with an exception where the file ends, and where what
// was made of it has taken more memory than it may.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <vector>

namespace tyndall::import {

// What is told to the user as it is.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline std::uint64_t memory_in_use() {
  std::ifstream pages("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  pages >> all >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] inline void refuse_memory(std::uint64_t most_bytes) {
  throw Refused(
      fmt::format("it needs more than the {} MB of memory that are left for grids", most_bytes >> 20));
}

// A file in pieces, each of which can become a few hundred times as much: memory is looked at before the
// next.
class WatchedFile final : public std::streambuf {
 public:
  WatchedFile(const std::string& path, std::uint64_t most_bytes)
      : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)),
        most_bytes_(most_bytes),
        before_(memory_in_use()),
        piece_(std::size_t{64} << 10) {
    if (file_ < 0) throw Refused("it cannot be opened");
  }
  ~WatchedFile() override { ::close(file_); }
  WatchedFile(const WatchedFile&) = delete;
  WatchedFile& operator=(const WatchedFile&) = delete;

 protected:
  int_type underflow() override {
    if (memory_in_use() > before_ + most_bytes_) refuse_memory(most_bytes_);
    const ::ssize_t got = ::pread(file_, piece_.data(), piece_.size(), next_);
    if (got < 0) throw Refused("the file system gives an error");
    if (got == 0) throw Refused("the file ends too early");
    next_ += got;
    setg(piece_.data(), piece_.data(), piece_.data() + got);
    return traits_type::to_int_type(piece_[0]);
  }
  pos_type seekoff(off_type offset, std::ios::seekdir from, std::ios::openmode) override {
    if (from == std::ios::end) return pos_type(off_type(-1));
    const off_type here = next_ - (egptr() - gptr());
    return seekpos(from == std::ios::cur ? here + offset : offset, std::ios::in);
  }
  pos_type seekpos(pos_type place, std::ios::openmode) override {
    const off_type begin = next_ - (egptr() - eback()), wanted = place;
    if (wanted < 0) return pos_type(off_type(-1));
    if (wanted >= begin && wanted < next_) {
      setg(eback(), eback() + (wanted - begin), egptr());
    } else {
      next_ = wanted;
      setg(nullptr, nullptr, nullptr);
    }
    return place;
  }

 private:
  int file_;
  std::uint64_t most_bytes_, before_;
  std::vector<char> piece_;
  off_type next_ = 0;  // where the piece ends
};

}  // namespace tyndall::import
