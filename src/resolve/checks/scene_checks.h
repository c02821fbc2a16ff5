// Checks of the whole scene, after all its items.
#pragma once

namespace tyndall::resolve {

struct Run;

// Every --set must have met its `let`.
void check_overrides(Run& run);
// A camera, a light, no light that is infinitely bright. Silent when there are errors already.
void check_scene(Run& run);

}  // namespace tyndall::resolve
