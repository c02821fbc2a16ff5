// Which channels of a picture are its colours.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace tyndall::image {

// Whether two channels are called alike, whatever the case.
bool same_name(std::string_view a, std::string_view b);

// The index of a channel of that name, whatever its case; the number of channels where there is none.
std::size_t find_channel(const std::vector<std::string>& channels, std::string_view name);

// Where red, green and blue are; thrice the same in a picture without colours.
struct ColorChannels {
  std::array<std::size_t, 3> rgb{};

  bool is_grey() const { return rgb[0] == rgb[1]; }
  Rgb color(const float* pixel) const { return {pixel[rgb[0]], pixel[rgb[1]], pixel[rgb[2]]}; }
  void set_color(float* pixel, const Rgb& color) const {
    for (std::size_t i = 0; i < 3; ++i) pixel[rgb[i]] = color[i];
  }
};

// R, G and B, whatever their case; else the first three, or the first of fewer.
ColorChannels color_channels(const std::vector<std::string>& channels);

}  // namespace tyndall::image
