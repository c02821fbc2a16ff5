// Float images with named channels; reading and writing through OpenImageIO (in one .cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/rows.h"
#include "image/view.h"

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

// Text attributes of a picture, in order: program version, scene hash, frame, samples, seed, settings.
using Metadata = std::vector<std::pair<std::string, std::string>>;

// Writes `path` whole or not at all (beside, then renamed). The format follows the extension. EXR: linear
// float, values as they are, the view in its metadata. PNG and JPEG: 8 bits of sRGB, TIFF: 16 bits, of what
// the view shows (develop.h). A part of a larger picture is written as that whole picture: in an EXR as its
// data window, in others with the black around it. Returns an error message fit for the user, or an empty
// string.
std::string write(const std::string& path, const Image& image, const Metadata& metadata,
                  const View& view = View::of_numbers());

// What `write` would write to a .png, in memory. An error message, or an empty string.
std::string encode_png(const Image& image, const View& view, std::vector<unsigned char>& bytes);

// Gives an EXR other metadata and another view, and leaves its pixels as they are.
std::string retell(const std::string& path, const Metadata& metadata, const View& view);

// IEC 61966-2-1, of a value in [0, 1].
float linear_from_srgb(float srgb);

// Three bytes a pixel, row by row from the top: what a PNG of the whole picture shows of its R, G and B, or
// of its first channel where it has not all three.
std::vector<std::uint8_t> display_rgb(const Image& image, const View& view);

// The picture in another size [pixels], filtered; or an error message fit for the user.
std::string resize(const Image& image, int width, int height, Image& resized);
// Writes a line of light text into the middle of a part of an image of R, G and B, as large as fits: the part
// is at x, y and of its whole_width and whole_height. An error message fit for the user, or an empty string.
std::string draw_text(Image& image, const std::string& text, const Image::Place& part);

// A message when `write` to that path would surely fail (unknown extension, no such directory, not writable):
// asked before rendering starts.
std::string check_writable(const std::string& path);

struct ReadResult {
  std::optional<Image> image{};
  Metadata metadata{};
  View view = View::of_numbers();  // with which it is to be shown
  std::string error{};             // fit for the user; empty when there is an image
};
// Reads an EXR as it is, and others as the linear light of their sRGB values. The view is the one that an EXR
// of ours tells; of another program's the usual one; of what was developed already, its numbers.
ReadResult read(const std::string& path);
// Reads its metadata alone, no pixels.
ReadResult read_metadata(const std::string& path);

// What the numbers of a picture are, in place of what its file says.
enum class Encoding : std::uint8_t { srgb, linear };

// Reads the colour of a picture of any kind for lookups (its R, G and B, or what stands for them; one channel
// where they are one), or the channel of that name, whatever its case. Where the file does not tell how its
// numbers stand for light, whole ones (8 or 16 bits) are sRGB's and floating-point ones linear; what the
// taker gets is linear, alpha left apart from the colours. The picture is the file's display window, black
// where nothing is stored. Returns an error message fit for the user, or an empty string.
std::string read_rows(const std::string& path, const std::string& channel, std::optional<Encoding> encoding,
                      RowTaker& taker);
// Reads all channels of a PNG, JPEG or WebP picture in memory: colours made linear where they are sRGB, alpha
// as it is and apart from the colours. Errors are as the rest of a sentence.
std::string read_rows(std::span<const std::byte> bytes, Encoding encoding, RowTaker& taker);

// One channel of a picture, row by row from the top.
struct ReadPlane {
  std::size_t channel = 0;
  std::vector<float> texels;
};
struct PlanesResult {
  int width = 0, height = 0;
  std::vector<std::string> channels{};  // all that the file has
  std::vector<ReadPlane> planes{};      // none when what was asked for is not there, or after an error
  std::string error{};
};
// What read_rows reads, kept in memory. An error when that would take more than `most_bytes`, before they are
// taken.
PlanesResult read_planes(const std::string& path, const std::string& channel, std::uint64_t most_bytes);
PlanesResult read_texture(std::span<const std::byte> bytes, Encoding encoding, std::uint64_t most_bytes);

}  // namespace tyndall::image
