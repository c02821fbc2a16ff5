// Warnings of lights that light nothing.
#pragma once

#include "scene/render_settings.h"

namespace tyndall::resolve {

struct Run;

// Lights wholly inside a shape that lets no light out, with the camera outside.
void warn_of_lights_shut_in(Run& run, const scene::RenderSettings& settings);

// Lights of one side or of a cone that have all there is, and the camera, in their back.
void warn_of_lights_turned_away(Run& run, const scene::RenderSettings& settings);

}  // namespace tyndall::resolve
