// The one file that knows OpenImageIO, a module of its own (codec.h says why). Pictures are encoded in
// memory, so that files.h can write them whole.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/silence.h"
#include "image/codec.h"

namespace tyndall::image {
namespace {

// A segment of a JPEG holds 64 kB, and its writer ends the program beyond; of a TIFF, no more is read back.
constexpr std::size_t most_text = 60'000;

OIIO::ImageSpec spec_of(const Image& image, const Metadata& metadata, Format format) {
  const auto channels = static_cast<int>(image.channels.size());
  OIIO::ImageSpec spec(image.width, image.height, channels,
                       format == Format::tiff ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
  spec.channelnames = image.channels;
  // OpenImageIO would write the time of day: the same picture is to be the same bytes.
  spec.attribute("DateTime", "");
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (format == Format::jpeg) {
    spec.attribute("compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  if (format == Format::tiff) spec.attribute("compression", "zip");
  // These keep a fixed set of texts: the whole metadata goes into the description.
  std::string description;
  for (const auto& [name, value] : metadata) {
    if (name == "Software") spec.attribute(name, value);
    if (description.size() + name.size() + value.size() > most_text) continue;
    description += fmt::format("{}: {}\n", name, value);
  }
  if (!description.empty())
    spec.attribute("ImageDescription", description);  // its JPEG writer aborts at none
  return spec;
}

// A file in memory, for what is written here and there in it: OpenImageIO's TIFF writer loses its directory
// when it writes into a vector.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("picture", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (file_ >= 0) ::close(file_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }
  // Whether all of it could be read.
  bool read(std::vector<unsigned char>& bytes) const {
    const off_t size = ::lseek(file_, 0, SEEK_END);
    if (size <= 0) return false;
    bytes.resize(static_cast<std::size_t>(size));
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count =
          ::pread(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (count <= 0) return false;
      done += static_cast<std::size_t>(count);
    }
    return true;
  }

 private:
  int file_;
};

std::string encode(const Image& image, const Metadata& metadata, Format format,
                   std::vector<unsigned char>& bytes) {
  const Silence silence;
  const auto output = OIIO::ImageOutput::create(name_of(format));
  if (!output) return OIIO::geterror();
  const MemoryFile file;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const bool through_file = format == Format::tiff;
  if (!through_file && !output->set_ioproxy(&memory)) return output->geterror();
  if (!output->open(through_file ? file.path() : "memory", spec_of(image, metadata, format)))
    return output->geterror();
  if (!output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) || !output->close())
    return output->geterror();
  if (through_file && !file.read(bytes)) return "there is not enough memory for its bytes";
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
    // Some readers report what is missing and go on all the same.
    if ((stored_y < band_begin_ || stored_y >= band_end_) && (!read_band(stored_y) || input_.has_error()))
      return nullptr;
    const std::int64_t left = std::max<std::int64_t>(skipped, 0),
                       right = std::min<std::int64_t>(spec_.width, skipped + width_of(spec_));
    if (left >= right) return &pixels_;
    const auto channels = static_cast<std::int64_t>(channels_);
    std::copy_n(band_.get() + ((stored_y - band_begin_) * spec_.width + left) * channels,
                (right - left) * channels, pixels_.begin() + (left - skipped) * channels);
    return &pixels_;
  }

 private:
  static constexpr std::size_t numbers_of_a_band = std::size_t{1} << 20;

  // Of rows that are stored, counted from the first.
  bool read_band(std::int64_t row) {
    band_begin_ = row / band_rows_ * band_rows_;
    band_end_ = std::min<std::int64_t>(band_begin_ + band_rows_, spec_.height);
    // A fresh one, not cleared: a band of tiles may be all that a file claims, and nothing of it be there.
    band_.reset(new float[static_cast<std::size_t>((band_end_ - band_begin_) * spec_.width) * channels_]);
    const int begin = static_cast<int>(spec_.y + band_begin_), end = static_cast<int>(spec_.y + band_end_);
    if (spec_.tile_width > 0)
      return input_.read_tiles(0, 0, spec_.x, spec_.x + spec_.width, begin, end, spec_.z, spec_.z + 1,
                               first_channel_, end_channel_, OIIO::TypeDesc::FLOAT, band_.get());
    return input_.read_scanlines(0, 0, begin, end, spec_.z, first_channel_, end_channel_,
                                 OIIO::TypeDesc::FLOAT, band_.get());
  }

  OIIO::ImageInput& input_;
  const OIIO::ImageSpec& spec_;
  int first_channel_, end_channel_;
  std::size_t channels_;
  std::int64_t row_ = 0, band_rows_ = 1, band_begin_ = 0, band_end_ = 0;
  std::unique_ptr<float[]> band_;
  std::vector<float> pixels_;
};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// Why reading ended; some formats end it without a word.
std::string reason(OIIO::ImageInput& input) {
  const std::string said = first_line(input.geterror());
  return said.empty() ? "it holds less than its header claims" : said;
}

std::string refused(const OIIO::ImageSpec& spec) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
    return "it is not a flat picture";
  return {};
}

std::string why_closed(std::string said) {
  const std::string line = first_line(said);
  return line.empty() ? "it is no picture of its format" : line;
}

// Null with the reason in `error`.
std::unique_ptr<OIIO::ImageInput> open(const Picture& picture, const OIIO::ImageSpec& wishes,
                                       std::string& error) {
  if (picture.format.empty()) {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    auto input = OIIO::ImageInput::open(picture.path, &wishes);
    if (!input) error = why_closed(OIIO::geterror());
    return input;
  }
  // By no other reader than its own.
  auto input = OIIO::ImageInput::create(picture.format);
  OIIO::ImageSpec spec;
  if (input && input->open(picture.path, spec, wishes)) return input;
  error = why_closed(input ? input->geterror() : OIIO::geterror());
  return nullptr;
}

// How a file's numbers stand for light: as it tells; else whole ones are sRGB's, and others linear.
Transfer transfer_of(const OIIO::ImageSpec& spec) {
  using Curve = Transfer::Curve;
  if (spec.format.is_floating_point()) return {};
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (space == "Linear" || space == "linear" || space == "scene_linear") return {};
  const float gamma = spec.get_float_attribute("oiio:Gamma", 0);
  if (space.starts_with("Gamma") && gamma >= 0.1f && gamma <= 10) return {Curve::power, gamma};
  return {Curve::srgb, 1};
}

// So many numbers at most are read at a time, and a picture has.
constexpr double most_of_a_band = 1 << 28, most_of_all = double(std::int64_t{1} << 36);

std::string too_large(const OIIO::ImageSpec& spec, std::size_t channels) {
  const double pixels = std::max(double(Rows::width_of(spec)) * Rows::height_of(spec),
                                 double(spec.width) * spec.height),
               numbers = pixels * static_cast<double>(channels),
               row = double(std::max(spec.width, Rows::width_of(spec))) * static_cast<double>(channels) *
                     std::max(1, std::min(spec.tile_height, spec.height));
  if (numbers <= most_of_all && row <= most_of_a_band) return {};
  return fmt::format("its {} x {} pixels{} are more than can be read", Rows::width_of(spec),
                     Rows::height_of(spec), spec.tile_width > 0 ? " and its tiles" : "");
}

std::string decode_rows(const Picture& picture, ChooseChannels choose, const void* wish, RowTaker& taker) {
  const Silence silence;
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(picture.bytes.data()), picture.bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &memory;
  if (!picture.bytes.empty()) wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  std::string problem;
  const auto input = open(picture, wishes, problem);
  if (!input) return problem;
  const OIIO::ImageSpec& spec = input->spec();
  if (problem = refused(spec); !problem.empty()) return problem;
  PictureHeader header{Rows::width_of(spec), Rows::height_of(spec), spec.channelnames,
                       choose(spec.channelnames, wish), transfer_of(spec)};
  if (!header.chosen.empty()) problem = too_large(spec, header.chosen.size());
  if (problem.empty()) problem = taker.begin(header);
  if (!problem.empty() || header.chosen.empty()) return problem;
  const auto [low, high] = std::minmax_element(header.chosen.begin(), header.chosen.end());
  const std::size_t first = *low, channels = *high + 1 - first;
  Rows rows(*input, static_cast<int>(first), static_cast<int>(*high + 1));
  std::vector<float> chosen(static_cast<std::size_t>(header.width) * header.chosen.size());
  for (int y = 0; y < header.height; ++y) {
    const std::vector<float>* row = rows.next();
    if (!row) return reason(*input);
    float* to = chosen.data();
    for (std::size_t from = 0; from < row->size(); from += channels)
      for (const std::size_t channel : header.chosen) *to++ = (*row)[from + channel - first];
    taker.row(chosen);
  }
  return {};
}

ReadResult decode(const Picture& picture) {
  const Silence silence;
  std::string problem;
  const auto input = open(picture, {}, problem);
  if (!input) return {.error = problem};
  const OIIO::ImageSpec& spec = input->spec();
  problem = refused(spec);
  if (!problem.empty()) return {.error = problem};
  Image image{Rows::width_of(spec), Rows::height_of(spec), spec.channelnames, {}};
  Rows rows(*input, 0, spec.nchannels);
  for (int y = 0; y < image.height; ++y) {
    const std::vector<float>* row = rows.next();
    if (!row) return {.error = reason(*input)};
    image.pixels.insert(image.pixels.end(), row->begin(), row->end());
  }
  return {.image = std::move(image), .metadata = texts_of(spec)};
}

std::string encode_again(const Picture& picture, const Metadata& metadata,
                         std::vector<unsigned char>& bytes) {
  const Silence silence;
  std::string problem;
  const auto input = open(picture, {}, problem);
  if (!input) return problem;
  OIIO::ImageSpec spec = input->spec();
  for (const auto& [name, value] : texts_of(spec)) spec.erase_attribute(name);
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  spec.attribute("DateTime", "");
  std::vector<float> pixels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
    return reason(*input);
  const auto output = OIIO::ImageOutput::create(name_of(Format::exr));
  if (!output) return OIIO::geterror();
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->set_ioproxy(&memory) || !output->open("memory", spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !output->close())
    return output->geterror();
  return {};
}

ReadResult decode_texts(const Picture& picture) {
  const Silence silence;
  std::string problem;
  const auto input = open(picture, {}, problem);
  if (!input) return {.error = problem};
  return {.metadata = texts_of(input->spec())};
}

OIIO::ImageBuf around(Image& image) {
  const OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                             OIIO::TypeDesc::FLOAT);
  return {spec, image.pixels.data()};
}

