// A movie of frames, made by ffmpeg where that is installed.
#pragma once

#include <string>
#include <vector>

#include "tools/view_options.h"

namespace tyndall::tools {

// What can be said against a movie at this path before there are any frames: its kind, its folder, or that
// there is no ffmpeg. Empty: nothing.
std::string movie_problem(const std::string& path);

// Shows the pictures one after the other, at so many a second, as an 8-bit picture of each would, light with
// the view that was given in place of its own: H.264 in 4:2:0, BT.709, with an odd side made even by a black
// line. All must be of one size. The file appears as a whole or not at all. An error message fit for the
// user, or an empty string.
std::string write_movie(const std::string& path, const std::vector<std::string>& pictures,
                        const GivenView& given, double fps);

}  // namespace tyndall::tools
