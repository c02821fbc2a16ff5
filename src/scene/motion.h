// What moves while the shutter is open: things as they are at some moments from when it opens to when it
// closes, both included. A still scene has none of this.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/transform_mix.h"

namespace tyndall::scene {

// The way of a transform that turns: from key to key its linear part is mixed as base/transform_mix.h has it,
// and one point, as seen from the thing, goes straight. So what turns evenly about a fixed axis, or about one
// that goes straight, is exact between any two keys less than half a turn apart.
struct Turning {
  Vec3d pivot;                               // that point, in the space that the transform is applied to
  std::vector<std::optional<Pose>> poses;    // at each key; nothing where it is flat
  std::vector<std::optional<PoseMix>> ways;  // from each key to the next; nothing where numbers go straight
};

// The thing of this index, of the list that it stands in. Between two keys every number goes evenly from one
// to the other, but for transforms that turn.
template <class T>
struct Moving {
  std::uint32_t index = 0;
  std::vector<T> keys;            // at least two
  std::vector<double> times;      // of the keys: rising from 0, when the shutter opens, to 1, when it closes
  std::vector<Turning> turnings;  // one for each transform of the thing; empty when none turns

  bool empty() const { return keys.empty(); }
};

// All numbers that may move: equal lists, equal places.
template <class T>
std::vector<double> moving_numbers(const T& thing);
// Those that are in no transform, with the error that they were computed with, and whether they are in
// metres.
struct MovingNumber {
  double value, rounding;
  bool in_metres = false;
};
template <class T>
std::vector<MovingNumber> plain_numbers(const T& thing);
// The thing's transforms, in the order of `turnings`.
template <class T>
std::vector<Transform> transforms_of(const T& thing);

// Lets what turns turn about the pivots, one for each transform. The keys are there already.
template <class T>
void set_turnings(Moving<T>& moving, const std::vector<Vec3d>& pivots);

// The thing at a moment, as a fraction of the time that the shutter is open.
template <class T>
T at(const Moving<T>& moving, double fraction);

// One transform of a thing alone, number `which` of transforms_of(): as at() has it, without the rest.
class MovingTransform {
 public:
  template <class T>
  MovingTransform(const Moving<T>& moving, std::size_t which);
  Transform at(double fraction) const;

 private:
  std::vector<double> times_;
  std::vector<Transform> keys_;
  std::optional<Turning> turning_;
};
// Whether anything of the thing moves but its transforms.
template <class T>
bool moves_within(const Moving<T>& moving);

// Moments from `lo` to `hi`, both included, that are close enough for bounds: between two neighbours plain
// numbers go straight, and a point p of a transform's space is nowhere farther from the straight line between
// its places at the two than bend() times its distance from the pivot.
template <class T>
std::vector<double> moments(const Moving<T>& moving, double lo = 0, double hi = 1);
template <class T>
double bend(const Moving<T>& moving, std::size_t transform);

}  // namespace tyndall::scene
