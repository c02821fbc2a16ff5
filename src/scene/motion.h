// What moves while the shutter is open: things as they are at even moments from when it opens to when it
// closes, both included. Between two moments every number of a thing goes evenly from one to the other.
// A still scene has none of this.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tyndall::scene {

// The thing of this index, of the list that it stands in. At least two keys.
template <class T>
struct Moving {
  std::uint32_t index = 0;
  std::vector<T> keys;
};

// Part way from a to b, 0 to 1. Both must be things of one kind with the same parts.
template <class T>
T between(const T& a, const T& b, double part);
// All numbers that may move: equal lists, equal places.
template <class T>
std::vector<double> moving_numbers(const T& thing);

// The thing at a moment, as a fraction of the time that the shutter is open.
template <class T>
T at(const std::vector<T>& keys, double fraction) {
  const double place = fraction * static_cast<double>(keys.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(place), keys.size() - 2);
  return between(keys[before], keys[before + 1], place - static_cast<double>(before));
}

}  // namespace tyndall::scene
