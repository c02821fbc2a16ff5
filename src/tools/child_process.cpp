#include "tools/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

namespace tyndall::tools {
namespace {

std::string message_of(int error) { return std::generic_category().message(error); }

// Standard input from one file, output to nowhere, errors to another.
class Redirections {
 public:
  Redirections(int input, int errors) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
  }
  ~Redirections() { ::posix_spawn_file_actions_destroy(&actions_); }
  Redirections(const Redirections&) = delete;
  Redirections& operator=(const Redirections&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
  std::array<int, 2> pipe{-1, -1};
  words_ = ::memfd_create("words", MFD_CLOEXEC);
  if (words_ < 0 || ::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    problem_ = message_of(errno);
    return;
  }
  // A reader that went away is an error of write; nothing else of this program writes to pipes of its own.
  ::signal(SIGPIPE, SIG_IGN);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const int failed = ::posix_spawnp(&process_, words[0], Redirections(pipe[0], words_).get(), nullptr,
                                    words.data(), environ);
  ::close(pipe[0]);
  input_ = pipe[1];
  if (failed == 0) return;
  process_ = -1;
  problem_ = fmt::format("cannot start {}: {}", command[0], message_of(failed));
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    finish();
  }
  for (const int file : {input_, words_})
    if (file >= 0) ::close(file);
}

void ChildProcess::write(std::span<const std::byte> bytes) {
  while (!bytes.empty() && problem_.empty()) {
    const ssize_t written = ::write(input_, bytes.data(), bytes.size());
    if (written >= 0)
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      problem_ = message_of(errno);
  }
}

bool ChildProcess::finish() {
  if (process_ <= 0) return false;
  ::close(std::exchange(input_, -1));
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0 && problem_.empty();
  if (good) return true;
  const std::string said = last_words();
  if (!said.empty())
    problem_ = said;
  else if (problem_.empty())
    problem_ = WIFSIGNALED(status) ? fmt::format("signal {} ended it", WTERMSIG(status))
                                   : fmt::format("it ended with status {}", WEXITSTATUS(status));
  return false;
}

std::string ChildProcess::last_words() const {
  std::array<char, 4096> buffer{};
  const off_t size = ::lseek(words_, 0, SEEK_END), begin = std::max<off_t>(size - off_t{buffer.size()}, 0);
  const ssize_t read = ::pread(words_, buffer.data(), buffer.size(), begin);
  std::string_view text(buffer.data(), read > 0 ? static_cast<std::size_t>(read) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  const std::size_t line = text.rfind('\n');
  return std::string(line == std::string_view::npos ? text : text.substr(line + 1));
}

std::string ChildProcess::words() const {
  const off_t size = ::lseek(words_, 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::max<off_t>(size, 0)), '\0');
  const ssize_t read = ::pread(words_, text.data(), text.size(), 0);
  text.resize(read > 0 ? static_cast<std::size_t>(read) : 0);
  return text;
}

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const std::string file = fmt::format("{}/{}", rest.substr(0, end), program);
    if (end > 0 && ::access(file.c_str(), X_OK) == 0) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

}  // namespace tyndall::tools
