#include "cli/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

#if defined(__SANITIZE_ADDRESS__)
constexpr auto patience = std::chrono::minutes(10);
constexpr double slower = 4;
#else
constexpr auto patience = std::chrono::minutes(2);
constexpr double slower = 1;
#endif

// A file that stands for a standard stream: what was said is read from it while the program runs.
class StreamFile {
 public:
  StreamFile() : path_((fs::temp_directory_path() / "tyndall-stream-XXXXXX").string()) {
    descriptor_ = ::mkstemp(path_.data());
  }
  ~StreamFile() {
    ::close(descriptor_);
    ::unlink(path_.c_str());
  }
  int descriptor() const { return descriptor_; }
  std::string text() const { return read_file(path_); }

 private:
  std::string path_;
  int descriptor_;
};

[[noreturn]] void become(const std::string& executable, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment, int out, int err) {
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) std::signal(signal, SIG_DFL);
  for (const std::string& variable : environment) ::putenv(const_cast<char*>(variable.c_str()));
  std::vector<char*> argv{const_cast<char*>(executable.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(executable.c_str(), argv.data());
  ::_exit(127);
}

// Whether a process has a handler for a signal, if it can have one: the mask SigCgt of its status (man 5 proc).
bool catches(pid_t process, int signal) {
  if (signal == SIGKILL) return true;
  const std::string status = read_file("/proc/" + std::to_string(process) + "/status");
  const std::size_t place = status.find("SigCgt:");
  if (place == std::string::npos) return false;
  return std::stoull(status.substr(place + 7), nullptr, 16) >> (signal - 1) & 1;
}

}  // namespace

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Outcome run(const std::string& executable, const std::vector<std::string>& arguments,
            const RunOptions& options) {
  const StreamFile out, err;
  const auto begin = Clock::now();
  const pid_t child = ::fork();
  if (child == 0) become(executable, arguments, options.environment, out.descriptor(), err.descriptor());

  int sent = 0;
  bool interrupted = options.interrupt_after_seconds <= 0;
  auto may_interrupt_since = Clock::time_point::max();
  int state = 0;
  while (::waitpid(child, &state, WNOHANG) == 0) {
    const auto now = Clock::now();
    if (now - begin > patience) ::kill(child, SIGKILL);
    if (!interrupted) {
      if (may_interrupt_since == Clock::time_point::max() &&
          (!options.wait_until_caught || catches(child, options.signal)) &&
          (options.wait_for_on_err.empty() ||
           err.text().find(options.wait_for_on_err) != std::string::npos) &&
          (!options.wait_for || options.wait_for()))
        may_interrupt_since = now;
      if (may_interrupt_since != Clock::time_point::max() &&
          now - may_interrupt_since >
              std::chrono::duration<double>(slower * options.interrupt_after_seconds)) {
        ::kill(child, options.signal);
        interrupted = ++sent == options.times;
        may_interrupt_since = now;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const int status = WIFSIGNALED(state) ? 128 + WTERMSIG(state) : WEXITSTATUS(state);
  return {status, out.text(), err.text()};
}

Outcome tyndall(const std::vector<std::string>& arguments, const RunOptions& options) {
  return run(TYNDALL_PROGRAM, arguments, options);
}

void CliTest::SetUp() {
  std::string pattern = (fs::temp_directory_path() / "tyndall-cli-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  directory_ = pattern;
}

void CliTest::TearDown() { fs::remove_all(directory_); }

std::string CliTest::file(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::size_t CliTest::file_count() const {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
}

std::string small_scene() {
  return R"(render { resolution: (16, 12)  samples: 2  step: 0.2  bounces: 2 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }
let thickness = 3
medium cloud(amount = 1) {
  density = amount * smoothstep(1, 0.2, length(p) + 0.3 * fbm(p * 2, octaves: 3))
  albedo = 0.9
  phase = hg(0.4)
}
volume { in: sphere { radius: 1.3 }  medium: cloud(amount: thickness) }
light sphere { center: (2, 3, 1)  radius: 0.2  power: 100 }
plane { point: (0, -1, 0)  normal: (0, 1, 0) }
)";
}

}  // namespace tyndall::test
