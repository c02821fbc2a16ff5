#include "image/colors.h"

#include <algorithm>
#include <cctype>

namespace tyndall::image {

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::size_t find_channel(const std::vector<std::string>& channels, std::string_view name) {
  std::size_t i = 0;
  while (i < channels.size() && !same_name(channels[i], name)) ++i;
  return i;
}

ColorChannels color_channels(const std::vector<std::string>& channels) {
  const std::size_t none = channels.size(), r = find_channel(channels, "R"), g = find_channel(channels, "G"),
                    b = find_channel(channels, "B");
  if (r != none && g != none && b != none) return {{r, g, b}};
  if (channels.size() < 3) return {{0, 0, 0}};
  return {{0, 1, 2}};
}

}  // namespace tyndall::image
