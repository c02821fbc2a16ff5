// A plane through a medium: what `tyndall inspect --slice` looks at.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/geometry/shape_hit.h"
#include "image/image.h"
#include "scene/medium.h"

namespace tyndall::tools {

// "z=0.5": the points of the medium's space p where that coordinate has that value [m].
struct SlicePlane {
  int axis = 2;  // 0: x
  double at = 0;
};
std::optional<SlicePlane> parse_slice(const std::string& text);

// A medium inside its volume: where it is looked at, and how its other inputs follow from p.
struct MediumPlace {
  const scene::Medium* medium = nullptr;
  compile::Bounds box;  // of the volume, in the medium's space [m]
  Transform world_from_medium;
};

// The values of a program over the plane, seen from the tip of the axis: to the right x (for an x plane -z),
// upwards y (for a y plane -z).
struct Slice {
  std::string title;
  int width = 0, height = 0;
  double left = 0, right = 0, bottom = 0, top = 0;  // coordinates of the edges [m]
  char right_axis = 'x', up_axis = 'y';
  std::vector<std::vector<float>> components;  // row by row from the top

  float lowest = 0, highest = 0;  // of the values that are finite; 0 when there are none
  double mean = 0;
  std::size_t not_finite = 0;
};
Slice cut(const MediumPlace& place, const scene::Watched& watched, const std::string& name, double time,
          const SlicePlane& plane, int longest_side);

// The slice as a picture in false colours, a panel for each component, with the scale and its ends beside it.
image::Image picture_of(const Slice& slice);
// The numbers themselves, a channel for each component.
image::Image values_of(const Slice& slice, const std::string& name);

}  // namespace tyndall::tools
