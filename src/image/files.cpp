#include "image/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace tyndall::image {
namespace {

std::string failure(const std::string& path, int error_number) {
  return fmt::format("cannot write '{}': {}", path, std::generic_category().message(error_number));
}

// The name of the file beside: hidden, and one per process, so that two runs do not meet in it.
std::string path_beside(const std::string& path) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / fmt::format(".{}.{}.part", whole.filename().string(), ::getpid())).string();
}

std::string check_directory(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return fmt::format("cannot write '{}': it is a directory", path);
  const std::filesystem::path directory = std::filesystem::path(path).parent_path();
  if (directory.empty() || std::filesystem::is_directory(directory, ignored)) return {};
  return fmt::format("cannot write '{}': there is no directory '{}'", path, directory.string());
}

int open_new(const std::string& path) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

// Zero, or the error number of the first call that failed.
int write_and_close(int file, std::span<const std::byte> bytes) {
  int error_number = 0;
  while (!bytes.empty() && error_number == 0) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      error_number = errno;
    }
  }
  if (error_number == 0 && ::fsync(file) != 0 && errno != EINVAL && errno != EROFS) error_number = errno;
  if (::close(file) != 0 && error_number == 0) error_number = errno;
  return error_number;
}

}  // namespace

std::string write_file_whole(const std::string& path, std::span<const std::byte> bytes) {
  if (std::string problem = check_directory(path); !problem.empty()) return problem;
  const std::string beside = path_beside(path);
  const int file = open_new(beside);
  if (file < 0) return failure(path, errno);
  int error_number = write_and_close(file, bytes);
  if (error_number == 0 && ::rename(beside.c_str(), path.c_str()) != 0) error_number = errno;
  if (error_number == 0) return {};
  ::unlink(beside.c_str());
  return failure(path, error_number);
}

std::string check_file_creatable(const std::string& path) {
  if (std::string problem = check_directory(path); !problem.empty()) return problem;
  const std::string beside = path_beside(path);
  const int file = open_new(beside);
  if (file < 0) return failure(path, errno);
  ::close(file);
  ::unlink(beside.c_str());
  return {};
}

}  // namespace tyndall::image
