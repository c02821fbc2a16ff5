// `tyndall inspect --medium … --slice …` and `--profile`: looking at what shaders compute, and at what cost.
#pragma once

#include <string>

#include "tools/exit_status.h"
#include "tools/load.h"

namespace tyndall::tools {

struct LookArguments {
  std::string medium, slice, show, output;
  bool profile = false;

  bool wanted() const {
    return profile || !medium.empty() || !slice.empty() || !show.empty() || !output.empty();
  }
};

void add_look_options(CLI::App& command, LookArguments& arguments);
ExitStatus look(const SceneRequest& request, const LookArguments& arguments);

}  // namespace tyndall::tools
