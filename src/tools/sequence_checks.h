// What is known of a sequence before its first frame is rendered: which frames, and whether each has a name.
#pragma once

#include <string>
#include <vector>

#include "tools/frame_source.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// Whether the arguments ask for a sequence: by --frames, or by an output with a mark for the frame's number
// and no --frame.
bool is_sequence(const RenderArguments& arguments);

// The frames of --frames, or else of the scene's `animation`, in their order.
std::vector<int> frames_of(const RenderArguments& arguments, const FrameSource& source);

// The arguments of one frame: with its number in the names of what is written.
RenderArguments of_frame(const RenderArguments& arguments, int frame);

// That several frames have one name, and what it could be; empty when they do not.
std::string frame_name_problem(const RenderArguments& arguments, std::size_t frames);

// What the scene says of its frames is warned of once, not by each frame.
void warn_of_frames_outside(const std::vector<int>& frames, const FrameSource& source,
                            const SceneRequest& request);

}  // namespace tyndall::tools
