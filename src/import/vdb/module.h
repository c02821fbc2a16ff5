// The grid of a file: what the module around OpenVDB does for vdb.cpp.
//
// OpenVDB brings a dozen shared libraries, so it lives in a module of its own that is loaded when the first
// grid is read, as OpenImageIO does (image/codec.h).
#pragma once

#include "import/vdb/vdb.h"

namespace tyndall::import {

struct VdbModule {
  // As read_grid, the error without the file's name.
  GridResult (*read)(const std::string& path, const GridEntry& entry, std::uint64_t most_bytes,
                     const GridUse& use);
};

// The name under which the module exports its `const VdbModule`.
inline constexpr const char* vdb_symbol = "tyndall_vdb";

}  // namespace tyndall::import
