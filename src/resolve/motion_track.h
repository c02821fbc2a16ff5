// One thing's way while the shutter is open: the moments that it is known at, and those at which it must be
// looked at next.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "base/interval.h"
#include "resolve/motion_error.h"
#include "scene/scene.h"

namespace tyndall::resolve {

// The moments between two others at which a guess between them is tested. Their distances have no simple
// part in common, so that nothing that comes round again is caught in the same place each time.
std::array<double, 2> tests_between(double a, double b);

template <class T>
class Track {
 public:
  // Of the thing of this index, known at these moments, 0 and 1 among them: it is tested between 0 and 1 at
  // the others.
  Track(std::uint32_t index, std::map<double, T> known, const Balls& balls);

  std::uint32_t index() const { return index_; }
  const std::set<double>& wanted() const { return wanted_; }
  void look(double moment, const T& thing, const Balls& balls);
  // Once it was looked at at all wanted moments: keeps what is known where a guess is too far off, and wants
  // more there.
  void decide(const Balls& balls);
  // How far off guesses are, in what is near enough, where more is wanted or the way jumps all the time; 0
  // when all are near enough.
  double error() const { return wanted_.empty() && jumping_ <= most_jumping ? 0 : error_; }

  scene::Moving<T> result() const;
  const T& first() const { return known_.begin()->second; }

 private:
  void find_pivots(const Balls& balls);
  scene::Moving<T> way(const std::vector<double>& moments, bool straight) const;
  double error_between(double a, double b, bool straight, const Balls& balls) const;
  void split(double a, double b);

  std::uint32_t index_;
  std::map<double, T> known_;
  Range<T> range_;
  std::vector<Vec3d> pivots_;
  bool straight_ = false;
  std::set<double> keys_{0, 1};
  std::vector<Intervald> open_;
  std::set<double> wanted_;
  double error_ = 0;    // the largest of the last guesses that were too far off
  double jumping_ = 0;  // the time in which it jumps
  static constexpr double most_jumping = 1.0 / 64;
};

}  // namespace tyndall::resolve
