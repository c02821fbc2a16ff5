// The one file that knows OpenImageIO, a module of its own (codec.h says why). Pictures are encoded in
// memory, so that files.h can write them whole.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "image/codec.h"

namespace tyndall::image {
namespace {

// While it lives, what image libraries print on standard error is not seen: what is worth telling they
// return.
class Silence {
 public:
  Silence() {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    said_to_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    if (said_to_ >= 0) ::dup2(nowhere, STDERR_FILENO);
    ::close(nowhere);
  }
  ~Silence() {
    if (said_to_ < 0) return;
    ::dup2(said_to_, STDERR_FILENO);
    ::close(said_to_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int said_to_ = -1;
};

OIIO::ImageSpec spec_of(const Image& image, const Metadata& metadata, Format format) {
  const Image::Place place = whole_of(image);
  const auto channels = static_cast<int>(image.channels.size());
  OIIO::ImageSpec spec(place.whole_width, place.whole_height, channels, OIIO::TypeDesc::UINT8);
  if (format == Format::exr) {
    spec = OIIO::ImageSpec(image.width, image.height, channels, OIIO::TypeDesc::FLOAT);
    spec.x = place.x;
    spec.y = place.y;
    spec.full_width = place.whole_width;
    spec.full_height = place.whole_height;
  }
  spec.channelnames = image.channels;
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  if (format == Format::exr) {
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    // OpenImageIO would write the time of day: the same picture is to be the same bytes.
    spec.attribute("DateTime", "");
  } else {
    spec.attribute("oiio:ColorSpace", "sRGB");
    // PNG keeps a fixed set of texts: the whole metadata goes into its description.
    std::string description;
    for (const auto& [name, value] : metadata) description += fmt::format("{}: {}\n", name, value);
    spec.attribute("ImageDescription", description);
  }
  return spec;
}

std::string encode(const Image& image, const std::vector<std::uint8_t>& display, const Metadata& metadata,
                   Format format, std::vector<unsigned char>& bytes) {
  const Silence silence;
  const auto output = OIIO::ImageOutput::create(format == Format::exr ? "exr" : "png");
  if (!output) return OIIO::geterror();
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->set_ioproxy(&memory)) return output->geterror();
  if (!output->open("memory", spec_of(image, metadata, format))) return output->geterror();
  const bool written = format == Format::exr ? output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data())
                                             : output->write_image(OIIO::TypeDesc::UINT8, display.data());
  if (!written || !output->close()) return output->geterror();
  return {};
}

Metadata texts_of(const OIIO::ImageSpec& spec) {
  Metadata metadata;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING)
      metadata.emplace_back(attribute.name().string(), attribute.get_string());
  return metadata;
}

// The rows of a picture's display window, from the top: pixels that are stored are read in bands of rows,
// those beyond them are 0, and what is stored beyond the window is cut off.
class Rows {
 public:
  Rows(OIIO::ImageInput& input, int first_channel, int end_channel)
      : input_(input),
        spec_(input.spec()),
        first_channel_(first_channel),
        end_channel_(end_channel),
        channels_(static_cast<std::size_t>(end_channel - first_channel)) {
    const std::size_t row = static_cast<std::size_t>(spec_.width) * channels_;
    band_rows_ = spec_.tile_width > 0
                     ? spec_.tile_height
                     : static_cast<std::int64_t>(std::clamp<std::size_t>(numbers_of_a_band / row, 1, 256));
    pixels_.assign(static_cast<std::size_t>(width_of(spec_)) * channels_, 0);
  }

  static int width_of(const OIIO::ImageSpec& s) { return s.full_width > 0 ? s.full_width : s.width; }
  static int height_of(const OIIO::ImageSpec& s) { return s.full_height > 0 ? s.full_height : s.height; }

  // The next row, its channels interleaved; nothing when the file cannot be read.
  const std::vector<float>* next() {
    const std::int64_t y = std::int64_t{spec_.full_y} + row_++;
    std::fill(pixels_.begin(), pixels_.end(), 0.0f);
    const std::int64_t stored_y = y - spec_.y, skipped = std::int64_t{spec_.full_x} - spec_.x;
    if (stored_y < 0 || stored_y >= spec_.height) return &pixels_;
    if ((stored_y < band_begin_ || stored_y >= band_end_) && !read_band(stored_y)) return nullptr;
    const std::int64_t left = std::max<std::int64_t>(skipped, 0),
                       right = std::min<std::int64_t>(spec_.width, skipped + width_of(spec_));
    if (left >= right) return &pixels_;
    const auto channels = static_cast<std::int64_t>(channels_);
    std::copy_n(band_.begin() + ((stored_y - band_begin_) * spec_.width + left) * channels,
                (right - left) * channels, pixels_.begin() + (left - skipped) * channels);
    return &pixels_;
  }

