// Float images with named channels; reading and writing through OpenImageIO (in one .cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tyndall::image {

// Row by row from the top, channels interleaved.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  // "R", "G", "B", …
  std::vector<float> pixels;          // width * height * channels.size()
  // When these pixels are a part of a larger picture that is black elsewhere: where their top left one is in
  // it, and its size; of no width otherwise.
  struct Place {
    int x = 0, y = 0, whole_width = 0, whole_height = 0;
  };
  Place place{};

  float& at(int x, int y, std::size_t channel) { return pixels[index(x, y, channel)]; }
  float at(int x, int y, std::size_t channel) const { return pixels[index(x, y, channel)]; }
  std::size_t index(int x, int y, std::size_t channel) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               channels.size() +
           channel;
  }
};

// An image's place in the whole picture; of one that is no part: all of it.
inline Image::Place whole_of(const Image& image) {
  return image.place.whole_width > 0 ? image.place : Image::Place{0, 0, image.width, image.height};
}

// Text attributes of an EXR or PNG, in order: program version, scene hash, frame, samples, seed, settings.
using Metadata = std::vector<std::pair<std::string, std::string>>;

// Writes `path` whole or not at all (beside, then renamed). EXR: linear float, values as they are; PNG: 8-bit
// sRGB of the values times 2^exposure, clamped, with 0 for NaN. A part of a larger picture is written as that
// whole picture: in an EXR as its data window, in a PNG with the black around it. The format follows the
// extension. Returns an error message fit for the user, or an empty string.
std::string write(const std::string& path, const Image& image, const Metadata& metadata, double exposure = 0);

// A message when `write` to that path would surely fail (unknown extension, no such directory, not writable):
// asked before rendering starts.
std::string check_writable(const std::string& path);

struct ReadResult {
  std::optional<Image> image{};
  Metadata metadata{};
  std::string error{};  // fit for the user; empty when there is an image
};
// Reads an EXR as it is and a PNG as the linear light of its sRGB values.
ReadResult read(const std::string& path);

// One channel of a picture, row by row from the top.
struct ReadPlane {
  std::size_t channel = 0;
  std::vector<float> texels;
};
struct PlanesResult {
  int width = 0, height = 0;
  std::vector<std::string> channels{};  // all that the file has
  std::vector<ReadPlane> planes{};      // none when what was asked for is not there, or after an error
  std::string error{};                  // fit for the user
};
// Reads the colour of a picture of any kind for lookups (its R, G and B, or what stands for them; one plane
// where they are one channel), or the channel of that name, whatever its case. Numbers stored as whole ones
// (8 or 16 bits) are taken for sRGB and made linear, floating-point ones are linear already, alpha is left
// apart from the colours. The picture is the file's display window, black where nothing is stored. An error
// when it would take more than `most_bytes`, before they are taken.
PlanesResult read_planes(const std::string& path, const std::string& channel, std::uint64_t most_bytes);

}  // namespace tyndall::image
