#include "render/film/part_file.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/content_hash.h"
#include "image/files.h"

namespace tyndall::render {

namespace {

using Bytes = std::span<const std::byte>;

constexpr std::string_view magic = "TYNPART\n";
constexpr std::uint32_t format_version = 1;
constexpr std::size_t header_size = 16;       // of the file, and of a section
constexpr std::uint64_t most_text = 1 << 26;  // bytes; of TEXT and of REST: far more than any has
constexpr int most_side = 16384;              // scene::RenderSettings::resolution_range

std::string header_of(std::string_view name, std::uint64_t size) {
  ByteWriter out;
  for (const char c : name) out.put(c);
  out.put(std::uint32_t{0});
  out.put(size);
  return out.bytes();
}

// A section's head, bytes and hash, kept until they are written.
struct Section {
  Section(std::string_view name, Bytes its_bytes)
      : head(header_of(name, its_bytes.size())), bytes(its_bytes) {
    ContentHash all;
    all.add(head);
    all.add(bytes);
    hash = all.value();
  }
  std::string head;
  Bytes bytes;
  std::uint64_t hash = 0;
};

std::string shape_of(const Film& film) {
  ByteWriter out;
  const PixelWindow& w = film.window();
  for (const int number : {film.width(), film.height(), film.groups(), static_cast<int>(film.aovs().bits()),
                           w.x0, w.y0, w.x1, w.y1})
    out.put(number);
  return out.bytes();
}

// A film of that shape with sums of 0; nothing when there is no such film, or its sums are of other sizes
// than what is left of the file.
std::optional<Film> film_of(const std::string& shape, std::uint64_t left) {
  ByteReader in(shape);
  const auto width = in.take<int>(), height = in.take<int>(), groups = in.take<int>(),
             aov_bits = in.take<int>();
  PixelWindow window;
  for (int* number : {&window.x0, &window.y0, &window.x1, &window.y1}) in.take(*number);
  const auto aovs = AovSet::of_bits(static_cast<std::uint32_t>(aov_bits));
  const bool good = in.done() && width <= most_side && height <= most_side && aovs &&
                    Film::can_be(width, height, groups, *aovs, window);
  if (!good || Film::bytes_of(window, groups, *aovs) > left) return std::nullopt;
  return Film(width, height, groups, *aovs, window);
}

class PartReader {
 public:
  PartReader(std::istream& in, std::uint64_t size) : in_(in), left_(size) {}

  std::string begin() {
    std::array<char, header_size> head{};
    if (!take(std::as_writable_bytes(std::span(head)))) return "it is no part of a picture";
    ByteReader numbers(std::string_view(head.data() + magic.size(), 8));
    const auto version = numbers.take<std::uint32_t>(), zero = numbers.take<std::uint32_t>();
    if (!std::string_view(head.data(), head.size()).starts_with(magic) || zero != 0)
      return "it is no part of a picture";
    if (version != format_version)
      return fmt::format("its format is version {}, and this program reads version {}", version,
                         format_version);
    return {};
  }
  // A section of at most so many bytes.
  std::optional<std::string> text(std::string_view name, std::uint64_t most) {
    const auto size = head(name);
    if (!size || *size > most) return std::nullopt;
    std::string bytes(*size, '\0');
    if (!body(std::as_writable_bytes(std::span(bytes)))) return std::nullopt;
    return bytes;
  }
  // A section of just these bytes.
  bool fill(std::string_view name, std::span<std::byte> bytes) {
    const auto size = head(name);
    return size && *size == bytes.size() && body(bytes);
  }
  std::uint64_t left() const { return left_; }

