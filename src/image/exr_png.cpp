// The one file that knows OpenEXR and libpng, a module of its own (encoder.h says why). Pictures are encoded
// in memory, so that files.h can write them whole.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <exception>

#include "image/encoder.h"

namespace tyndall::image {
namespace {

// What OpenEXR writes, here and there, kept in memory.
class MemoryStream final : public Imf::OStream {
 public:
  explicit MemoryStream(std::vector<unsigned char>& bytes) : OStream("memory"), bytes_(bytes) {}

  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, bytes, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

 private:
  std::vector<unsigned char>& bytes_;
  std::size_t at_ = 0;
};

Imf::Header header_of(const Image& image, const Metadata& metadata) {
  const Image::Place place = whole_of(image);
  const Imath::Box2i whole({0, 0}, {place.whole_width - 1, place.whole_height - 1}),
      stored({place.x, place.y}, {place.x + image.width - 1, place.y + image.height - 1});
  Imf::Header header(whole, stored);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : image.channels)
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, value] : metadata) header.insert(name, Imf::StringAttribute(value));
  return header;
}

std::string exr_bytes(const Image& image, const Metadata& metadata, std::vector<unsigned char>& bytes) try {
  const Imf::Header header = header_of(image, metadata);
  const std::size_t x_stride = sizeof(float) * image.channels.size(),
                    y_stride = x_stride * static_cast<std::size_t>(image.width);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < image.channels.size(); ++c)
    frame.insert(image.channels[c], Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, header.dataWindow(),
                                                     x_stride, y_stride));
  MemoryStream stream(bytes);
  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(frame);
  file.writePixels(image.height);
  return {};
} catch (const std::exception& error) {
  return error.what();
}

// A PNG as it is written: libpng leaves by longjmp, so all that must be destroyed is outside of where it can.
struct PngWrite {
  std::vector<unsigned char>& bytes;
  std::string problem{};
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~PngWrite() { png_destroy_write_struct(&png, &info); }
};

[[noreturn]] void png_failed(png_structp png, png_const_charp message) {
  static_cast<PngWrite*>(png_get_error_ptr(png))->problem = message;
  png_longjmp(png, 1);
}
void png_warned(png_structp, png_const_charp) {}
void png_appends(png_structp png, png_bytep data, std::size_t size) {
  std::vector<unsigned char>& bytes = static_cast<PngWrite*>(png_get_io_ptr(png))->bytes;
  bytes.insert(bytes.end(), data, data + size);
}
void png_flushes(png_structp) {}

bool write_png(PngWrite& write, const Image& image, std::vector<png_text>& texts,
               std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(write.png))) return false;
  png_set_write_fn(write.png, &write, png_appends, png_flushes);
  png_set_IHDR(write.png, write.info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8,
               image.channels.size() == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(write.png, write.info, PNG_sRGB_INTENT_ABSOLUTE);
  png_set_text(write.png, write.info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(write.png, write.info);
  png_write_image(write.png, rows.data());
  png_write_end(write.png, nullptr);
  return true;
}

png_text text_of(const char* keyword, std::string& value) {
  png_text text{};
  text.compression = PNG_TEXT_COMPRESSION_NONE;
  text.key = const_cast<char*>(keyword);
  text.text = value.data();
  text.text_length = value.size();
  return text;
}

std::string png_bytes(const Image& image, const Metadata& metadata, std::vector<unsigned char>& bytes) try {
  const std::size_t channels = image.channels.size();
  if (channels != 1 && channels != 3) return fmt::format("a PNG has one channel or three, not {}", channels);
  std::vector<unsigned char> numbers;
  numbers.reserve(image.pixels.size());
  for (const float value : image.pixels)
    numbers.push_back(static_cast<unsigned char>(255 * std::min(std::max(value, 0.0f), 1.0f) + 0.5f));
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height; ++y) rows.push_back(numbers.data() + image.index(0, y, 0));
  // PNG keeps a fixed set of texts: the whole metadata goes into the description.
  std::string software, description;
  for (const auto& [name, value] : metadata) {
    if (name == "Software") software = value;
    description += fmt::format("{}: {}\n", name, value);
  }
  std::vector<png_text> texts;
  if (!software.empty()) texts.push_back(text_of("Software", software));
  if (!description.empty()) texts.push_back(text_of("Description", description));

  PngWrite write{bytes};
  write.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &write, png_failed, png_warned);
  if (write.png != nullptr) write.info = png_create_info_struct(write.png);
  if (write.info == nullptr) return "there is not enough memory for its bytes";
  return write_png(write, image, texts, rows) ? std::string() : write.problem;
} catch (const std::exception& error) {
  return error.what();
}

}  // namespace
}  // namespace tyndall::image

extern "C" const tyndall::image::Encoder tyndall_encoder{tyndall::image::exr_bytes,
                                                         tyndall::image::png_bytes};
