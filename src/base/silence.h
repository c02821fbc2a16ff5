// Libraries that print.
#pragma once

#include <fcntl.h>
#include <unistd.h>

namespace tyndall {

// While it lives, what libraries print on standard error is not seen: what is worth telling they
// return.
class Silence {
 public:
  Silence() {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    said_to_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    if (said_to_ >= 0) ::dup2(nowhere, STDERR_FILENO);
    ::close(nowhere);
  }
  ~Silence() {
    if (said_to_ < 0) return;
    ::dup2(said_to_, STDERR_FILENO);
    ::close(said_to_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int said_to_ = -1;
};

}  // namespace tyndall
