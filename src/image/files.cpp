#include "image/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <random>
#include <system_error>
#include <utility>

#include "image/streams.h"

namespace tyndall::image {
namespace {

namespace fs = std::filesystem;

std::string failure(const std::string& path, std::string_view why) {
  return fmt::format("cannot write '{}': {}", path, why);
}
std::string failure(const std::string& path, int error_number) {
  return failure(path, std::generic_category().message(error_number));
}

// What a path leads to.
struct Target {
  std::string path;               // without links, when it is a plain file or not there
  std::optional<struct stat> is;  // nothing: not there yet
  bool circular = false;          // its links lead nowhere
};

// A link that leads nowhere yet is followed by hand: what it names is to be made.
Target target_of(const std::string& path) {
  constexpr int most_links = 40;  // as many as the system follows
  Target target{path, std::nullopt};
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    target.is = status;
    std::error_code error;
    const fs::path canonical = fs::canonical(path, error);
    if (S_ISREG(status.st_mode) && !error) target.path = canonical.string();
    return target;
  }
  target.circular = errno == ELOOP;
  for (int link = 0; link < most_links; ++link) {
    std::error_code error;
    const fs::path next = fs::read_symlink(target.path, error);
    if (error) break;
    target.path = (fs::path(target.path).parent_path() / next).string();
  }
  return target;
}

bool is_plain(const Target& target) {
  return !target.is || (S_ISREG(target.is->st_mode) && !standard_stream(*target.is));
}

fs::path directory_of(const std::string& path) {
  const fs::path directory = fs::path(path).parent_path();
  return directory.empty() ? fs::path(".") : directory;
}

// What can be said against a target without trying.
std::string complaint(const std::string& path, const Target& target) {
  if (target.circular) return failure(path, "its symbolic links lead in a circle");
  std::error_code ignored;
  if (!target.is) {
    const fs::path directory = directory_of(target.path);
    return fs::is_directory(directory, ignored)
               ? std::string()
               : failure(path, fmt::format("there is no directory '{}'", directory.string()));
  }
  const mode_t mode = target.is->st_mode;
  if (S_ISDIR(mode)) return failure(path, "it is a directory");
  if (S_ISBLK(mode)) return failure(path, "it is a disk");
  if (standard_stream(*target.is)) return {};
  // Root may write anything; that a file was made read-only is meant all the same.
  if ((mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0 ||
      ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0)
    return failure(path, "it is read-only");
  return {};
}

// The name of the file that is being written, for the handler of signals.
std::array<char, PATH_MAX> unfinished_name;
std::atomic<bool> unfinished{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
std::mutex one_writer;

// How the names of files beside a target begin, up to the number of the process: hidden, and no longer than
// names may be. A random number follows, for containers may have the same name and the same processes: no two
// runs meet in a file.
std::string name_beside(const std::string& target) {
  constexpr std::size_t longest_name = 160, longest_host = 64;
  std::array<char, longest_host + 1> host{};
  ::gethostname(host.data(), longest_host);
  return fmt::format(".{}.{}.", fs::path(target).filename().string().substr(0, longest_name), host.data());
}

// A new file beside a target, removed unless it takes the target's place.
class FileBeside {
 public:
  explicit FileBeside(const Target& target) : lock_(one_writer), target_(target.path) {
    const std::string name =
        fmt::format("{}{}.{:08x}.part", name_beside(target_), ::getpid(), std::random_device()());
    path_ = (fs::path(target_).parent_path() / name).string();
    if (path_.size() >= unfinished_name.size()) {
      error_number_ = ENAMETOOLONG;
      return;
    }
    std::memcpy(unfinished_name.data(), path_.c_str(), path_.size() + 1);
    unfinished = true;
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0) error_number_ = errno;
    if (file_ >= 0 && target.is) keep_owner_and_permissions(*target.is);
  }
  ~FileBeside() {
    if (file_ >= 0) ::close(file_);
    remove_unfinished_file();
  }
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;

  // Zero, or the error number of the first call that failed.
  int error_number() const { return error_number_; }
  void write(std::span<const std::span<const std::byte>> pieces) {
    if (error_number_ == 0) error_number_ = write_all(file_, pieces);
  }
  // The bytes are on the disk before the name leads to them: a power cut leaves the file that was there, or
  // this one. Where the disk is that of another computer, it is now that it says that it is full.
  void take_place() {
    if (error_number_ == 0 && ::fsync(file_) != 0 && errno != EINVAL) error_number_ = errno;
    if (error_number_ == 0 && ::close(std::exchange(file_, -1)) != 0) error_number_ = errno;
    if (error_number_ == 0 && ::rename(path_.c_str(), target_.c_str()) != 0) error_number_ = errno;
    if (error_number_ == 0) unfinished = false;
  }

 private:
  void keep_owner_and_permissions(const struct stat& was) {
    // Another owner than ours can only be kept by root: that it is not is no failure.
    if (::fchown(file_, was.st_uid, was.st_gid) != 0) errno = 0;
    if (::fchmod(file_, was.st_mode & 07777) != 0) error_number_ = errno;
  }

  std::lock_guard<std::mutex> lock_;
  std::string target_, path_;
  int file_ = -1, error_number_ = 0;
};

}  // namespace

std::string write_file_whole(const std::string& path, std::span<const std::byte> bytes) {
  return write_file_whole(path, std::span(&bytes, 1));
}

std::string write_file_whole(const std::string& path, std::span<const std::span<const std::byte>> pieces) {
  const Target target = target_of(path);
  if (std::string problem = complaint(path, target); !problem.empty()) return problem;
  if (!is_plain(target)) {
    const std::string problem = write_through(path, *target.is, pieces);
    return problem.empty() ? problem : failure(path, problem);
  }
  FileBeside beside(target);
  beside.write(pieces);
  beside.take_place();
  return beside.error_number() == 0 ? std::string() : failure(path, beside.error_number());
}

std::string check_file_writable(const std::string& path) {
  const Target target = target_of(path);
  if (std::string problem = complaint(path, target); !problem.empty()) return problem;
  if (!is_plain(target)) return {};
  const FileBeside beside(target);
  return beside.error_number() == 0 ? std::string() : failure(path, beside.error_number());
}

bool tells_of_full_disk(const std::string& message) {
  const auto says = [&](int error) { return message.ends_with(std::generic_category().message(error)); };
  return says(ENOSPC) || says(EDQUOT);
}

void remove_leftovers(const std::string& path) {
  const std::string target = target_of(path).path, begin = name_beside(target);
  constexpr std::string_view end = ".part";
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(directory_of(target), failed)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(end) || name.size() <= begin.size() + end.size())
      continue;
    const std::string digits = name.substr(begin.size(), name.size() - begin.size() - end.size());
    pid_t process = 0;
    const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), process);
    if (error != std::errc() || *last != '.' || process <= 0) continue;
    if (::kill(process, 0) != 0 && errno == ESRCH) ::unlink(entry.path().c_str());
  }
}

bool appears_whole(const std::string& path) { return is_plain(target_of(path)); }

std::string file_identity(const std::string& path) {
  const Target target = target_of(path);
  if (target.is) {
    if (S_ISCHR(target.is->st_mode) || standard_stream(*target.is)) return {};
    return fmt::format("{}:{}", target.is->st_dev, target.is->st_ino);
  }
  struct stat directory {};
  if (::stat(directory_of(target.path).c_str(), &directory) != 0) return {};
  return fmt::format("{}:{}/{}", directory.st_dev, directory.st_ino,
                     fs::path(target.path).filename().string());
}

void remove_unfinished_file() noexcept {
  if (unfinished.exchange(false)) ::unlink(unfinished_name.data());
}

}  // namespace tyndall::image
