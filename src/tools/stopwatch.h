// Wall-clock time of a stage.
#pragma once

#include <chrono>

namespace tyndall::tools {

class Stopwatch {
 public:
  // Seconds since it was made or last began a lap.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  // The same, and begins one.
  double lap() {
    const double before = seconds();
    start_ = Clock::now();
    return before;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace tyndall::tools