 private:
  static constexpr std::size_t numbers_of_a_band = std::size_t{1} << 20;

  // Of rows that are stored, counted from the first.
  bool read_band(std::int64_t row) {
    band_begin_ = row / band_rows_ * band_rows_;
    band_end_ = std::min<std::int64_t>(band_begin_ + band_rows_, spec_.height);
    band_.resize(static_cast<std::size_t>((band_end_ - band_begin_) * spec_.width) * channels_);
    const int begin = static_cast<int>(spec_.y + band_begin_), end = static_cast<int>(spec_.y + band_end_);
    if (spec_.tile_width > 0)
      return input_.read_tiles(0, 0, spec_.x, spec_.x + spec_.width, begin, end, spec_.z, spec_.z + 1,
                               first_channel_, end_channel_, OIIO::TypeDesc::FLOAT, band_.data());
    return input_.read_scanlines(0, 0, begin, end, spec_.z, first_channel_, end_channel_,
                                 OIIO::TypeDesc::FLOAT, band_.data());
  }

  OIIO::ImageInput& input_;
  const OIIO::ImageSpec& spec_;
  int first_channel_, end_channel_;
  std::size_t channels_;
  std::int64_t row_ = 0, band_rows_ = 1, band_begin_ = 0, band_end_ = 0;
  std::vector<float> band_, pixels_;
};

std::string refused(const OIIO::ImageSpec& spec) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
    return "it is not a flat picture";
  return {};
}

PlanesResult decode_planes(const std::string& path, ChooseChannels choose, const void* wish,
                           std::uint64_t most_bytes, bool& encoded) {
  const Silence silence;
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path, &wishes);
  if (!input) return {.error = OIIO::geterror()};
  const OIIO::ImageSpec& spec = input->spec();
  PlanesResult result{Rows::width_of(spec), Rows::height_of(spec), spec.channelnames, {}, refused(spec)};
  if (!result.error.empty()) return result;
  const std::vector<std::size_t> wanted = choose(spec.channelnames, wish);
  if (wanted.empty()) return result;
  // In doubles, which no claim overflows.
  const double pixels = double(result.width) * result.height;
  const double bytes =
      std::max(pixels, double(spec.width) * spec.height) * static_cast<double>(wanted.size() * sizeof(float));
  if (bytes > static_cast<double>(most_bytes)) {
    result.error = fmt::format("its {} x {} pixels take {:.0f} MB of memory, and {} MB are left for pictures",
                               result.width, result.height, bytes / (1 << 20), most_bytes >> 20);
    return result;
  }
  encoded = !spec.format.is_floating_point() && spec.get_string_attribute("oiio:ColorSpace") != "Linear";
  const auto [low, high] = std::minmax_element(wanted.begin(), wanted.end());
  const std::size_t first = *low, channels = *high + 1 - first;
  Rows rows(*input, static_cast<int>(first), static_cast<int>(*high + 1));
  // Memory is taken as rows come: a file may claim more than it holds.
  result.planes.resize(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    result.planes[i].channel = wanted[i];
    result.planes[i].texels.reserve(static_cast<std::size_t>(pixels));
  }
  for (int y = 0; y < result.height; ++y) {
    const std::vector<float>* row = rows.next();
    if (!row) {
      result.planes.clear();
      result.error = input->geterror();
      return result;
    }
    for (ReadPlane& plane : result.planes)
      for (std::size_t i = plane.channel - first; i < row->size(); i += channels)
        plane.texels.push_back((*row)[i]);
  }
  return result;
}

ReadResult decode(const std::string& path) {
  const Silence silence;
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return {.error = OIIO::geterror()};
  const OIIO::ImageSpec& spec = input->spec();
  if (std::string problem = refused(spec); !problem.empty()) return {.error = problem};
  Image image{Rows::width_of(spec), Rows::height_of(spec), spec.channelnames, {}};
  Rows rows(*input, 0, spec.nchannels);
  for (int y = 0; y < image.height; ++y) {
    const std::vector<float>* row = rows.next();
    if (!row) return {.error = input->geterror()};
    image.pixels.insert(image.pixels.end(), row->begin(), row->end());
  }
  return {.image = std::move(image), .metadata = texts_of(spec)};
}

}  // namespace
}  // namespace tyndall::image

extern "C" const tyndall::image::Codec tyndall_codec{tyndall::image::encode, tyndall::image::decode,
                                                     tyndall::image::decode_planes};
