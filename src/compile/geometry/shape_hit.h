// Hits of shapes, and where a search for them goes on.
#pragma once

#include <cstdint>
#include <limits>

#include "scene/scene.h"
#include "shapes/query.h"

namespace tyndall::compile {

using shapes::Bounds;
using shapes::ShapeHit;

// Where a search for hits begins: behind t, and at t itself with parts after this one.
struct After {
  double t = 0;
  std::uint32_t part = std::numeric_limits<std::uint32_t>::max();

  bool before(double hit_t, std::uint32_t hit_part) const {
    return t < hit_t || (t == hit_t && part < hit_part);
  }
};

}  // namespace tyndall::compile
