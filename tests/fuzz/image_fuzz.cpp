// Any bytes as a picture: as a file of any format, and as a texture in memory. An error, or whole planes.
#include "base/check.h"
#include "file.h"
#include "image/image.h"

namespace {

using namespace tyndall;

void check_planes(const image::PlanesResult& read) {
  if (!read.error.empty()) {
    CHECK(read.planes.empty());
    return;
  }
  for (const image::ReadPlane& plane : read.planes) {
    CHECK_LT(plane.channel, read.channels.size());
    CHECK_EQ(plane.texels.size(),
             static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t most = std::uint64_t{64} << 20;
  check_planes(image::read_texture(std::as_bytes(std::span(data, size)), image::Encoding::srgb, most));
  const fuzz::File file(data, size);
  if (file.whole()) check_planes(image::read_planes(file.path(), "", most));
  return 0;
}
