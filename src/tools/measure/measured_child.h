// Work done in a process of its own, so that its time and memory are its own too.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace tyndall::tools {

struct ChildCost {
  double wall_seconds = 0, cpu_seconds = 0;  // the latter of all threads
  double peak_bytes = 0;                     // most that was resident at a time, the program's own included
};

struct ChildResult {
  std::string bytes;  // what the work gave
  ChildCost cost;
  std::string problem;  // why there is nothing else; "" otherwise
  bool stopped = false;
};

// Forks: this process must have one thread. The work may take what it captures apart, for it has a copy. When
// `stop` is set the child is ended.
ChildResult in_child(const std::function<std::string()>& work, const std::atomic<bool>& stop);

}  // namespace tyndall::tools
