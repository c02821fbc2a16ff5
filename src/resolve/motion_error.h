// How far a thing that is guessed between two moments is off from how it is.
#pragma once

#include <array>
#include <vector>

#include "base/interval.h"
#include "scene/scene.h"

namespace tyndall::resolve {

// Around a thing, in its own space. What reaches to infinity has one of 1 m.
using shapes::Ball;

// Where a scene is seen from when the shutter opens, and how large a pixel of its picture is there.
class Eye {
 public:
  explicit Eye(const scene::Scene& scene);
  // The way to the far end of a pixel from its near end at this distance [m].
  double pixel(double distance) const { return width_ + angle_ * distance; }
  // The least distance to a point of a box, whose sides these are.
  double distance(const std::array<Intervald, 3>& box) const;

 private:
  Vec3d at_;
  double width_ = 0, angle_ = 0;  // of parallel rays; at a distance of 1 m
};

// The balls of a scene's shapes and prototypes, and what they are seen from.
class Balls {
 public:
  explicit Balls(const scene::Scene& scene);
  const Eye& eye() const { return eye_; }
  Ball of(const scene::Shape& shape) const;
  const Ball& of(scene::PrototypeId prototype) const { return prototypes_[prototype.index]; }

 private:
  Eye eye_;
  std::vector<Ball> meshes_, strand_sets_, prototypes_;
};

// Four points that tell how a transform moves a thing, in the space that it is applied to: the middle of its
// ball, and the ends of three radii.
using Marks = std::array<Vec3d, 4>;
// Of each of the thing's transforms.
template <class T>
std::vector<Marks> marks(const T& thing, const Balls& balls);

// What a thing's numbers and marks range over while the shutter is open.
template <class T>
class Range {
 public:
  void add(const T& thing, const Balls& balls);
  // How far `guess` is off from `truth`, at most 1 when it is near enough. Near enough are for each mark a
  // 4000th of the box that it and its like go through, a 50th of the thing's size, and a tenth of a pixel
  // where it is nearest to the camera or, around the camera, a 40000th of the box; for numbers in metres
  // likewise of what they range over; for every other number a 4000th of that; for where a camera stands and
  // looks a 4000th of the distance between the two, and a tenth of a pixel there. Always what rounding makes
  // of either.
  double deviation(const T& truth, const T& guess, const Balls& balls) const;

 private:
  std::vector<Intervald> numbers_;               // both ends included
  std::vector<std::array<Intervald, 3>> boxes_;  // of each transform's marks, in the world
  std::array<Intervald, 3> seen_;                // around all of the thing that is seen
};

}  // namespace tyndall::resolve
