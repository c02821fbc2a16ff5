// The component types of accessors.
#pragma once

#include <cstddef>
#include <cstdint>

#include "import/gltf/json.h"

namespace tyndall::gltf {

struct Component {
  enum class Type : std::uint8_t { int8, uint8, int16, uint16, uint32, float32 } type{};
  std::size_t bytes = 0;

  // Whether it may be an index.
  bool is_count() const { return type == Type::uint8 || type == Type::uint16 || type == Type::uint32; }
  // Normalised ones are in [0, 1] or [-1, 1].
  float read(const std::byte* from, bool normalized) const;
  std::uint32_t read_count(const std::byte* from) const;  // of counts only
};

// Of a `componentType`. Throws Malformed.
Component component_of(const Element& type);

}  // namespace tyndall::gltf
