// What moves while the shutter is open.
#pragma once

#include <optional>

#include "scene/scene.h"

namespace tyndall::resolve {

struct Run;

// The same scene at a moment, as a fraction of the time that the shutter is open; nothing after reporting an
// error that it has then.
using SceneAt = std::optional<scene::Scene> (*)(Run& first, double fraction);

// Reads the run's scene again at moments while the shutter is open, and keeps with it what moves. Two
// moments will do for what goes evenly; of other motions there are 33.
void find_motion(Run& run, SceneAt scene_at);

}  // namespace tyndall::resolve
