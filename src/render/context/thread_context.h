// What one thread runs shaders with, and what it counts meanwhile.
#pragma once

#include "render/context/bad_values.h"
#include "render/context/statistics.h"
#include "vm/run/machine.h"

namespace tyndall::render {

struct ThreadContext {
  vm::Machine machine;
  Statistics statistics;
  BadValueCounts bad_values;
  bool skips_empty = true;  // leaves out what is proven to be empty
};

}  // namespace tyndall::render
