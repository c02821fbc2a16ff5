#include "render/path/light_clamp.h"

#include <algorithm>
#include <cmath>

namespace tyndall::render {

namespace {

// The share of the light that is left where no channel may be beyond the limit.
double share_within(const Rgb& light, double limit) {
  const double most = std::max({std::abs(light.x), std::abs(light.y), std::abs(light.z)});
  return most > limit ? limit / most : 1;
}

}  // namespace

void clamp_light(const scene::Clamp& clamp, std::span<const ScatteredLight> scattered,
                 std::span<Rgb> radiance, std::span<AovSample> aovs, ClampedLight& sums) {
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    if (!all_finite(radiance[i])) continue;  // counted as bad
    const auto& [direct, indirect, seen] = scattered[i];
    const double of_direct = share_within(direct, clamp.direct),
                 of_indirect = share_within(indirect, clamp.indirect);
    const Rgb before = radiance[i];
    if (of_direct < 1 || of_indirect < 1)
      radiance[i] = Rgb(Vec3d(seen) + Vec3d(direct) * of_direct + Vec3d(indirect) * of_indirect);
    sums.add(before, radiance[i]);
    if (aovs.empty()) continue;
    if (of_direct < 1) aovs[i].volume_direct *= static_cast<float>(of_direct);
    if (of_indirect < 1) aovs[i].volume_indirect *= static_cast<float>(of_indirect);
  }
}

}  // namespace tyndall::render
