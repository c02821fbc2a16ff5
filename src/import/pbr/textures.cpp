#include "import/pbr/textures.h"

#include <fmt/format.h>

#include <algorithm>

#include "import/malformed.h"

namespace tyndall::pbr {

namespace {

PlanePointer plane_of(const image::PlanesResult& read, const std::string& name, image::ReadPlane plane) {
  const auto width = static_cast<std::ptrdiff_t>(read.width);
  for (std::ptrdiff_t low = 0, high = read.height - 1; low < high; ++low, --high)
    std::swap_ranges(plane.texels.begin() + low * width, plane.texels.begin() + (low + 1) * width,
                     plane.texels.begin() + high * width);
  return make_plane(fmt::format("{} {}", name, read.channels[plane.channel]), read.width, read.height,
                    std::move(plane.texels));
}

}  // namespace

const Textures::Channels& Textures::channels(std::uint32_t image, image::Encoding encoding) {
  const auto known = known_.find({image, encoding});
  if (known != known_.end()) return known->second;
  const Stored stored = stored_(image);
  image::PlanesResult read = image::read_texture(stored.bytes, encoding, bytes_left_);
  if (!read.error.empty()) throw Malformed{stored.name, read.error};
  for (const image::ReadPlane& plane : read.planes) bytes_left_ -= plane.texels.size() * sizeof(float);
  // Of one channel: grey. Of two: grey and opacity.
  const std::size_t count = read.planes.size();
  Channels out;
  if (count >= 3) {
    for (std::size_t k = 0; k < std::min<std::size_t>(count, 4); ++k)
      out[k] = plane_of(read, stored.name, std::move(read.planes[k]));
  } else {
    out[0] = out[1] = out[2] = plane_of(read, stored.name, std::move(read.planes[0]));
    if (count == 2) out[3] = plane_of(read, stored.name, std::move(read.planes[1]));
  }
  return known_[{image, encoding}] = std::move(out);
}

}  // namespace tyndall::pbr
