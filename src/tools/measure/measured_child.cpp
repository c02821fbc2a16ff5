#include "tools/measure/measured_child.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include "tools/stopwatch.h"

namespace tyndall::tools {
namespace {

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

bool write_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// What the child sends: whether the work was done, its costs, its bytes or why there are none.
[[noreturn]] void work_and_end(const std::function<std::string()>& work, int to) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::string bytes;
  char good = 1;
  const Stopwatch watch;
  try {
    bytes = work();
  } catch (const std::bad_alloc&) {
    good = 0;
    bytes = "there is not enough memory";
  }
  ChildCost cost;
  cost.wall_seconds = watch.seconds();
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  cost.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  cost.peak_bytes = static_cast<double>(usage.ru_maxrss) * 1024;
  std::string head(1 + sizeof cost, good);
  std::memcpy(head.data() + 1, &cost, sizeof cost);
  const bool sent = write_all(to, head) && write_all(to, bytes);
  std::fflush(stderr);
  std::_Exit(sent ? 0 : 1);
}

// Reads until the other side ends; ends the child when asked to.
bool read_until_end(int from, pid_t child, const std::atomic<bool>& stop, std::string& bytes) {
  std::array<char, 65536> buffer;
  while (true) {
    if (stop) {
      ::kill(child, SIGKILL);
      return false;
    }
    pollfd waited{from, POLLIN, 0};
    if (::poll(&waited, 1, 50) <= 0) continue;
    const ssize_t count = ::read(from, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

ChildResult in_child(const std::function<std::string()>& work, const std::atomic<bool>& stop) {
  ChildResult result;
  std::array<int, 2> pipe{};
  std::fflush(nullptr);
  if (::pipe(pipe.data()) != 0) {
    result.problem = fmt::format("cannot make a pipe: {}", std::strerror(errno));
    return result;
  }
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe[0]);
    work_and_end(work, pipe[1]);
  }
  const int why = errno;
  ::close(pipe[1]);
  std::string bytes;
  int status = 0;
  if (child > 0) {
    result.stopped = !read_until_end(pipe[0], child, stop, bytes);
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  }
  ::close(pipe[0]);
  constexpr std::size_t head = 1 + sizeof(ChildCost);
  if (child < 0)
    result.problem = fmt::format("cannot start a process: {}", std::strerror(why));
  else if (status != 0 || bytes.size() < head)
    result.problem = WIFSIGNALED(status) ? fmt::format("it was ended by signal {}", WTERMSIG(status))
                                         : "it ended before it was done";
  if (!result.problem.empty()) return result;
  std::memcpy(&result.cost, bytes.data() + 1, sizeof result.cost);
  result.bytes = bytes.substr(head);
  if (bytes[0] == 0) result.problem.swap(result.bytes);
  return result;
}

}  // namespace tyndall::tools
