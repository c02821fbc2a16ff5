#include "image/apart.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <limits>
#include <optional>

namespace tyndall::image {
namespace {

// Of a child: processor time, memory beyond what is mapped already.
constexpr rlim_t most_seconds = 120;
constexpr rlim_t most_memory = rlim_t{4} << 30;

// What is sent: the header, then rows, at last the error or an empty text.
enum class Part : std::uint64_t { header, row, end };

// Numbers and texts through a pipe, in the machine's own form.
class Pipe {
 public:
  explicit Pipe(int end) : end_(end) {}
  ~Pipe() { ::close(end_); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  bool ok() const { return ok_; }

  void put(const void* data, std::size_t size) {
    pass(size,
         [&](std::size_t done) { return ::write(end_, static_cast<const char*>(data) + done, size - done); });
  }
  void get(void* data, std::size_t size) {
    pass(size, [&](std::size_t done) { return ::read(end_, static_cast<char*>(data) + done, size - done); });
  }
  template <class Number>
  void put_number(Number number) {
    put(&number, sizeof number);
  }
  template <class Number>
  Number number() {
    Number value{};
    get(&value, sizeof value);
    return value;
  }
  void put_text(const std::string& text) {
    put_number<std::uint64_t>(text.size());
    put(text.data(), text.size());
  }
  // A child that goes wrong may send anything: sizes are limited.
  std::string text() {
    std::string value;
    value.resize(count(std::uint64_t{1} << 20));
    get(value.data(), value.size());
    return value;
  }
  std::uint64_t count(std::uint64_t most) {
    const auto value = number<std::uint64_t>();
    ok_ = ok_ && value <= most;
    return ok_ ? value : 0;
  }

 private:
  template <class Step>
  void pass(std::size_t size, Step&& step) {
    for (std::size_t done = 0; ok_ && done < size;) {
      const ::ssize_t more = step(done);
      if (more < 0 && errno == EINTR) continue;
      ok_ = more > 0;
      if (ok_) done += static_cast<std::size_t>(more);
    }
  }

  int end_;
  bool ok_ = true;
};

class Sender final : public RowTaker {
 public:
  explicit Sender(Pipe& pipe) : pipe_(pipe) {}

  std::string begin(const PictureHeader& header) override {
    pipe_.put_number(Part::header);
    pipe_.put_number(header.width);
    pipe_.put_number(header.height);
    pipe_.put_number(header.transfer);
    pipe_.put_number<std::uint64_t>(header.channels.size());
    for (const std::string& channel : header.channels) pipe_.put_text(channel);
    pipe_.put_number<std::uint64_t>(header.chosen.size());
    for (const std::size_t channel : header.chosen) pipe_.put_number<std::uint64_t>(channel);
    return {};
  }
  void row(std::span<const float> numbers) override {
    pipe_.put_number(Part::row);
    pipe_.put(numbers.data(), numbers.size_bytes());
  }

 private:
  Pipe& pipe_;
};

// Nothing when the child goes wrong.
std::optional<PictureHeader> received_header(Pipe& pipe) {
  constexpr std::uint64_t most_channels = 1 << 16;
  PictureHeader header;
  header.width = pipe.number<int>();
  header.height = pipe.number<int>();
  header.transfer = pipe.number<Transfer>();
  header.channels.resize(pipe.count(most_channels));
  for (std::string& channel : header.channels) channel = pipe.text();
  header.chosen.resize(pipe.count(header.channels.size()));
  for (std::size_t& channel : header.chosen) channel = pipe.count(header.channels.size() - 1);
  if (!pipe.ok() || header.width < 1 || header.height < 1) return std::nullopt;
  return header;
}

// The error message, if any; nothing when the child goes wrong.
std::optional<std::string> receive(Pipe& pipe, RowTaker& taker) {
  std::optional<PictureHeader> header;
  std::vector<float> row;
  for (int rows = 0; pipe.ok();) {
    switch (pipe.number<Part>()) {
      case Part::header:
        if (!pipe.ok() || header || !(header = received_header(pipe))) return std::nullopt;
        if (std::string problem = taker.begin(*header); !problem.empty()) return problem;
        row.resize(static_cast<std::size_t>(header->width) * header->chosen.size());
        break;
      case Part::row:
        if (!header || rows++ == header->height) return std::nullopt;
        pipe.get(row.data(), row.size() * sizeof(float));
        if (pipe.ok()) taker.row(row);
        break;
      case Part::end: {
        std::string error = pipe.text();
        if (!pipe.ok()) return std::nullopt;
        return error;
      }
    }
  }
  return std::nullopt;
}

void limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  now.rlim_cur = std::min(now.rlim_max, most);
  ::setrlimit(resource, &now);
}

void limit_child() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  limit(RLIMIT_AS, pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + most_memory);
  limit(RLIMIT_CPU, most_seconds);
  limit(RLIMIT_CORE, 0);
  ::alarm(static_cast<unsigned>(5 * most_seconds));  // for one that waits for something
  for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGPIPE, SIGXCPU, SIGALRM})
    ::signal(fatal, SIG_DFL);
}

// Why a child did not send all of its picture.
std::string why_ended(int status) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM))
    return fmt::format("reading it takes more than {} s", most_seconds);
  return "it is broken: the library that reads its format crashed, or ran out of memory";
}

}  // namespace

std::string decode_apart(const std::function<std::string(RowTaker&)>& decode, RowTaker& taker) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return "the system refuses a pipe to read it through";
  const ::pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    limit_child();
    try {
      Pipe pipe(ends[1]);
      Sender sender(pipe);
      const std::string error = decode(sender);
      pipe.put_number(Part::end);
      pipe.put_text(error);
    } catch (...) {  // out of memory, most likely: the parent tells
    }
    ::_exit(0);
  }
  ::close(ends[1]);
  std::optional<std::string> result;
  {
    Pipe pipe(ends[0]);
    if (child < 0) return "the system refuses a process to read it in";
    result = receive(pipe, taker);
  }
  ::kill(child, SIGKILL);  // of one that ended by itself nothing changes
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return result ? *result : why_ended(status);
}

}  // namespace tyndall::image
