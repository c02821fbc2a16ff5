// A scene's text from a file, a pipe or a device.
#pragma once

#include <string>

namespace tyndall::tools {

// Reads all of it, resolve::max_file_bytes at most; an error message fit for the user when that is not to be
// had. A named pipe that nothing writes to within two seconds is an error.
std::string read_scene_text(const std::string& path, std::string& text);

}  // namespace tyndall::tools
