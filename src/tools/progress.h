// How far the rendering is, on standard error: a bar on a terminal, now and then a line elsewhere.
#pragma once

#include <optional>
#include <string>

#include "render/render.h"
#include "tools/sequence_progress.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {

enum class ProgressStyle : unsigned char { none, bar, lines };

// "0:07", "12:31", "3:05:00".
std::string duration_text(double seconds);
// "850 ", "12.3 k", "4.56 M": three digits, to be followed by what is counted.
std::string count_text(double count);

class ProgressPrinter {
 public:
  // `sequence`: that the rendering is a frame of; null: of none.
  explicit ProgressPrinter(ProgressStyle style, SequenceProgress* sequence = nullptr)
      : style_(style), sequence_(sequence) {}
  ~ProgressPrinter() { clear(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  // What the renderer calls; valid while this object lives.
  render::Progress callback();
  // Takes the bar away, so that a message can be printed.
  void clear();

 private:
  void report(double fraction, double samples_per_second);

  ProgressStyle style_;
  SequenceProgress* sequence_;
  Stopwatch watch_;
  double elapsed_ = 0, next_line_at_ = 10;  // [s]
  std::optional<double> first_fraction_;    // that was reported
  double first_elapsed_ = 0;                // … and when [s]
  bool bar_shown_ = false;
};

}  // namespace tyndall::tools
