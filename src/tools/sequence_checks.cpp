#include "tools/sequence_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "tools/frame_list.h"
#include "tools/report.h"

namespace tyndall::tools {

bool is_sequence(const RenderArguments& arguments) {
  return arguments.frames || (has_frame_mark(arguments.output) && !arguments.scene.frame && !arguments.pixel);
}

RenderArguments of_frame(const RenderArguments& arguments, int frame) {
  RenderArguments out = arguments;
  out.scene.frame = frame;
  out.output = numbered(arguments.output, frame);
  out.part_of = numbered(arguments.part_of, frame);
  out.statistics_file = numbered(arguments.statistics_file, frame);
  return out;
}

std::vector<int> frames_of(const RenderArguments& arguments, const FrameSource& source) {
  if (arguments.frames) return *arguments.frames;
  const auto animation = source.animation(arguments.scene);
  std::vector<int> frames;
  const scene::Animation range = animation.value_or(scene::Animation{});
  for (int frame = range.first_frame; frame <= range.last_frame; ++frame) frames.push_back(frame);
  return frames;
}

std::string frame_name_problem(const RenderArguments& arguments, std::size_t frames) {
  if (frames < 2) return {};
  for (const auto& [option, path] :
       {std::pair{"-o", &arguments.output}, std::pair{"--stats", &arguments.statistics_file},
        std::pair{"--part-of", &arguments.part_of}})
    if (!path->empty() && !has_frame_mark(*path))
      return fmt::format(
          "{} frames cannot all be written to '{}': write {} '{}', where #### stands for the "
          "frame's number",
          frames, *path, option, with_frame_mark(*path));
  return {};
}

void warn_of_frames_outside(const std::vector<int>& frames, const FrameSource& source,
                            const SceneRequest& request) {
  const auto animation = source.animation(request);
  if (!animation) return;
  std::vector<int> outside;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(outside),
               [&](int frame) { return frame < animation->first_frame || frame > animation->last_frame; });
  if (!outside.empty())
    print_warning(
        fmt::format("{} outside of the scene's frames, {} to {}: what moves is taken beyond them as "
                    "it is written",
                    outside.size() == 1 ? fmt::format("frame {} is", outside[0])
                                        : fmt::format("frames {} are", frames_text(outside)),
                    animation->first_frame, animation->last_frame));
}

}  // namespace tyndall::tools
