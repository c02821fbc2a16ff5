// Warnings of media, from what they are in their volumes.
#pragma once

#include "scene/render_settings.h"

namespace tyndall::resolve {

struct Run;

// Numbers of a body that are out of their range at a place in a volume; an error where Options::strict says
// so. A volume that is empty, for its shader is 0 in all of it. A step that is longer than a volume whose
// medium varies. Bounces that will leave out much of the light that a dense, bright medium scatters.
void warn_of_media(Run& run, const scene::RenderSettings& settings);

}  // namespace tyndall::resolve
