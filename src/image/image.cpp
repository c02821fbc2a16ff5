#include "image/image.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <span>

#include "image/apart.h"
#include "image/codec.h"
#include "image/colors.h"
#include "image/cut_short.h"
#include "image/develop.h"
#include "image/encoder.h"
#include "image/files.h"
#include "image/kinds.h"

namespace tyndall::image {
namespace {

// Of an EXR's metadata.
constexpr std::string_view exposure_entry = "tyndall:exposure", tonemap_entry = "tyndall:tonemap";

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
  if (extension == ".jpg" || extension == ".jpeg") return Format::jpeg;
  if (extension == ".tif" || extension == ".tiff") return Format::tiff;
  return std::nullopt;
}

std::string unknown_format(const std::string& path) {
  const std::string extension = extension_of(path);
  return fmt::format(
      "'{}' {}: pictures are .exr, .png, .jpg or .tif", path,
      extension.empty() ? "has no extension" : fmt::format("has the unknown extension '{}'", extension));
}

// What a module exports, found beside the program by its run path; null with a reason when it is not there.
template <class T>
struct Loaded {
  const T* functions = nullptr;
  std::string problem;
};
// The loader's own words tell of segments that could not be mapped, where memory has run out.
std::string why_not_loaded(std::string_view words) {
  for (const std::string_view of_memory : {"failed to map", "cannot map", "cannot allocate", "cannot create"})
    if (words.find(of_memory) != std::string_view::npos)
      return fmt::format("there is not enough memory for the library of picture formats ({})", words);
  return std::string(words);
}
template <class T>
Loaded<T> load_module(const char* file, const char* symbol) {
  Loaded<T> result;
  void* module = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (module != nullptr) result.functions = static_cast<const T*>(::dlsym(module, symbol));
  if (result.functions == nullptr) result.problem = why_not_loaded(::dlerror());
  return result;
}
const Loaded<Codec>& load_codec() {
  static const Loaded<Codec> loaded = load_module<Codec>(TYNDALL_CODEC_FILE, codec_symbol);
  return loaded;
}

// The bytes of a picture as it is to be in the file.
std::string encode(const Image& image, const Metadata& metadata, Format format,
                   std::vector<unsigned char>& bytes) {
  if (format == Format::jpeg || format == Format::tiff) {
    const Loaded<Codec>& codec = load_codec();
    return codec.functions ? codec.functions->encode(image, metadata, format, bytes) : codec.problem;
  }
  static const Loaded<Encoder> encoder = load_module<Encoder>(TYNDALL_ENCODER_FILE, encoder_symbol);
  if (!encoder.functions) return encoder.problem;
  return format == Format::exr ? encoder.functions->exr(image, metadata, bytes)
                               : encoder.functions->png(image, metadata, bytes);
}

void make_linear(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (image.channels[i % image.channels.size()] != "A") image.pixels[i] = linear_from_srgb(image.pixels[i]);
}

// Makes rows linear on their way.
class LinearRows final : public RowTaker {
 public:
  LinearRows(RowTaker& taker, std::optional<Encoding> encoding) : taker_(taker), encoding_(encoding) {}

  std::string begin(const PictureHeader& header) override {
    transfer_ = header.transfer;
    if (encoding_)
      transfer_ = {*encoding_ == Encoding::srgb ? Transfer::Curve::srgb : Transfer::Curve::linear, 1};
    for (const std::size_t channel : header.chosen)
      is_light_.push_back(!same_name(header.channels[channel], "A"));
    PictureHeader linear = header;
    linear.transfer = {};
    return taker_.begin(linear);
  }
  void row(std::span<const float> numbers) override {
    if (transfer_.curve == Transfer::Curve::linear) return taker_.row(numbers);
    linear_.assign(numbers.begin(), numbers.end());
    for (std::size_t i = 0; i < linear_.size(); ++i)
      if (is_light_[i % is_light_.size()]) linear_[i] = linear(linear_[i]);
    taker_.row(linear_);
  }

 private:
  float linear(float value) const {
    if (transfer_.curve == Transfer::Curve::srgb) return linear_from_srgb(value);
    return std::pow(std::max(value, 0.0f), static_cast<float>(transfer_.degree));
  }

