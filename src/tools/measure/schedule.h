// What is measured next, so that a budget of time tells most.
#pragma once

#include <cstddef>
#include <vector>

namespace tyndall::tools {

// What is known of a setting.
struct SettingProgress {
  int runs = 0;
  double seconds = 0;  // of a run
  double error = 0;    // root of the relMSE; 0: not known
};

struct ReferenceProgress {
  bool given = false;
  int samples = 0;              // a pixel of each part, so far
  double seconds = 0;           // that it took
  double expected_seconds = 0;  // of a sample a pixel in all parts, before there is one; 0: not known
  double error = 0, goal = 0;
};

struct Task {
  enum class Kind { none, run, reference } kind = Kind::none;
  std::size_t setting = 0;  // of a run
  int samples = 0;          // of each part of the reference, more
};

struct Budget {
  double seconds = 0, left = 0;
};

inline constexpr int first_reference_samples = 16;
inline constexpr int reference_parts = 6;

// Whether no other setting is as fast and clearly more accurate.
bool near_front(const std::vector<SettingProgress>& settings, std::size_t setting);

// A render of each setting, a reference, a second render of each, those near the Pareto front up to `seeds`,
// the others, and with what time is left a better reference. What would not end in time is left out.
Task next_task(const std::vector<SettingProgress>& settings, const ReferenceProgress& reference, int seeds,
               const Budget& budget);

// Whether nothing is left to be done, however much time there were.
bool is_complete(const std::vector<SettingProgress>& settings, const ReferenceProgress& reference, int seeds);

}  // namespace tyndall::tools
