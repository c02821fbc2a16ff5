#include "tools/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "image/files.h"

namespace tyndall::tools {
namespace {

constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};

std::atomic<bool> saves{false}, interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void on_ending_signal(int signal) {
  if (saves && !interrupted.exchange(true)) return;
  image::remove_unfinished_file();
  if (saves) ::_exit(128 + signal);  // as a shell tells it of a process that the signal ended
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

void clean_up_at_signals() {
  ::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : ending_signals) {
    struct sigaction action {
    }, before{};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    action.sa_handler = on_ending_signal;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

const std::atomic<bool>& catch_interrupts() {
  saves = true;
  return interrupted;
}

}  // namespace tyndall::tools
