// Warnings of what cannot have been meant, from where things stand: volumes out of the picture, lights shut
// in.
#pragma once

namespace tyndall::resolve {

struct Run;

// Volumes none of which overlaps with what the camera sees. Never of one that may be seen: bounds are
// compared, and nothing is said of scenes with more than one frame or an open shutter, or of volumes that are
// not visible.
void warn_of_volumes_out_of_view(Run& run);

// Lights wholly inside a shape that lets no light out, with the camera outside.
void warn_of_lights_shut_in(Run& run);

}  // namespace tyndall::resolve