  RowTaker& taker_;
  std::optional<Encoding> encoding_;
  Transfer transfer_;
  std::vector<bool> is_light_;
  std::vector<float> linear_;
};

// Keeps them.
class Planes final : public RowTaker {
 public:
  explicit Planes(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  std::string begin(const PictureHeader& header) override {
    result.width = header.width;
    result.height = header.height;
    result.channels = header.channels;
    pixels_ = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
    const double bytes = double(header.width) * header.height * static_cast<double>(header.chosen.size() * 4);
    if (bytes > static_cast<double>(most_bytes_))
      return fmt::format("its {} x {} pixels take {:.0f} MB of memory, and {} MB are left for pictures",
                         header.width, header.height, bytes / (1 << 20), most_bytes_ >> 20);
    for (const std::size_t channel : header.chosen) result.planes.push_back({channel, {}});
    return {};
  }
  // Memory is taken as rows come: a file may claim more than it holds.
  void row(std::span<const float> numbers) override {
    for (std::size_t k = 0; k < result.planes.size(); ++k) {
      std::vector<float>& texels = result.planes[k].texels;
      texels.reserve(pixels_);
      for (std::size_t i = k; i < numbers.size(); i += result.planes.size()) texels.push_back(numbers[i]);
    }
  }

  PlanesResult result;

 private:
  std::uint64_t most_bytes_;
  std::size_t pixels_ = 0;
};

PlanesResult kept(Planes& planes, std::string error) {
  if (!error.empty()) planes.result.planes.clear();
  planes.result.error = std::move(error);
  return std::move(planes.result);
}

// What read_rows reads; `wish` is its channel.
std::vector<std::size_t> chosen_channels(const std::vector<std::string>& channels, const void* wish) {
  const auto& name = *static_cast<const std::string*>(wish);
  if (!name.empty()) {
    const std::size_t found = find_channel(channels, name);
    return found == channels.size() ? std::vector<std::size_t>{} : std::vector{found};
  }
  const ColorChannels colors = color_channels(channels);
  if (colors.is_grey()) return {colors.rgb[0]};
  return {colors.rgb.begin(), colors.rgb.end()};
}

// A message when there is no plain file: pictures are read here and there in theirs, which no pipe allows,
// and a pipe that nothing writes to would never be open.
std::string no_plain_file(const std::string& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (std::filesystem::is_regular_file(status)) return {};
  // Such as a name that is too long, or a folder that may not be entered.
  if (failed && status.type() != std::filesystem::file_type::not_found)
    return fmt::format("cannot read '{}': {}", path, failed.message());
  const std::string_view why = !std::filesystem::exists(status)        ? "no such file"
                               : std::filesystem::is_directory(status) ? "it is a directory"
                                                                       : "it is no plain file";
  return fmt::format("cannot read '{}': {}", path, why);
}

std::string ends_too_early(const std::string& path) {
  return fmt::format("cannot read '{}': the file ends too early", path);
}

// What an EXR's metadata tell of its view.
void tell(Metadata& metadata, const View& view) {
  const View usual;
  if (view.exposure != usual.exposure)
    metadata.emplace_back(std::string(exposure_entry), describe(view.exposure));
  if (view.tonemap != usual.tonemap)
    metadata.emplace_back(std::string(tonemap_entry), std::string(describe(view.tonemap)));
}
View told_view(const Metadata& metadata) {
  View view;
  for (const auto& [name, value] : metadata) {
    if (name == exposure_entry) view.exposure = read_exposure(value).value_or(view.exposure);
    if (name == tonemap_entry) view.tonemap = read_tonemap(value).value_or(view.tonemap);
  }
  return view;
}

}  // namespace

float linear_from_srgb(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

std::string write(const std::string& path, const Image& image, const Metadata& metadata, const View& view) {
  const std::optional<Format> format = format_of(path);
  if (!format) return unknown_format(path);
  Metadata told = metadata;
  if (*format == Format::exr) tell(told, view);
  std::vector<unsigned char> bytes;
  const std::string problem = *format == Format::exr ? encode(image, told, *format, bytes)
                              : *format == Format::tiff
                                  ? encode(develop(image, view), told, *format, bytes)
                                  : encode(develop_in_8_bits(image, view), told, *format, bytes);
  if (!problem.empty()) return fmt::format("cannot write '{}': {}", path, problem);
  return write_file_whole(path, std::as_bytes(std::span(bytes)));
}

std::string encode_png(const Image& image, const View& view, std::vector<unsigned char>& bytes) {
  return encode(develop_in_8_bits(image, view), {}, Format::png, bytes);
}

std::string retell(const std::string& path, const Metadata& metadata, const View& view) {
  const Loaded<Codec>& loaded = load_codec();
  std::string problem = loaded.problem;
  std::vector<unsigned char> bytes;
  if (problem.empty()) {
    Metadata told = metadata;
    std::erase_if(told, [](const auto& entry) {
      return entry.first == exposure_entry || entry.first == tonemap_entry;
    });
    tell(told, view);
    problem = loaded.functions->retell({path, name_of(Format::exr)}, told, bytes);
  }
  if (!problem.empty()) return fmt::format("cannot write '{}': {}", path, problem);
  return write_file_whole(path, std::as_bytes(std::span(bytes)));
}

std::vector<std::uint8_t> display_rgb(const Image& image, const View& view) {
  const Image shown = develop_in_8_bits(image, view);
  const ColorChannels channels = color_channels(shown.channels);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(shown.pixels.size() / shown.channels.size() * 3);
  for (std::size_t i = 0; i < shown.pixels.size(); i += shown.channels.size())
    for (const std::size_t channel : channels.rgb)
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * shown.pixels[i + channel])));
  return bytes;
}

