// Another program that is given bytes on its standard input.
#pragma once

#include <sys/types.h>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tyndall::tools {

class ChildProcess {
 public:
  // Starts it, found by PATH; what it says on standard error is kept. Whether it could be started:
  // problem().
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();  // ends it, unless finish() came before
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Once a write has failed the others do nothing.
  void write(std::span<const std::byte> bytes);
  // Closes its input and waits for its end. Whether it ended well; else problem() says why it did not.
  bool finish();
  // In its own words, as far as it said any: the last line; when a signal ended it, that.
  const std::string& problem() const { return problem_; }
  // Whether a signal ended it: what it said is no reason then.
  bool was_killed() const { return was_killed_; }
  // All that it said.
  std::string words() const;

 private:
  std::string last_words() const;

  pid_t process_ = -1;
  int input_ = -1, words_ = -1;
  bool was_killed_ = false;
  std::string problem_;
};

// Whether PATH has a program of this name.
bool is_installed(const std::string& program);

}  // namespace tyndall::tools
