// What the metadata of a picture, part or checkpoint tell of how it was made.
#pragma once

#include <string>

#include "tools/exit_status.h"

namespace tyndall::tools {

// By its extension.
bool is_picture(const std::string& path);

// Prints what decided the picture, as lines or as JSON.
ExitStatus inspect_picture(const std::string& path, bool as_json);

}  // namespace tyndall::tools
