#include "image/streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <system_error>
#include <thread>

namespace tyndall::image {
namespace {

// While it lives a reader that goes away is an error of write, not a signal that ends the program.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec now{};
    if (sigismember(&before_, SIGPIPE) == 0) sigtimedwait(&pipe_, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};

int open_pipe(const std::string& path) {
  for (PipeWait wait;;) {
    const int file = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (file >= 0) {
      ::fcntl(file, F_SETFL, 0);  // from here on a full pipe is waited for
      return file;
    }
    if (errno != ENXIO || !wait.goes_on()) return -1;
  }
}

int open_through(const std::string& path, const struct stat& file) {
  if (const std::optional<int> stream = standard_stream(file)) return ::fcntl(*stream, F_DUPFD_CLOEXEC, 0);
  if (S_ISFIFO(file.st_mode)) return open_pipe(path);
  return ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
}

}  // namespace

std::optional<int> standard_stream(const struct stat& file) {
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat of_stream {};
    if (::fstat(stream, &of_stream) == 0 && of_stream.st_dev == file.st_dev &&
        of_stream.st_ino == file.st_ino)
      return stream;
  }
  return std::nullopt;
}

bool PipeWait::goes_on() {
  if (Clock::now() > end_) return false;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return true;
}

int write_all(int file, std::span<const std::span<const std::byte>> pieces) {
  for (std::span<const std::byte> bytes : pieces)
    while (!bytes.empty()) {
      const ssize_t written = ::write(file, bytes.data(), bytes.size());
      if (written >= 0)
        bytes = bytes.subspan(static_cast<std::size_t>(written));
      else if (errno != EINTR)
        return errno;
    }
  return ::fsync(file) != 0 && errno != EINVAL && errno != EROFS ? errno : 0;
}

std::string write_through(const std::string& path, const struct stat& file,
                          std::span<const std::span<const std::byte>> pieces) {
  const NoPipeSignal no_signal;
  const int descriptor = open_through(path, file);
  if (descriptor < 0)
    return errno == ENXIO && S_ISFIFO(file.st_mode) ? "nothing reads this pipe"
                                                    : std::generic_category().message(errno);
  int error_number = write_all(descriptor, pieces);
  if (::close(descriptor) != 0 && error_number == 0) error_number = errno;
  return error_number == 0 ? std::string() : std::generic_category().message(error_number);
}

}  // namespace tyndall::image
