// How far the rendering is, on standard error: a bar on a terminal, now and then a line elsewhere.
#pragma once

#include <string>

#include "render/render.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {

enum class ProgressStyle : unsigned char { none, bar, lines };

// "0:07", "12:31", "3:05:00".
std::string duration_text(double seconds);
// "850 ", "12.3 k", "4.56 M": three digits, to be followed by what is counted.
std::string count_text(double count);

class ProgressPrinter {
 public:
  explicit ProgressPrinter(ProgressStyle style) : style_(style) {}
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
  Stopwatch watch_;
  double elapsed_ = 0, next_line_at_ = 10;  // [s]
  bool bar_shown_ = false;
};

}  // namespace tyndall::tools
