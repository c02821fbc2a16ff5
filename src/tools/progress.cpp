#include "tools/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/report.h"

namespace tyndall::tools {
namespace {

constexpr double seconds_between_lines = 10;
constexpr int bar_width = 30;

std::string bar(double fraction) {
  const int filled = static_cast<int>(fraction * bar_width);
  return fmt::format("[{:#<{}}{:.<{}}]", "", filled, "", bar_width - filled);
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::lround(std::clamp(seconds, 0.0, 1e9)));
  const long long hours = whole / 3600, minutes = whole / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
  return fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string count_text(double count) {
  constexpr const char* units[] = {" ", " k", " M", " G", " T"};
  std::size_t unit = 0;
  while (count >= 999.5 && unit + 1 < std::size(units)) {
    count /= 1000;
    ++unit;
  }
  if (unit == 0) return fmt::format("{:.0f} ", count);
  const int decimals = count < 9.995 ? 2 : count < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f}{}", count, decimals, units[unit]);
}

render::Progress ProgressPrinter::callback() {
  if (style_ == ProgressStyle::none && !sequence_) return {};
  return {[this](double fraction, double samples_per_second) { report(fraction, samples_per_second); }};
}

void ProgressPrinter::report(double fraction, double samples_per_second) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  elapsed_ += watch_.lap();
  std::optional<double> left;
  // A render that goes on from a checkpoint begins with what others did.
  if (!first_fraction_) first_fraction_ = fraction, first_elapsed_ = elapsed_;
  if (const double gained = fraction - *first_fraction_; gained > 0)
    left = (elapsed_ - first_elapsed_) * (1 - fraction) / gained;
  if (sequence_) {
    sequence_->report(fraction, samples_per_second);
    left = sequence_->seconds_left(fraction);
  }
  if (style_ == ProgressStyle::none) return;
  const std::string text = fmt::format("{}{:3.0f} %  {}samples/s  {} left",
                                       sequence_ ? sequence_->place() + "  " : "", std::floor(100 * fraction),
                                       count_text(samples_per_second), left ? duration_text(*left) : "?");
  if (style_ == ProgressStyle::bar) {
    print_message(fmt::format("\r{} {}\x1b[K", bar(fraction), text));
    bar_shown_ = true;
  } else if (elapsed_ >= next_line_at_) {
    print_message(text + "\n");
    next_line_at_ = elapsed_ + seconds_between_lines;
  }
}

void ProgressPrinter::clear() {
  if (!bar_shown_) return;
  print_message("\r\x1b[K");
  bar_shown_ = false;
}

}  // namespace tyndall::tools
