// What is in a file of grids: `tyndall inspect smoke.vdb`.
#pragma once

#include <string>

#include "tools/exit_status.h"

namespace tyndall::tools {

// Whether a path is one of a file of grids, by its name.
bool is_grid_file(const std::string& path);

// Reads all grids of the file and prints what they are, as text or JSON.
ExitStatus inspect_grids(const std::string& path, bool json);

}  // namespace tyndall::tools