std::string resize(const Image& image, int width, int height, Image& resized) {
  const Loaded<Codec>& loaded = load_codec();
  if (!loaded.functions) return loaded.problem;
  resized = {width, height, image.channels, {}};
  resized.pixels.resize(resized.index(0, height, 0));
  return loaded.functions->resize(image, resized);
}

std::string draw_text(Image& image, const std::string& text, const Image::Place& part) {
  const Loaded<Codec>& loaded = load_codec();
  return loaded.functions ? loaded.functions->draw_text(image, text, part) : loaded.problem;
}

std::string check_writable(const std::string& path) {
  if (!format_of(path)) return unknown_format(path);
  return check_file_writable(path);
}

namespace {

using Decode = ReadResult (*Codec::*)(const Picture& picture);

ReadResult decoded(const std::string& path, Decode decode) {
  const std::optional<Format> format = format_of(path);
  if (!format) return {.error = unknown_format(path)};
  if (std::string problem = no_plain_file(path); !problem.empty()) return {.error = std::move(problem)};
  if (is_cut_short(path)) return {.error = ends_too_early(path)};

  const Loaded<Codec>& loaded = load_codec();
  ReadResult result = loaded.functions != nullptr ? (loaded.functions->*decode)({path, name_of(*format)})
                                                  : ReadResult{.error = loaded.problem};
  if (!result.error.empty()) return {.error = fmt::format("cannot read '{}': {}", path, result.error)};
  if (*format == Format::exr)
    result.view = told_view(result.metadata);
  else if (result.image)
    make_linear(*result.image);
  return result;
}

}  // namespace

ReadResult read(const std::string& path) { return decoded(path, &Codec::decode); }
ReadResult read_metadata(const std::string& path) { return decoded(path, &Codec::decode_texts); }

std::string read_rows(const std::string& path, const std::string& channel, std::optional<Encoding> encoding,
                      RowTaker& taker) {
  if (std::string problem = no_plain_file(path); !problem.empty()) return problem;
  if (is_cut_short(path)) return ends_too_early(path);
  const Loaded<Codec>& loaded = load_codec();
  LinearRows linear(taker, encoding);
  std::string error = loaded.problem;
  if (loaded.functions) {
    const std::string format = robust_format_of_file(path);
    const auto decode = [&](RowTaker& to) {
      return loaded.functions->decode_rows({path, format}, chosen_channels, &channel, to);
    };
    error = format.empty() ? decode_apart(decode, linear) : decode(linear);
  }
  return error.empty() ? error : fmt::format("cannot read '{}': {}", path, error);
}

std::string read_rows(std::span<const std::byte> bytes, Encoding encoding, RowTaker& taker) {
  const std::string format = robust_format(bytes);
  if (format != "png" && format != "jpeg" && format != "webp") return "is no PNG, JPEG or WebP picture";
  if (is_cut_short(bytes)) return "is a picture that ends too early";
  const Loaded<Codec>& loaded = load_codec();
  const auto all = [](const std::vector<std::string>& channels, const void*) {
    std::vector<std::size_t> out(channels.size());
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
  };
  LinearRows linear(taker, encoding);
  const std::string error =
      loaded.functions ? loaded.functions->decode_rows({"texture", format, bytes}, all, nullptr, linear)
                       : loaded.problem;
  return error.empty() ? error : fmt::format("cannot be read: {}", error);
}

PlanesResult read_planes(const std::string& path, const std::string& channel, std::uint64_t most_bytes) {
  Planes planes(most_bytes);
  return kept(planes, read_rows(path, channel, std::nullopt, planes));
}

PlanesResult read_texture(std::span<const std::byte> bytes, Encoding encoding, std::uint64_t most_bytes) {
  Planes planes(most_bytes);
  return kept(planes, read_rows(bytes, encoding, planes));
}

}  // namespace tyndall::image
