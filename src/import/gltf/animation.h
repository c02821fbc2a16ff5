// Animations: what they make of the nodes' poses at a time. All throw Malformed.
#pragma once

#include <cstdint>
#include <vector>

#include "import/gltf/document.h"
#include "import/gltf/hierarchy.h"

namespace tyndall::gltf {

class Animation {
 public:
  Animation(Document& document, std::uint32_t index);

  // When its last key stands [s].
  double duration() const { return duration_; }
  // Whether it moves a node's mesh in its morph targets.
  bool weighs(std::uint32_t node) const;
  // Sets what it moves of the poses. Before the first key and after the last one it holds them.
  void apply(double seconds, std::vector<NodePose>& poses) const;

 private:
  enum class Path : std::uint8_t { translation, rotation, scale, weights };
  enum class Interpolation : std::uint8_t { step, linear, cubic };
  struct Channel {
    std::uint32_t node = 0;
    Path path{};
    Interpolation interpolation{};
    std::size_t width = 0;      // numbers of a value
    std::vector<float> times;   // rising
    std::vector<float> values;  // of each time, for cubic ones with the tangents before and after
    std::vector<double> at(double seconds) const;
  };
  Channel channel_of(Document& document, const Element& animation, const Element& channel,
                     const Element& target);

  std::vector<Channel> channels_;
  double duration_ = 0;
};

}  // namespace tyndall::gltf
