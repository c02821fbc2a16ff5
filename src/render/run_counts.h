// What is counted in a render, summed over its threads and over the runs that it took.
#pragma once

#include "base/bytes.h"
#include "compile/compiled_scene.h"
#include "render/context/bad_values.h"
#include "render/context/statistics.h"
#include "render/context/thread_context.h"

namespace tyndall::render {

struct RunCounts {
  Statistics sums;  // cut_throughput is a sum, too
  BadValueCounts bad_values;

  // Adds what a thread counted.
  void add(const ThreadContext& thread, const compile::CompiledScene& world);
  // The statistics of the whole: means where they are means, bad values with their places.
  Statistics finished(const compile::CompiledScene& world) const;
  // As bytes, and back: false when they are not of this scene. What was run of each shader is left out.
  void save(ByteWriter& out) const;
  bool restore(ByteReader& in, const compile::CompiledScene& world);
};

}  // namespace tyndall::render
