// Pictures decoded in a process of their own.
//
// OpenImageIO reads some thirty formats. Most of their readers trust what a file says, and write beyond their
// memory, take all there is or do not end where it lies. Those that are not known to withstand broken files
// (kinds.h) run in a child process, with limits to its memory and time: whatever becomes of it is an error
// message here.
#pragma once

#include <functional>
#include <string>

#include "image/rows.h"

namespace tyndall::image {

// Calls `decode`, which gives an error message or nothing, in a child process; what its taker gets there,
// `taker` gets here.
std::string decode_apart(const std::function<std::string(RowTaker&)>& decode, RowTaker& taker);

}  // namespace tyndall::image
