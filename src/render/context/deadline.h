// When a rendering has to end with what it has.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

namespace tyndall::render {

struct Deadline {
  using Clock = std::chrono::steady_clock;
  const std::atomic<bool>* stop = nullptr;  // set from outside, as by Ctrl-C
  std::optional<Clock::time_point> end;     // of the time limit

  bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
  bool passed() const { return stopped() || (end && Clock::now() >= *end); }
};

}  // namespace tyndall::render
