// Grids of NanoVDB files, read by our own code: nano_directory.cpp their list, nano.cpp, in the module, one
// of them.
#pragma once

#include <string>

#include "import/vdb/vdb.h"

namespace tyndall::import {

// As list_grids, of a file that is_nano_file.
bool is_nano_file(const std::string& path);
GridList list_nano_grids(const std::string& path);

// As VdbModule::read.
GridResult read_nano(const std::string& path, const GridEntry& entry, std::uint64_t most_bytes,
                     const GridUse& use);

// "smoke.vdb density"
inline std::string listed_name(const std::string& path, const GridEntry& entry) {
  return path.substr(path.find_last_of('/') + 1) + " " + entry.name;
}

}  // namespace tyndall::import
