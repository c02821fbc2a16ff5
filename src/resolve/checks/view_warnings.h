// Warnings of what the camera cannot see, and cannot have been meant to miss.
#pragma once

#include "scene/render_settings.h"

namespace tyndall::resolve {

struct Run;

// A picture that shows nothing of what there is, or volumes none of which overlaps with what the camera sees.
// Never of what may be seen: bounds are compared, and nothing is said of scenes with more than one frame or
// an open shutter, or of what is not visible.
void warn_of_what_is_out_of_view(Run& run, const scene::RenderSettings& settings);

// A camera inside of an opaque shape without any light in it, or inside of a light, which shines outwards.
void warn_of_camera_shut_in(Run& run, const scene::RenderSettings& settings);

}  // namespace tyndall::resolve
