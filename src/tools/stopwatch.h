// Wall-clock time of a stage.
#pragma once

#include <chrono>

namespace tyndall::tools {

class Stopwatch {
 public:
  // Seconds since it was made or last read.
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace tyndall::tools
