#include "tools/scene_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "image/streams.h"
#include "resolve/limits.h"

namespace tyndall::tools {
namespace {

// An open file that may be a pipe. Pipes are opened without waiting: whether anything writes to one shows
// when it is read.
class Input {
 public:
  explicit Input(const std::string& path) {
    struct stat status {};
    is_pipe_ = ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | (is_pipe_ ? O_NONBLOCK : 0));
    if (file_ < 0) fail(errno);
  }
  ~Input() {
    if (file_ >= 0) ::close(file_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  const std::string& problem() const { return problem_; }

  // The next bytes; none at the end, and after a problem.
  std::size_t read(char* to, std::size_t most) {
    for (image::PipeWait wait; problem_.empty();) {
      const ssize_t got = ::read(file_, to, most);
      if (got > 0) {
        has_writer_ = true;
        return static_cast<std::size_t>(got);
      }
      if (got == 0 && (!is_pipe_ || has_writer_)) return 0;
      if (got == 0) {
        if (!wait.goes_on()) problem_ = "nothing writes to this pipe";
      } else if (errno == EAGAIN) {
        has_writer_ = true;
        pollfd waited_for{file_, POLLIN, 0};
        ::poll(&waited_for, 1, -1);
      } else if (errno != EINTR) {
        fail(errno);
      }
    }
    return 0;
  }

 private:
  void fail(int error_number) { problem_ = std::generic_category().message(error_number); }

  int file_ = -1;
  bool is_pipe_ = false, has_writer_ = false;
  std::string problem_;
};

}  // namespace

std::string read_scene_text(const std::string& path, std::string& text) {
  const auto failure = [&path](std::string_view why) {
    return fmt::format("cannot read '{}': {}", path, why);
  };
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return failure("it is a directory");
  Input input(path);
  constexpr std::size_t chunk = 1 << 16;
  for (std::size_t got = 1; input.problem().empty() && got > 0;) {
    const std::size_t end = text.size();
    text.resize(end + chunk);
    got = input.read(text.data() + end, chunk);
    text.resize(end + got);
    if (text.size() > resolve::max_file_bytes)
      return failure(fmt::format("it is larger than {} MB", resolve::max_file_bytes >> 20));
  }
  return input.problem().empty() ? std::string() : failure(input.problem());
}

}  // namespace tyndall::tools
