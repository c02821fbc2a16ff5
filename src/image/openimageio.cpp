// The one file that knows OpenImageIO, a module of its own (codec.h says why). Pictures are encoded in
// memory, so that files.h can write them whole.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

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

ReadResult decode_any(const std::string& path, std::size_t most_pixels, bool& encoded) {
  const Silence silence;
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path, &wishes);
  if (!input) return {.error = OIIO::geterror()};
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
    return {.error = "it is not a flat picture"};
  if (static_cast<std::size_t>(spec.image_pixels()) > most_pixels)
    return {.error = fmt::format("it has {} x {} pixels, more than {} million", spec.width, spec.height,
                                 most_pixels / 1'000'000)};
  encoded = !spec.format.is_floating_point() && spec.get_string_attribute("oiio:ColorSpace") != "Linear";
  Image image{spec.width, spec.height, spec.channelnames, {}};
  image.pixels.resize(static_cast<std::size_t>(spec.image_pixels()) * image.channels.size());
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
    return {.error = input->geterror()};
  return {.image = std::move(image)};
}

// The display window of a picture whose data window these pixels are, black where they do not reach.
Image whole_picture(Image part, const OIIO::ImageSpec& spec) {
  if (spec.x == spec.full_x && spec.y == spec.full_y && spec.width == spec.full_width &&
      spec.height == spec.full_height)
    return part;
  Image whole{spec.full_width, spec.full_height, part.channels, {}};
  whole.pixels.resize(static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height) *
                      whole.channels.size());
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) {
      const int to_x = x + spec.x - spec.full_x, to_y = y + spec.y - spec.full_y;
      if (to_x < 0 || to_y < 0 || to_x >= whole.width || to_y >= whole.height) continue;
      for (std::size_t c = 0; c < whole.channels.size(); ++c) whole.at(to_x, to_y, c) = part.at(x, y, c);
    }
  return whole;
}

ReadResult decode(const std::string& path) {
  const Silence silence;
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return {.error = OIIO::geterror()};
  const OIIO::ImageSpec& spec = input->spec();
  Image image{spec.width, spec.height, spec.channelnames, {}};
  image.pixels.resize(static_cast<std::size_t>(spec.image_pixels()) * image.channels.size());
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
    return {.error = input->geterror()};
  return {.image = whole_picture(std::move(image), spec), .metadata = texts_of(spec)};
}

}  // namespace
}  // namespace tyndall::image

extern "C" const tyndall::image::Codec tyndall_codec{tyndall::image::encode, tyndall::image::decode,
                                                     tyndall::image::decode_any};