std::string fill_resized(const Image& from, Image& to) {
  const Silence silence;
  const OIIO::ImageBuf source = around(const_cast<Image&>(from));
  OIIO::ImageBuf target = around(to);
  // One that fills its own place: pixels are stretched to those of the target.
  return OIIO::ImageBufAlgo::resize(target, source) ? std::string() : first_line(target.geterror());
}

// A font of the system, which OpenImageIO does not look for in folders below; empty: there is none. The same
// in every run: a plain one that is nearly everywhere, or the first by its path.
std::string font() {
  namespace fs = std::filesystem;
  std::string first;
  for (const char* folder : {"/usr/share/fonts", "/usr/local/share/fonts"}) {
    std::error_code ignored;
    const auto any = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator file(folder, any, ignored), end; file != end;
         file.increment(ignored)) {
      const fs::path& path = file->path();
      if (path.filename() == "DejaVuSans.ttf") return path.string();
      if (path.extension() == ".ttf" && (first.empty() || path.string() < first)) first = path.string();
    }
  }
  return first;
}

std::string draw_line(Image& image, const std::string& text, const Image::Place& part) {
  const Silence silence;
  constexpr int smallest = 6;
  int size = std::max(part.whole_height * 3 / 4, smallest);
  static const std::string file = font();
  OIIO::ROI box = OIIO::ImageBufAlgo::text_size(text, size, file);
  if (file.empty() || !box.defined())
    return "there is no font to write with: install one, such as fonts-dejavu-core";
  while (size > smallest && box.width() > part.whole_width)
    box = OIIO::ImageBufAlgo::text_size(text, --size, file);
  OIIO::ImageBuf target = around(image);
  const OIIO::ROI inside(part.x, part.x + part.whole_width, part.y, part.y + part.whole_height, 0, 1, 0, 3);
  const bool drawn = OIIO::ImageBufAlgo::render_text(
      target, part.x + part.whole_width / 2, part.y + part.whole_height / 2, text, size, file, {0.6f},
      OIIO::ImageBufAlgo::TextAlignX::Center, OIIO::ImageBufAlgo::TextAlignY::Center, 0, inside);
  return drawn ? std::string() : first_line(target.geterror());
}

}  // namespace
}  // namespace tyndall::image

extern "C" const tyndall::image::Codec tyndall_codec{
    tyndall::image::encode,       tyndall::image::encode_again, tyndall::image::decode,
    tyndall::image::decode_texts, tyndall::image::decode_rows,  tyndall::image::fill_resized,
    tyndall::image::draw_line};
