#include "tools/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
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

// Becomes the command, with standard input from one file, output to nowhere, errors to another. It ends with
// the thread that started it, which waits for it: nobody would want what it makes any more. Between fork and
// exec of a process with threads only what is safe in a signal handler may be called.
[[noreturn]] void become(char* const words[], int input, int errors, int failure) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(input, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::signal(SIGPIPE, SIG_DFL);
  ::execvp(words[0], words);
  const int why = errno;
  [[maybe_unused]] const ssize_t told = ::write(failure, &why, sizeof why);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
  std::array<int, 2> pipe{-1, -1}, failure{-1, -1};
  words_ = ::memfd_create("words", MFD_CLOEXEC);
  if (words_ < 0 || ::pipe2(pipe.data(), O_CLOEXEC) != 0 || ::pipe2(failure.data(), O_CLOEXEC) != 0) {
    problem_ = message_of(errno);
    return;
  }
  // A reader that went away is an error of write; nothing else of this program writes to pipes of its own.
  ::signal(SIGPIPE, SIG_IGN);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) become(words.data(), pipe[0], words_, failure[1]);
  int failed = process_ < 0 ? errno : 0;
  ::close(pipe[0]);
  ::close(failure[1]);
  input_ = pipe[1];
  // Nothing is read where it became the command.
  if (process_ > 0)
    while (::read(failure[0], &failed, sizeof failed) < 0 && errno == EINTR) {
    }
  ::close(failure[0]);
  if (failed == 0) return;
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
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
  was_killed_ = WIFSIGNALED(status);
  const std::string said = last_words();
  if (was_killed_)
    problem_ = fmt::format("signal {} ended it", WTERMSIG(status));
  else if (!said.empty())
    problem_ = said;
  else if (problem_.empty())
    problem_ = fmt::format("it ended with status {}", WEXITSTATUS(status));
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
