// What would keep the tasks of a plan from being done, told before they are on forty machines.
#pragma once

#include <vector>

#include "tools/exit_status.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

struct PlannedFrames {
  std::vector<int> numbers;  // in their order
  int samples = 0;           // of a pixel, the same in all frames; known when they are to be split
};

// Reads the scene at each of the frames, as check does, and looks at options and outputs, as render does;
// tells of every problem. `split` is how many parts a frame is to have.
ExitStatus check_frames(const RenderArguments& arguments, int split, PlannedFrames& frames);

}  // namespace tyndall::tools
