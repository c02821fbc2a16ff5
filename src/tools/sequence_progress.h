// How far a sequence of frames is: frame k of n and the time left, judged by the frames before; for people,
// and with --json an object a line.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "tools/stopwatch.h"

namespace tyndall::tools {

class SequenceProgress {
 public:
  // Of so many frames.
  SequenceProgress(std::size_t count, bool prints_json) : count_(count), prints_json_(prints_json) {}

  void begin_frame(int frame);
  // `fraction` of the frame is rendered, in so many seconds.
  void report(double fraction, double samples_per_second);
  // Frames that were there already tell nothing about the time of others.
  void end_frame(bool was_rendered);

  // "frame 7 of 48".
  std::string place() const;
  // Of all frames [s]; nothing while there is no telling.
  std::optional<double> seconds_left(double fraction) const;
  // With --json prints what happened to the frame, with its place, on a line of its own.
  void print_line(nlohmann::json object) const;

 private:
  std::size_t count_, begun_ = 0, rendered_ = 0;
  bool prints_json_;
  int frame_ = 0;
  double seconds_rendered_ = 0;  // of all frames that were rendered
  double next_line_ = 0;         // at this second of the frame
  Stopwatch watch_;              // since the frame began
};

}  // namespace tyndall::tools
