// One channel of a picture, kept for lookups: what a scene's images are made of.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/paged_texels.h"

namespace tyndall {

// Rows from the bottom, so that v runs up; linear values, all finite. Shared and never changed once made.
struct Plane {
  std::string name;  // "sky.hdr R", for listings
  int width = 0, height = 0;
  std::vector<float> texels;  // width * height; none where they are paged
  float lowest = 0, highest = 0;
  std::uint64_t hash = 0;  // of the size and the texels
  // Of a picture that is too large for memory, and which of its channels this is.
  std::shared_ptr<const PagedTexels> paged{};
  int channel = 0;

  std::uint64_t bytes() const { return texels.size() * sizeof(float); }
  float at(int x, int y) const {
    if (paged) return paged->at(x, y, channel);
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};
using PlanePointer = std::shared_ptr<const Plane>;
using ColorPlanes = std::array<PlanePointer, 3>;  // red, green, blue: of one size

// A plane of the given texels (any that are not finite become 0), its extremes and hash computed.
PlanePointer make_plane(std::string name, int width, int height, std::vector<float> texels);

// The extremes and the hash of texels that come one after another, in any order that stays the same.
class PlaneSummary {
 public:
  PlaneSummary(int width, int height);
  void add(float texel);
  void write_to(Plane& plane) const;

 private:
  float lowest_, highest_;
  std::uint64_t hash_;
};

}  // namespace tyndall
