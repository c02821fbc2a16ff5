// Channels that belong together: "albedo.R", "albedo.G" and "albedo.B" are the layer "albedo".
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace tyndall::image {

struct Layer {
  std::string name;  // "" of the colours R, G and B (and of A, Y, …), "albedo", "depth"
  std::vector<std::string> channels;
};

// The layers of the channels that both pictures have, in the order of the first.
std::vector<Layer> common_layers(const Image& a, const Image& b);

// These channels alone, in this order; the picture has them all.
Image with_channels(const Image& image, const std::vector<std::string>& channels);

}  // namespace tyndall::image
