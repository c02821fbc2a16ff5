// The pictures of a file's materials, decoded when a material first looks them up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/plane.h"
#include "image/image.h"

namespace tyndall::pbr {

class Textures {
 public:
  // The bytes of a picture as stored, and its name for messages; it may throw Malformed.
  struct Stored {
    std::span<const std::byte> bytes;
    std::string name;
  };
  explicit Textures(std::function<Stored(std::uint32_t image)> stored) : stored_(std::move(stored)) {}

  // Red, green, blue and opacity of a picture, linear; null where it has none. Throws Malformed.
  using Channels = std::array<PlanePointer, 4>;
  const Channels& channels(std::uint32_t image, image::Encoding encoding);

 private:
  static constexpr std::uint64_t most_bytes = std::uint64_t{4} << 30;
  std::function<Stored(std::uint32_t)> stored_;
  std::map<std::pair<std::uint32_t, image::Encoding>, Channels> known_;
  std::uint64_t bytes_left_ = most_bytes;
};

}  // namespace tyndall::pbr
