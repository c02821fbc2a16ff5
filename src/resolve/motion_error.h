// How far a thing that is guessed between two moments is off from how it is.
#pragma once

#include <array>
#include <vector>

#include "base/interval.h"
#include "scene/scene.h"

namespace tyndall::resolve {

// Around a thing, in its own space. What reaches to infinity has one of 1 m.
struct Ball {
  Vec3d center;
  double radius = 1;
};

// The balls of a scene's shapes and prototypes.
class Balls {
 public:
  explicit Balls(const scene::Scene& scene);
  Ball of(const scene::Shape& shape) const;
  const Ball& of(scene::PrototypeId prototype) const { return prototypes_[prototype.index]; }

 private:
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
  // 4000th of the box that it and its like go through, and a 50th of the thing's size; for every other number
  // a 4000th of what it ranges over; for where a camera stands and looks a 4000th of the distance between the
  // two. Always what rounding makes of either.
  double deviation(const T& truth, const T& guess, const Balls& balls) const;

 private:
  std::vector<Intervald> numbers_;               // both ends included
  std::vector<std::array<Intervald, 3>> boxes_;  // of each transform's marks, in the world
};

}  // namespace tyndall::resolve
