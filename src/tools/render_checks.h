// What can be said against a rendering before it is done.
#pragma once

#include <string>

#include "scene/render_settings.h"
#include "tools/files_in_use.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// Each gives a message, or an empty string.

// What of the options does not go together, before the scene is read: misuse of the command line.
std::string usage_problem(const RenderArguments& arguments);
// What can be said against the output files before any work is done; they and the scene are in `files` then.
std::string output_problem(const RenderArguments& arguments, FilesInUse& files);
// What of the options does not fit this scene's picture.
std::string picture_problem(const RenderArguments& arguments, const scene::RenderSettings& settings);
// What of the options does not go with the scene's multiple scattering.
std::string scattering_problem(const RenderArguments& arguments, const scene::RenderSettings& settings);
// Either of these two.
std::string settings_problem(const RenderArguments& arguments, const scene::RenderSettings& settings);

// What of the options and the scene will not be heeded.
std::string what_is_ignored(const RenderArguments& arguments, const scene::RenderSettings& settings);

}  // namespace tyndall::tools
