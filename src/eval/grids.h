// Grids as values: how the evaluator asks for files of voxels without knowing how they are found and read.
#pragma once

#include <cstdint>
#include <string>

#include "base/source.h"
#include "base/voxels.h"

namespace tyndall::eval {

// How a grid is looked up between its voxels; the cubic one is a B-spline, which smooths.
enum class Filter : std::uint8_t { nearest, linear, cubic };

// What `grid("smoke.vdb", "density")` gives: one that is read when something first looks it up.
struct Grid {
  std::string path, name;
  Filter filter = Filter::linear;
  // The grid of the same file that carries it along while the shutter is open, if there is one, and the
  // greatest speed that counts [units of the file a second]; 0: what that grid's others make likely.
  std::string velocity{};
  double max_speed = 0;
  Span span;  // of the call of `grid`
};
// What `bounds(smoke)` gives: a box around all of it that is not background.
struct GridBounds {
  Grid grid;
};

// What a grid is to hold: anything that can be looked up, or vecs.
enum class Holding : std::uint8_t { any, vecs };

// Where something looks a grid up: at a medium's own p, elsewhere in a body, or at a place in a scene.
enum class LookedUpAt : std::uint8_t { p, elsewhere, known };

// Given by whoever runs the evaluator. Both report their errors: at the places of the names, and at the
// grid's.
class GridReader {
 public:
  virtual ~GridReader() = default;
  // The path of a file that has a grid of that name, in one of the types that can be read; empty after an
  // error.
  virtual std::string find(const std::string& file, Span file_span, const std::string& name, Span name_span,
                           Holding holding) = 0;
  // Null after an error.
  virtual VoxelGridPointer read(const Grid& grid, LookedUpAt place) = 0;
  // The grid that carries this one, its speeds limited; null after an error.
  virtual VoxelGridPointer read_velocity(const Grid& grid) = 0;
};

}  // namespace tyndall::eval
