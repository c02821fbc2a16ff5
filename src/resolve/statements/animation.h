// The animation statement: read before everything else, because it decides `frame` and `time`.
#pragma once

#include <optional>

#include "resolve/reading/reader.h"
#include "scene/scene.h"

namespace tyndall::resolve {

struct Run;

// Reads the statement's block; look at reader.ok() before using it.
scene::Animation read_animation(Reader& reader);

bool same(const scene::Animation& a, const scene::Animation& b);

// What the main file's animation statement says, from numbers and the lets and functions above it, without a
// word of complaint; nothing when there is none, it is wrong, or depends on time or frame. Whoever runs the
// statement in its turn reports what is wrong.
std::optional<scene::Animation> foresee_animation(Run& run);

}  // namespace tyndall::resolve
