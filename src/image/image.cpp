#include "image/image.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>

#include "image/codec.h"
#include "image/files.h"

namespace tyndall::image {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::optional<Format> format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".exr") return Format::exr;
  if (extension == ".png") return Format::png;
  return std::nullopt;
}

std::string unknown_format(const std::string& path) {
  const std::string extension = extension_of(path);
  return fmt::format(
      "'{}' {}: pictures are .exr or .png", path,
      extension.empty() ? "has no extension" : fmt::format("has the unknown extension '{}'", extension));
}

// The module around OpenImageIO, found beside the program by its run path; null with a reason when it is not
// there.
struct LoadedCodec {
  const Codec* codec = nullptr;
  std::string problem;
};
const LoadedCodec& load_codec() {
  static const LoadedCodec loaded = [] {
    LoadedCodec result;
    void* module = ::dlopen(TYNDALL_CODEC_FILE, RTLD_NOW | RTLD_LOCAL);
    if (module != nullptr) result.codec = static_cast<const Codec*>(::dlsym(module, codec_symbol));
    if (result.codec == nullptr) result.problem = ::dlerror();
    return result;
  }();
  return loaded;
}

// IEC 61966-2-1, of a value in [0, 1].
float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}
float linear_from_srgb(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

void make_linear(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (image.channels[i % image.channels.size()] != "A") image.pixels[i] = linear_from_srgb(image.pixels[i]);
}

// Whether two channels are called alike, whatever the case.
bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

// What read_planes reads; `wish` is its channel.
std::vector<std::size_t> chosen_channels(const std::vector<std::string>& channels, const void* wish) {
  const auto find = [&](std::string_view name) {
    std::size_t i = 0;
    while (i < channels.size() && !same_name(channels[i], name)) ++i;
    return i;
  };
  const std::size_t none = channels.size();
  const auto& name = *static_cast<const std::string*>(wish);
  if (!name.empty()) return find(name) == none ? std::vector<std::size_t>{} : std::vector{find(name)};
  const std::size_t r = find("R"), g = find("G"), b = find("B");
  if (r != none && g != none && b != none) return {r, g, b};
  if (channels.size() < 3) return {0};
  return {0, 1, 2};
}

std::uint8_t display_byte(float exposed) {
  if (std::isnan(exposed)) return 0;
  return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(std::clamp(exposed, 0.0f, 1.0f))));
}

// Of the whole picture that the image is (a part of).
std::vector<std::uint8_t> display_bytes(const Image& image, double exposure) {
  const auto scale = static_cast<float>(std::exp2(exposure));
  const Image::Place place = whole_of(image);
  const std::size_t channels = image.channels.size(),
                    row = static_cast<std::size_t>(place.whole_width) * channels,
                    part = static_cast<std::size_t>(image.width) * channels;
  std::vector<std::uint8_t> bytes(row * static_cast<std::size_t>(place.whole_height));
  for (int y = 0; y < image.height; ++y) {
    const auto from = image.pixels.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * part);
    const auto to = bytes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y + place.y) * row +
                                                                static_cast<std::size_t>(place.x) * channels);
    std::transform(from, from + static_cast<std::ptrdiff_t>(part), to,
                   [scale](float value) { return display_byte(value * scale); });
  }
  return bytes;
}

}  // namespace

std::string write(const std::string& path, const Image& image, const Metadata& metadata, double exposure) {
  const std::optional<Format> format = format_of(path);
  if (!format) return unknown_format(path);
  const LoadedCodec& loaded = load_codec();
  std::string problem = loaded.problem;
  std::vector<unsigned char> bytes;
  if (problem.empty()) {
    std::vector<std::uint8_t> display;
    if (*format == Format::png) display = display_bytes(image, exposure);
    problem = loaded.codec->encode(image, display, metadata, *format, bytes);
  }
  if (!problem.empty()) return fmt::format("cannot write '{}': {}", path, problem);
  return write_file_whole(path, std::as_bytes(std::span(bytes)));
}

std::string check_writable(const std::string& path) {
  if (!format_of(path)) return unknown_format(path);
  return check_file_writable(path);
}

ReadResult read(const std::string& path) {
  const std::optional<Format> format = format_of(path);
  if (!format) return {.error = unknown_format(path)};
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return {.error = fmt::format("cannot read '{}': it is a directory", path)};
  if (!std::filesystem::exists(path, ignored))
    return {.error = fmt::format("cannot read '{}': no such file", path)};

  const LoadedCodec& loaded = load_codec();
  ReadResult result =
      loaded.codec != nullptr ? loaded.codec->decode(path) : ReadResult{.error = loaded.problem};
  if (!result.image) return {.error = fmt::format("cannot read '{}': {}", path, result.error)};
  if (*format == Format::png) make_linear(*result.image);
  return result;
}

PlanesResult read_planes(const std::string& path, const std::string& channel, std::uint64_t most_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return {.error = fmt::format("cannot read '{}': it is a directory", path)};
  if (!std::filesystem::exists(path, ignored))
    return {.error = fmt::format("cannot read '{}': no such file", path)};
  const LoadedCodec& loaded = load_codec();
  bool encoded = false;
  PlanesResult result = loaded.codec != nullptr ? loaded.codec->decode_planes(path, chosen_channels, &channel,
                                                                              most_bytes, encoded)
                                                : PlanesResult{.error = loaded.problem};
  if (!result.error.empty()) return {.error = fmt::format("cannot read '{}': {}", path, result.error)};
  if (encoded)
    for (ReadPlane& plane : result.planes)
      if (!same_name(result.channels[plane.channel], "A"))
        for (float& texel : plane.texels) texel = linear_from_srgb(texel);
  return result;
}

}  // namespace tyndall::image
