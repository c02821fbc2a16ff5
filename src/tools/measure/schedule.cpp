#include "tools/measure/schedule.h"

#include <algorithm>
#include <optional>

namespace tyndall::tools {
namespace {

constexpr double share_of_reference = 0.4;  // of the budget, while settings wait
constexpr double clearly_more = 1.5;

// The first setting with fewer runs that is wanted and will end in time.
template <class Wanted>
std::optional<Task> run_of(const std::vector<SettingProgress>& settings, int runs, double left,
                           Wanted&& wanted) {
  std::optional<Task> task;
  int fewest = runs;
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (settings[i].runs < fewest && settings[i].seconds <= left && wanted(i)) {
      fewest = settings[i].runs;
      task = Task{Task::Kind::run, i, 0};
    }
  return task;
}

bool wants_better_reference(const ReferenceProgress& reference) {
  return !reference.given && (reference.samples == 0 || reference.error > reference.goal);
}

// As many samples again as there are, or as many as fit into the seconds.
std::optional<Task> reference_within(const ReferenceProgress& reference, double seconds) {
  if (!wants_better_reference(reference)) return std::nullopt;
  if (reference.samples == 0) {
    // Half of the time, for what is expected is a guess; without a reference nothing can be told.
    const double fit =
        reference.expected_seconds > 0 ? seconds / (2 * reference.expected_seconds) : first_reference_samples;
    return Task{Task::Kind::reference, 0,
                static_cast<int>(std::clamp<double>(fit, 1, first_reference_samples))};
  }
  const double per_sample = reference.seconds / reference.samples;
  const double fit = per_sample > 0 ? seconds / per_sample : reference.samples;
  const int samples = static_cast<int>(std::min<double>(reference.samples, fit));
  if (samples < (reference.samples + 3) / 4) return std::nullopt;
  return Task{Task::Kind::reference, 0, samples};
}

}  // namespace

bool near_front(const std::vector<SettingProgress>& settings, std::size_t setting) {
  const SettingProgress& s = settings[setting];
  return std::none_of(settings.begin(), settings.end(), [&](const SettingProgress& other) {
    return other.seconds <= s.seconds && clearly_more * other.error < s.error;
  });
}

Task next_task(const std::vector<SettingProgress>& settings, const ReferenceProgress& reference, int seeds,
               const Budget& budget) {
  const auto any = [](std::size_t) { return true; };
  std::optional<Task> task = run_of(settings, 1, budget.left, any);
  if (!task)
    task = reference_within(reference,
                            std::min(budget.left, share_of_reference * budget.seconds - reference.seconds));
  if (!task) task = run_of(settings, std::min(2, seeds), budget.left, any);
  if (!task)
    task = run_of(settings, seeds, budget.left, [&](std::size_t i) { return near_front(settings, i); });
  if (!task) task = run_of(settings, seeds, budget.left, any);
  if (!task) task = reference_within(reference, budget.left);
  return task && budget.left > 0 ? *task : Task{};
}

bool is_complete(const std::vector<SettingProgress>& settings, const ReferenceProgress& reference,
                 int seeds) {
  return !wants_better_reference(reference) &&
         std::all_of(settings.begin(), settings.end(),
                     [&](const SettingProgress& s) { return s.runs >= seeds; });
}

}  // namespace tyndall::tools
