#include "import/gltf/uri.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

namespace tyndall::gltf {

namespace {

constexpr int none = -1;

// RFC 4648, both alphabets.
constexpr std::array<signed char, 256> base64_values = [] {
  std::array<signed char, 256> values{};
  for (signed char& v : values) v = none;
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < alphabet.size(); ++i)
    values[static_cast<unsigned char>(alphabet[i])] = static_cast<signed char>(i);
  values['-'] = 62;
  values['_'] = 63;
  return values;
}();

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return none;
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::optional<std::vector<std::byte>> decoded_data_uri(std::string_view uri, std::string& why) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    why = "is a data URI without ';base64,'";
    return std::nullopt;
  }
  std::string_view text = uri.substr(comma + 1);
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) {
    why = "is cut short: its base64 text ends within a byte";
    return std::nullopt;
  }
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int value = base64_values[static_cast<unsigned char>(c)];
    if (value == none) {
      why = fmt::format("holds a byte of value {} in its base64 text", static_cast<unsigned char>(c));
      return std::nullopt;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> held & 0xff));
  }
  return bytes;
}

std::optional<std::string> decoded_uri(std::string_view uri, std::string& why) {
  const std::size_t colon = uri.find(':');
  if (colon != std::string_view::npos && uri.find('/') > colon) {
    why = fmt::format("is a {} address: only files beside this one are read", uri.substr(0, colon));
    return std::nullopt;
  }
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : none;
    const int low = high != none ? hex_digit(uri[i + 2]) : none;
    path += low != none ? static_cast<char>(high * 16 + low) : uri[i];
    if (low != none) i += 2;
  }
  if (path.empty() || path.find('\0') != std::string::npos) {
    why = "is no file's name";
    return std::nullopt;
  }
  return path;
}

}  // namespace tyndall::gltf
