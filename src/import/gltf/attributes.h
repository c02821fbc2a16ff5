// The attributes of a primitive's points, from accessors or unpacked by Draco. All throw Malformed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "import/gltf/document.h"

namespace tyndall::gltf {

// What Draco made of a primitive.
struct Unpacked {
  struct Values {
    int width = 0;
    std::vector<float> numbers;
  };
  std::map<std::string, Values> attributes;
  std::vector<std::uint32_t> indices;
};
// draco.cpp: `extension` is the primitive's KHR_draco_mesh_compression.
Unpacked unpacked_draco(Document& document, const Element& extension);

class Attributes {
 public:
  Attributes(Document& document, const Element& primitive);

  bool has(const std::string& name) const;
  // The numbers of an attribute, `width` a point; empty where there is none. It must have as many points as
  // POSITION.
  std::vector<float> read(const std::string& name, int width);
  // COLOR_0 has three or four; the fourth is 1 where it is not there.
  std::vector<float> read_colors();
  std::vector<std::uint32_t> read_joints(const std::string& name);
  std::size_t points() const { return points_; }
  // The indices as stored; nothing when the points are taken in order.
  std::optional<std::vector<std::uint32_t>> indices();

 private:
  std::uint32_t accessor(const std::string& name) const;

  Document& document_;
  Element primitive_, attributes_;
  std::optional<Unpacked> unpacked_;
  std::size_t points_ = 0;
};

}  // namespace tyndall::gltf
