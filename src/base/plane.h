// One channel of a picture, kept for lookups: what a scene's images are made of.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tyndall {

// Rows from the bottom, so that v runs up; linear values, all finite. Shared and never changed once made.
struct Plane {
  std::string name;  // "sky.hdr R", for listings
  int width = 0, height = 0;
  std::vector<float> texels;  // width * height
  float lowest = 0, highest = 0;
  std::uint64_t hash = 0;  // of the size and the texels

  float at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};
using PlanePointer = std::shared_ptr<const Plane>;
using ColorPlanes = std::array<PlanePointer, 3>;  // red, green, blue: of one size

// A plane of the given texels (any that are not finite become 0), its extremes and hash computed.
PlanePointer make_plane(std::string name, int width, int height, std::vector<float> texels);

}  // namespace tyndall
