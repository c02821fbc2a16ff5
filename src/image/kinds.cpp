#include "image/kinds.h"

#include <array>
#include <fstream>
#include <string_view>

namespace tyndall::image {

std::string robust_format(std::span<const std::byte> begin) {
  using namespace std::string_view_literals;
  const std::string_view text(reinterpret_cast<const char*>(begin.data()), begin.size());
  if (text.starts_with("\x76\x2f\x31\x01"sv)) return "openexr";
  if (text.starts_with("\x89PNG"sv)) return "png";
  if (text.starts_with("\xff\xd8\xff"sv)) return "jpeg";
  if (text.starts_with("II*\0"sv) || text.starts_with("MM\0*"sv) || text.starts_with("II+\0"sv) ||
      text.starts_with("MM\0+"sv))
    return "tiff";
  if (text.starts_with("#?"sv)) return "hdr";
  if (text.starts_with("RIFF"sv) && text.size() >= 12 && text.substr(8, 4) == "WEBP"sv) return "webp";
  return {};
}

std::string robust_format_of_file(const std::string& path) {
  std::array<char, 12> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return robust_format(std::as_bytes(std::span(begin.data(), static_cast<std::size_t>(file.gcount()))));
}

}  // namespace tyndall::image
