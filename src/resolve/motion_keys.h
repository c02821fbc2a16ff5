// What moves while the shutter is open.
#pragma once

#include <cstddef>

#include "resolve/deforming.h"

namespace tyndall::resolve {

// Moments at which a scene is read, at most; of large scenes fewer, so that all their things are not read and
// kept more than so many times.
inline constexpr int max_moments = 16384, least_max_moments = 64;
inline constexpr std::size_t max_moments_of_things = std::size_t{1} << 22;

// Reads the run's scene again at moments while the shutter is open, and keeps with it what moves. Two moments
// will do for what goes evenly or turns evenly, less than half round; other ways get as many as they need
// (motion_error.h), and there is an error when that were more than there may be.
void find_motion(Run& run, SceneAt scene_at);

}  // namespace tyndall::resolve