 private:
  bool take(std::span<std::byte> bytes) {
    if (bytes.size() > left_) return false;
    left_ -= bytes.size();
    return bytes.empty() ||
           in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())).good();
  }
  // The number of a section's bytes, which are there.
  std::optional<std::uint64_t> head(std::string_view name) {
    std::array<char, header_size> bytes{};
    if (!take(std::as_writable_bytes(std::span(bytes)))) return std::nullopt;
    ByteReader numbers(std::string_view(bytes.data() + 8, 8));
    const auto size = numbers.take<std::uint64_t>();
    const std::string_view text(bytes.data(), bytes.size());
    if (text != header_of(name, size) || size > left_) return std::nullopt;
    hash_ = ContentHash();
    hash_.add(text);
    return size;
  }
  bool body(std::span<std::byte> bytes) {
    std::uint64_t hash = 0;
    if (!take(bytes) || !take(std::as_writable_bytes(std::span(&hash, 1)))) return false;
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
    return true;  // no fuzzer finds a checksum
#else
    hash_.add(bytes);
    return hash == hash_.value();
#endif
  }

  std::istream& in_;
  std::uint64_t left_;
  ContentHash hash_;
};

constexpr std::string_view damaged = "it is damaged or cut short";

// A message when there is no plain file of a part.
std::string no_part(const std::string& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (std::filesystem::is_regular_file(status)) return {};
  return std::filesystem::exists(status) ? "it is no plain file" : "no such file";
}

std::string cannot_read(const std::string& path, std::string_view why) {
  return fmt::format("cannot read '{}': {}", path, why);
}

}  // namespace

std::string write_part(const std::string& path, const std::string& text, const Film& film,
                       const std::string& rest) {
  const std::string shape = shape_of(film);
  const auto bytes_of = [](const std::string& of) { return std::as_bytes(std::span(of)); };
  const auto [sums, planes] = film.bytes();
  const Section sections[] = {{"TEXT", bytes_of(text)},
                              {"FILM", bytes_of(shape)},
                              {"SUMS", sums},
                              {"AOVS", planes},
                              {"REST", bytes_of(rest)}};
  ByteWriter begin;
  for (const char c : magic) begin.put(c);
  begin.put(format_version);
  begin.put(std::uint32_t{0});
  std::vector<Bytes> pieces{bytes_of(begin.bytes())};
  for (const Section& section : sections)
    pieces.insert(pieces.end(),
                  {bytes_of(section.head), section.bytes, std::as_bytes(std::span(&section.hash, 1))});
  return image::write_file_whole(path, std::span<const Bytes>(pieces));
}

PartResult read_part(std::istream& in, std::uint64_t size) {
  PartReader reader(in, size);
  if (std::string problem = reader.begin(); !problem.empty()) return {.error = std::move(problem)};
  const PartResult bad{.error = std::string(damaged)};
  std::optional<std::string> text = reader.text("TEXT", most_text);
  if (!text) return bad;
  const std::optional<std::string> shape = reader.text("FILM", most_text);
  if (!shape) return bad;
  std::optional<Film> film = film_of(*shape, reader.left());
  if (!film) return bad;
  const auto [sums, planes] = film->bytes();
  if (!reader.fill("SUMS", sums) || !reader.fill("AOVS", planes)) return bad;
  std::optional<std::string> rest = reader.text("REST", most_text);
  if (!rest || reader.left() != 0) return bad;
  return {.part = Part{std::move(*text), std::move(*film), std::move(*rest)}};
}

PartResult read_part(const std::string& path) {
  if (const std::string problem = no_part(path); !problem.empty())
    return {.error = cannot_read(path, problem)};
  std::error_code failed;
  std::ifstream file(path, std::ios::binary);
  PartResult result = read_part(file, std::filesystem::file_size(path, failed));
  if (!result.error.empty()) result.error = cannot_read(path, result.error);
  return result;
}

PartText read_part_text(const std::string& path) {
  if (const std::string problem = no_part(path); !problem.empty())
    return {.error = cannot_read(path, problem)};
  std::error_code failed;
  std::ifstream file(path, std::ios::binary);
  PartReader reader(file, std::filesystem::file_size(path, failed));
  if (const std::string problem = reader.begin(); !problem.empty())
    return {.error = cannot_read(path, problem)};
  std::optional<std::string> text = reader.text("TEXT", most_text);
  if (!text) return {.error = cannot_read(path, damaged)};
  return {.text = std::move(*text)};
}

}  // namespace tyndall::render
