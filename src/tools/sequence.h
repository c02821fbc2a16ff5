// `tyndall render` of several frames.
#pragma once

#include "tools/exit_status.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// Renders the frames that the arguments ask for, each into a file of its number. A bad one does not keep the
// others from being rendered; a full disk, an interruption and misuse of the command line do. Which frames
// are missing is told at the end.
ExitStatus render_sequence(const RenderArguments& arguments);

}  // namespace tyndall::tools
