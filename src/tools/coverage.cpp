#include "tools/coverage.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::tools {

std::optional<SampleBox> common(const SampleBox& a, const SampleBox& b) {
  const auto &p = a.pixels, &q = b.pixels;
  const SampleBox box{
      {std::max(p.x0, q.x0), std::max(p.y0, q.y0), std::min(p.x1, q.x1), std::min(p.y1, q.y1)},
      {std::max(a.samples.first, b.samples.first), std::min(a.samples.last, b.samples.last)}};
  const bool any =
      box.pixels.x0 < box.pixels.x1 && box.pixels.y0 < box.pixels.y1 && box.samples.first <= box.samples.last;
  return any ? std::optional(box) : std::nullopt;
}

SampleBox hull(const std::vector<SampleBox>& boxes) {
  SampleBox all = boxes.front();
  for (const auto& [pixels, samples] : boxes) {
    all.pixels.x0 = std::min(all.pixels.x0, pixels.x0);
    all.pixels.y0 = std::min(all.pixels.y0, pixels.y0);
    all.pixels.x1 = std::max(all.pixels.x1, pixels.x1);
    all.pixels.y1 = std::max(all.pixels.y1, pixels.y1);
    all.samples.first = std::min(all.samples.first, samples.first);
    all.samples.last = std::max(all.samples.last, samples.last);
  }
  return all;
}

std::vector<SampleBox> missing(const SampleBox& whole, const std::vector<SampleBox>& parts) {
  std::vector<SampleBox> left{whole}, next;
  for (const SampleBox& part : parts) {
    next.clear();
    for (SampleBox box : left) {
      const auto taken = common(box, part);
      if (!taken) {
        next.push_back(box);
        continue;
      }
      // Cuts off what lies before and behind the taken box, in samples, then rows, then columns.
      const auto cut = [&](int& first, int& end, int taken_first, int taken_end, int gap) {
        if (first < taken_first) {
          const int kept = end;
          end = taken_first - gap;
          next.push_back(box);
          end = kept;
          first = taken_first;
        }
        if (end > taken_end) {
          const int kept = first;
          first = taken_end + gap;
          next.push_back(box);
          first = kept;
          end = taken_end;
        }
      };
      cut(box.samples.first, box.samples.last, taken->samples.first, taken->samples.last, 1);
      cut(box.pixels.y0, box.pixels.y1, taken->pixels.y0, taken->pixels.y1, 0);
      cut(box.pixels.x0, box.pixels.x1, taken->pixels.x0, taken->pixels.x1, 0);
    }
    left.swap(next);
  }
  return left;
}

std::string text_of(const SampleBox& box, const render::PixelWindow& picture) {
  const auto& [pixels, samples] = box;
  const std::string of = pixels == picture
                             ? std::string("all pixels")
                             : fmt::format("the pixels from ({}, {}) up to, but not including, ({}, {})",
                                           pixels.x0, pixels.y0, pixels.x1, pixels.y1);
  return fmt::format("samples {}..{} of {}", samples.first, samples.last, of);
}

}  // namespace tyndall::tools
