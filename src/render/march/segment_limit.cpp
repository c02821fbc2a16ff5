#include "render/march/segment_limit.h"

namespace tyndall::render {

void SegmentShortage::add(const MarchedInterval& interval) {
  const scene::Step& step = world_->volumes[interval.volume].step;
  if (!step.proven) {
    asked_step_ = std::min(asked_step_, interval.step);
    return;
  }
  tolerance_ = std::max(tolerance_, step.tolerance);
  spread_ += double{interval.spread};
  minorant_ += double{interval.minorant};
}

void SegmentShortage::end_part(double length, std::uint32_t count) {
  if (const double step = length / count;
      step > asked_step_ && step * worst_asked_ > worst_step_ * asked_step_) {
    worst_asked_ = asked_step_;
    worst_step_ = step;
  }
  // E[T'] - T <= T (exp(S) - 1), and no more than 1.
  spent_ += sqr(length * spread_) / (8.0 * count);
  reached_ = std::max(reached_, std::min(std::expm1(std::min(spent_, 700.0)) * std::exp(-depth_), 1.0));
  depth_ += length * minorant_;
}

void SegmentShortage::count_in(Statistics& statistics) const {
  if (worst_step_ > 0) statistics.widened_steps.add(worst_asked_, worst_step_);
  if (reached_ > tolerance_ && tolerance_ > 0) statistics.missed_tolerances.add(tolerance_, reached_);
}

}  // namespace tyndall::render
