// Where the time of shaders goes, by lines of the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/source.h"
#include "vm/program/program.h"

namespace tyndall::tools {

// A program and how many lanes each instruction of its lane code was run for.
struct ProgramLanes {
  std::string shader;  // "medium cloud"
  const vm::Program* program = nullptr;
  std::vector<std::uint64_t> lanes;
};

// For every shader the share of each source line in the time of all shaders: instructions times lanes, each
// by the cost of its operation (vm/program/op.h). Programs of one shader are added up.
std::string profile_text(const std::vector<ProgramLanes>& programs, const Sources& sources);

}  // namespace tyndall::tools
