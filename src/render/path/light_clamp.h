// Limits what each camera sample brings (scene/clamp.h).
//
// The limit is that of a whole sample, not of each light that its path finds: it then means the same whatever
// number of bounces and light samples the light comes in, and negative parts, which some estimators of
// transmittance have, are balanced by the positive ones before. A color that exceeds it keeps its hue.
#pragma once

#include <span>
#include <string>

#include "render/context/clamped_light.h"
#include "render/film/aov.h"
#include "render/lights/scattered_light.h"
#include "scene/clamp.h"

namespace tyndall::render {

// Limits the radiance of samples, of which `scattered` was scattered, and the outputs beside the picture
// likewise; adds what is gone to `sums`. A sample within the limits stays as it is, bit for bit.
void clamp_light(const scene::Clamp& clamp, std::span<const ScatteredLight> scattered,
                 std::span<Rgb> radiance, std::span<AovSample> aovs, ClampedLight& sums);

}  // namespace tyndall::render
