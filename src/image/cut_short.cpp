#include "image/cut_short.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

namespace tyndall::image {
namespace {

using Bytes = std::istream;

// A number of two or four bytes, the highest first; -1 at the end of the file.
template <int count>
std::int64_t big_endian(Bytes& file) {
  std::int64_t number = 0;
  for (int i = 0; i < count; ++i) {
    const int byte = file.get();
    if (byte < 0) return -1;
    number = number << 8 | byte;
  }
  return number;
}

// ITU-T T.81, annex B: segments of a marker, a length and so many bytes; after a start of scan, and after
// each restart, entropy-coded bytes in which FF is followed by 00. The file is whole once it reaches the end
// of the image; anything may follow.
bool is_whole_jpeg(Bytes& file) {
  constexpr int first_restart = 0xd0, last_restart = 0xd7, end_of_image = 0xd9, temporary = 0x01;
  while (file) {
    if (file.get() != 0xff) continue;  // entropy-coded, or the fill of some writers
    int marker = file.get();
    while (marker == 0xff) marker = file.get();
    if (marker == end_of_image) return true;
    if (marker == 0 || marker == temporary || (marker >= first_restart && marker <= last_restart)) continue;
    const std::int64_t length = big_endian<2>(file);
    if (length < 2) return false;
    file.ignore(length - 2);
  }
  return false;
}

// PNG specification, chapter 5: after the signature, chunks of a length, a type, so many bytes and a check
// sum, of which IEND is the last.
bool is_whole_png(Bytes& file) {
  constexpr std::int64_t check_sum_bytes = 4, end_type = 0x49454e44;  // "IEND"
  while (file) {
    const std::int64_t length = big_endian<4>(file), type = big_endian<4>(file);
    if (length < 0 || type < 0) return false;
    file.ignore(length);
    if (file.gcount() != length || big_endian<check_sum_bytes>(file) < 0) return false;
    if (type == end_type) return true;
  }
  return false;
}

// OpenEXR, "File Layout": after 8 bytes, attributes, each a name and a type that end in 0, a length of four
// bytes, the lowest first, and so many bytes; a name of no letters ends a header. The library takes memory
// for whatever length stands there. (Of the headers of a file of several parts this is the first.)
bool is_whole_exr_header(Bytes& file) {
  const auto pass_name = [&file] {
    int letters = 0;
    while (file.get() > 0) ++letters;
    return letters;
  };
  while (pass_name() > 0) {
    pass_name();
    std::int64_t length = 0;
    for (int i = 0; i < 4; ++i) length |= std::int64_t{file.get() & 0xff} << (8 * i);
    if (!file || length > std::numeric_limits<std::int32_t>::max()) return false;
    file.ignore(length);
    if (file.gcount() != length) return false;
  }
  return file.good();
}

}  // namespace

static bool is_cut_short(Bytes& file) {
  std::array<char, 4> begin{};
  if (!file.read(begin.data(), begin.size())) return false;
  const std::string_view magic(begin.data(), begin.size());
  if (magic.starts_with("\xff\xd8\xff")) {
    file.seekg(2);
    return !is_whole_jpeg(file);
  }
  if (magic == "\x89PNG") {
    constexpr std::streamoff signature_bytes = 8;
    file.seekg(signature_bytes);
    return !is_whole_png(file);
  }
  if (magic == "\x76\x2f\x31\x01") {
    file.ignore(4);
    return !is_whole_exr_header(file);
  }
  if (magic != "FOR4") return false;
  const std::int64_t rest = big_endian<4>(file), place = file.tellg();
  file.seekg(0, std::ios::end);
  return file.tellg() < place + rest;
}

bool is_cut_short(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return is_cut_short(file);
}

bool is_cut_short(std::span<const std::byte> bytes) {
  std::istringstream file(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  return is_cut_short(file);
}

}  // namespace tyndall::image
