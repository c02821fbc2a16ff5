// One frame of a scene: read, compiled, rendered and written, with what is told of it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/exit_status.h"
#include "tools/files_in_use.h"
#include "tools/frame_source.h"
#include "tools/render_arguments.h"
#include "tools/sequence_progress.h"

namespace tyndall::tools {

struct FrameOutcome {
  ExitStatus status = ExitStatus::problem;
  nlohmann::json report;    // for --json; null: it has printed what is to be said
  bool is_skipped = false;  // it was there already
  bool ends_all = false;    // no other frame can be better: misuse of the command line, a full disk
};

// What a frame is rendered with besides its arguments.
struct FrameSetting {
  FrameSource& source;
  FilesInUse& files;  // holds the outputs, which no file of the scene may be
  SequenceProgress* sequence = nullptr;
};

// Renders the frame that the arguments say, or replays a sample of it, and tells of all problems.
FrameOutcome render_frame(const RenderArguments& arguments, const FrameSetting& setting);

// What the renderer is asked for.
render::RenderOptions render_options_of(const RenderArguments& arguments);

// Tells of an error that has no place in a scene.
FrameOutcome failed_frame(const std::string& message);

}  // namespace tyndall::tools
