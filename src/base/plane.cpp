// Planes: extremes and hash of their texels.
#include "base/plane.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/check.h"

namespace tyndall {

namespace {

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

}  // namespace

PlaneSummary::PlaneSummary(int width, int height)
    : lowest_(std::numeric_limits<float>::infinity()),
      highest_(-std::numeric_limits<float>::infinity()),
      hash_(mixed(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height))) {}

void PlaneSummary::add(float texel) {
  lowest_ = std::min(lowest_, texel);
  highest_ = std::max(highest_, texel);
  hash_ = mixed(hash_, std::bit_cast<std::uint32_t>(texel));
}

void PlaneSummary::write_to(Plane& plane) const {
  plane.lowest = lowest_;
  plane.highest = highest_;
  plane.hash = hash_;
}

PlanePointer make_plane(std::string name, int width, int height, std::vector<float> texels) {
  CHECK_EQ(texels.size(), static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  CHECK(!texels.empty());
  Plane plane{std::move(name), width, height, std::move(texels)};
  PlaneSummary summary(width, height);
  for (float& texel : plane.texels) {
    if (!std::isfinite(texel)) texel = 0;
    summary.add(texel);
  }
  summary.write_to(plane);
  return std::make_shared<const Plane>(std::move(plane));
}

}  // namespace tyndall
