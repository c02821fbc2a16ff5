// Light that is there as it would be rendered, and tells that it is to be shown in another way.
#pragma once

#include <string>

#include "tools/frame_source.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// Whether the .exr or part at arguments.output, which is not stale, tells another view than the scene and the
// arguments do.
bool has_other_view(const RenderArguments& arguments);

// Lets it tell theirs: its light stays. A message, or an empty string.
std::string renew_view(const RenderArguments& arguments, FrameSource& source);

}  // namespace tyndall::tools
