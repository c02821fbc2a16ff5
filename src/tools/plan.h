// What a farm is to do for the frames of a scene, as commands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/render_arguments.h"

namespace tyndall::tools {

using Words = std::vector<std::string>;

// Paths are absolute, since tasks may run in any folder.
struct Plan {
  std::string program, scene;
  Words options;                         // of render, but for those that differ from task to task
  std::string output;                    // with a mark for the frame's number, unless there is one frame
  std::vector<std::vector<int>> frames;  // of each task
  std::vector<SampleRange> parts;        // of each frame; empty: whole frames
};

// Frames in groups of `size`, the last may be smaller.
std::vector<std::vector<int>> in_chunks(const std::vector<int>& frames, std::size_t size);

// The samples 0 to samples − 1 in `count` ranges whose sizes differ by one at most; 0 < count <= samples.
std::vector<SampleRange> split_samples(int samples, int count);

// The file of part `i` (from 0) of each frame: "out.####.2of4.tynpart" of "out.####.exr".
std::string part_path(const Plan& plan, std::size_t i);

// "tyndall render SCENE options", which all of the tasks that render begin with.
Words render_words(const Plan& plan);
// What follows it: the frames of a task, or part `i` of its frame.
Words frames_words(const Plan& plan, const std::vector<int>& frames);
Words part_words(const Plan& plan, const std::string& frame, std::size_t i);
// The whole command that merges the parts of a frame. Frames are words, so that they may be a shell's
// variable.
Words merge_words(const Plan& plan, const std::string& frame);

// All commands, one a line, each after those that it needs, and before them comments that say how to run
// them.
std::string plan_lines(const Plan& plan);

}  // namespace tyndall::tools
