#include "tools/sequence_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/report.h"

namespace tyndall::tools {
namespace {

constexpr double seconds_between_json_lines = 1;

}  // namespace

void SequenceProgress::begin_frame(int frame) {
  frame_ = frame;
  ++begun_;
  next_line_ = 0;
  watch_.lap();
}

void SequenceProgress::report(double fraction, double samples_per_second) {
  const double now = watch_.seconds();
  if (!prints_json_ || now < next_line_) return;
  next_line_ = now + seconds_between_json_lines;
  nlohmann::json line{
      {"event", "progress"}, {"fraction", fraction}, {"samples_per_second", samples_per_second}};
  if (const auto left = seconds_left(fraction)) line["seconds_left"] = *left;
  print_line(std::move(line));
}

void SequenceProgress::end_frame(bool was_rendered) {
  if (!was_rendered) return;
  ++rendered_;
  seconds_rendered_ += watch_.seconds();
}

std::string SequenceProgress::place() const { return fmt::format("frame {} of {}", begun_, count_); }

std::optional<double> SequenceProgress::seconds_left(double fraction) const {
  const double now = watch_.seconds();
  // A frame that was there already tells nothing at its end.
  if (rendered_ == 0 && !(fraction > 0 && fraction < 1)) return std::nullopt;
  const double of_a_frame =
      rendered_ > 0 ? seconds_rendered_ / static_cast<double>(rendered_) : now / fraction;
  const double of_this = fraction > 0 ? now * (1 - fraction) / fraction : std::max(of_a_frame - now, 0.0);
  return of_this + of_a_frame * static_cast<double>(count_ - begun_);
}

void SequenceProgress::print_line(nlohmann::json object) const {
  if (!prints_json_) return;
  object["frame"] = frame_;
  object["number"] = begun_;
  object["count"] = count_;
  print_json_line(object);
}

}  // namespace tyndall::tools
