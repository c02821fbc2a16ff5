// The poses that a deforming mesh, or strands, need to be blurred while the shutter is open.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "shapes/curves.h"
#include "shapes/mesh.h"

namespace tyndall {

// Never more poses after the first one than this, nor more points in all poses of a thing together.
inline constexpr std::size_t most_later_poses = 128, most_posed_points = std::size_t{1} << 23;

// What is left when poses go evenly from one to the next.
struct PoseError {
  double largest = 0;    // at most 1: nothing that is seen
  double off_share = 0;  // of the shutter's time, in which it is above 1
};

// Where `add_later_poses` looks first, besides the end: fractions of the time that the shutter is open.
inline constexpr std::array<double, 2> first_tests{0.2915026221, 0.6180339887};

// Gives a mesh as many later poses as its blur needs, evenly apart: none where nothing moves, one where all
// points go straight and evenly, twice as many until no point is off its way by more than a 4000th of the box
// that the mesh goes through and no normal by more than a fiftieth of its length. Strands likewise; of their
// radii none may be off by more than a fiftieth of the largest. `pose_at` tells the thing at a fraction of
// the time that the shutter is open; the thing itself is its pose at 0. `points`: of all things that share
// the limit of points.
PoseError add_later_poses(shapes::TriangleMesh& mesh,
                          const std::function<shapes::MeshPose(double fraction)>& pose_at,
                          std::size_t points = 0);
PoseError add_later_poses(shapes::StrandSet& strands,
                          const std::function<shapes::StrandPose(double fraction)>& pose_at,
                          std::size_t points = 0);

// What is told of a mesh that as many poses as there may be do not follow, after "has a mesh, 'Wheel'," or
// whatever `what` calls it; nothing where the error is not seen.
std::optional<std::string> uneven_motion(std::string_view what, const shapes::TriangleMesh& mesh,
                                         const PoseError& error);

}  // namespace tyndall
