#include "import/gltf/component.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace tyndall::gltf {

namespace {

template <class T>
T stored(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

// glTF 2.0, 3.11: the lowest number counts as -1 too.
template <class T>
float number(const std::byte* from, bool normalized) {
  const auto value = static_cast<float>(stored<T>(from));
  if constexpr (std::is_floating_point_v<T>) return value;
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

}  // namespace

Component component_of(const Element& type) {
  switch (type.count()) {
    case 5120:
      return {Component::Type::int8, 1};
    case 5121:
      return {Component::Type::uint8, 1};
    case 5122:
      return {Component::Type::int16, 2};
    case 5123:
      return {Component::Type::uint16, 2};
    case 5125:
      return {Component::Type::uint32, 4};
    case 5126:
      return {Component::Type::float32, 4};
  }
  type.fail(fmt::format("is {}, which is none of glTF's", type.count()));
}

float Component::read(const std::byte* from, bool normalized) const {
  switch (type) {
    case Type::int8:
      return number<std::int8_t>(from, normalized);
    case Type::uint8:
      return number<std::uint8_t>(from, normalized);
    case Type::int16:
      return number<std::int16_t>(from, normalized);
    case Type::uint16:
      return number<std::uint16_t>(from, normalized);
    case Type::uint32:
      return number<std::uint32_t>(from, normalized);
    case Type::float32:
      return number<float>(from, normalized);
  }
  return 0;
}

std::uint32_t Component::read_count(const std::byte* from) const {
  switch (type) {
    case Type::uint8:
      return stored<std::uint8_t>(from);
    case Type::uint16:
      return stored<std::uint16_t>(from);
    case Type::uint32:
      return stored<std::uint32_t>(from);
    case Type::int8:
    case Type::int16:
    case Type::float32:
      break;
  }
  return 0;
}

}  // namespace tyndall::gltf
