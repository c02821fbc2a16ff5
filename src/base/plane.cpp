// Planes: extremes and hash of their texels.
#include "base/plane.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/check.h"

namespace tyndall {

namespace {

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

}  // namespace

PlanePointer make_plane(std::string name, int width, int height, std::vector<float> texels) {
  CHECK_EQ(texels.size(), static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  CHECK(!texels.empty());
  Plane plane{std::move(name), width, height, std::move(texels)};
  for (float& texel : plane.texels)
    if (!std::isfinite(texel)) texel = 0;
  const auto [lowest, highest] = std::minmax_element(plane.texels.begin(), plane.texels.end());
  plane.lowest = *lowest;
  plane.highest = *highest;
  plane.hash = mixed(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
  for (const float texel : plane.texels) plane.hash = mixed(plane.hash, std::bit_cast<std::uint32_t>(texel));
  return std::make_shared<const Plane>(std::move(plane));
}

}  // namespace tyndall
