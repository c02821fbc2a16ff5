#include "image/layers.h"

#include <algorithm>
#include <cstddef>

#include "base/check.h"
#include "image/colors.h"

namespace tyndall::image {
namespace {

// Of one letter, such as the R of "albedo.R", is a component; "depth" is a layer of itself.
std::string layer_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  const std::size_t last = dot == std::string::npos ? 0 : dot + 1;
  if (channel.size() - last > 1) return channel;
  return last == 0 ? "" : channel.substr(0, dot);
}

}  // namespace

std::vector<Layer> common_layers(const Image& a, const Image& b) {
  std::vector<Layer> layers;
  for (const std::string& channel : a.channels) {
    if (find_channel(b.channels, channel) == b.channels.size()) continue;
    const std::string name = layer_of(channel);
    auto layer =
        std::find_if(layers.begin(), layers.end(), [&](const Layer& other) { return other.name == name; });
    if (layer == layers.end()) layer = layers.insert(layers.end(), {name, {}});
    layer->channels.push_back(channel);
  }
  return layers;
}

Image with_channels(const Image& image, const std::vector<std::string>& channels) {
  std::vector<std::size_t> chosen;
  for (const std::string& channel : channels) {
    chosen.push_back(find_channel(image.channels, channel));
    CHECK_LT(chosen.back(), image.channels.size());
  }
  Image out{image.width, image.height, channels, {}, image.place};
  out.pixels.reserve(out.index(0, out.height, 0));
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
    for (const std::size_t channel : chosen) out.pixels.push_back(image.pixels[i + channel]);
  return out;
}

}  // namespace tyndall::image
