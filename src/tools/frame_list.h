// Frames of a sequence: which are asked for, and what their files are called.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::tools {

// "1..240", "1..240..4" (every fourth), "240..1" (backwards), or several of them and single frames between
// commas; both ends are included. In their order, each once; nothing when the text is no such list, a step
// leads away from its end, a frame is beyond scene::frame_range or there are more than most_frames.
std::optional<std::vector<int>> read_frames(std::string_view text);
inline constexpr std::size_t most_frames = 1'000'000;

// "1..10,20,30..40": so that read_frames gives the same frames, whatever their order, rising.
std::string frames_text(std::vector<int> frames);

// Whether a path's file has a mark, two or more `#` in a row, that a frame's number takes the place of.
bool has_frame_mark(std::string_view path);
// The path with the number of a frame where its mark is, with zeros in front up to the mark's width, a minus
// included: printf's %04d. Longer numbers are wider. Without a mark: the path.
std::string numbered(const std::string& path, int frame);
// The path with a mark in front of its extension: what a name without one could be.
std::string with_frame_mark(const std::string& path);

}  // namespace tyndall::tools
