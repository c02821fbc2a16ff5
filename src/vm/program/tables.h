// What programs look up in: shared data that travels with them and never changes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/plane.h"
#include "base/voxels.h"

namespace tyndall::vm {

// Instruction::immediate counts in one of the lists: OpTrait says in which.
struct Tables {
  std::vector<PlanePointer> planes;   // of images
  std::vector<VoxelsPointer> voxels;  // of grids
};

// Where an entry stands in a list, at its end when it was not there.
template <class T>
std::uint32_t index_in(std::vector<T>& list, const T& entry) {
  const auto known = std::find(list.begin(), list.end(), entry);
  const auto index = static_cast<std::uint32_t>(known - list.begin());
  if (known == list.end()) list.push_back(entry);
  return index;
}

}  // namespace tyndall::vm
