#include "import/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "import/file_bytes.h"
#include "import/gltf/extensions.h"
#include "import/gltf/meshopt.h"
#include "import/gltf/uri.h"
#include "import/malformed.h"

namespace tyndall::gltf {

namespace {

std::uint32_t word(Bytes bytes, std::size_t at) {
  std::uint32_t out = 0;  // little-endian, as this machine is
  std::memcpy(&out, bytes.data() + at, sizeof(out));
  return out;
}

// The JSON text of a .glb, and the binary chunk behind it.
struct Container {
  Bytes json;
  std::optional<Bytes> binary;
};

// glTF 2.0, chapter 4: a header of three words, then chunks of a length, a type and so many bytes.
Container chunks_of(Bytes file) {
  constexpr std::uint32_t json_type = 0x4e4f534a, binary_type = 0x004e4942;
  constexpr std::size_t header = 12, chunk_header = 8;
  if (file.size() < header + chunk_header) throw Malformed{"", "ends too early"};
  if (word(file, 4) != 2) throw Malformed{"", fmt::format("is of version {}: 2 is read", word(file, 4))};
  if (word(file, 8) > file.size())
    throw Malformed{"", fmt::format("ends too early: it has {} of {} bytes", file.size(), word(file, 8))};
  file = file.first(std::max<std::size_t>(word(file, 8), header));
  Container out;
  for (std::size_t at = header; file.size() - at >= chunk_header;) {
    const std::uint32_t length = word(file, at), type = word(file, at + 4);
    at += chunk_header;
    if (length > file.size() - at)
      throw Malformed{"", fmt::format("has a chunk of {} bytes where {} are left", length, file.size() - at)};
    if (type == json_type && out.json.empty()) out.json = file.subspan(at, length);
    if (type == binary_type && !out.binary) out.binary = file.subspan(at, length);
    at += std::min<std::size_t>((length + 3) / 4 * 4, file.size() - at);
  }
  if (out.json.empty()) throw Malformed{"", "has no JSON chunk"};
  return out;
}

}  // namespace

Document::Document(std::vector<std::byte> file, FindFile find_file)
    : find_file_(std::move(find_file)), file_(std::move(file)) {
  bytes_read_ += static_cast<double>(file_.size());
  Bytes text = file_;
  if (file_.size() >= 4 && std::memcmp(file_.data(), "glTF", 4) == 0) {
    const Container container = chunks_of(file_);
    text = container.json;
    binary_ = container.binary;
  }
  const char* const begin = reinterpret_cast<const char*>(text.data());
  constexpr bool throws = false;
  json_ =
      std::make_unique<nlohmann::json>(nlohmann::json::parse(begin, begin + text.size(), nullptr, throws));
  if (json_->is_discarded()) throw Malformed{"", "is no glTF: its text is no JSON"};
  if (!json_->is_object()) throw Malformed{"", "is no glTF: its JSON is no object"};
  check_asset();
  check_extensions();
}

Document::~Document() = default;

void Document::check_asset() const {
  const Element version = root()["asset"]["version"];
  if (!version.text().starts_with("2")) version.fail(fmt::format("is {}: 2.0 is read", version.text()));
}

void Document::check_extensions() {
  if (const auto required = root().find("extensionsRequired"))
    for (std::size_t i = 0; i < required->size(); ++i)
      if (const Element e = required->at(i); !is_supported(e.text()))
        e.fail(fmt::format("is {}, which is not supported", e.text()));
  if (const auto used = root().find("extensionsUsed"))
    for (std::size_t i = 0; i < used->size(); ++i)
      if (const Element e = used->at(i); !is_supported(e.text()))
        warn(fmt::format("uses {}, which is not supported and ignored", e.text()));
}

Element Document::root() const { return Element(*json_, ""); }

std::size_t Document::count(std::string_view list) const {
  const auto found = root().find(list);
  return found ? found->size() : 0;
}

Element Document::item(std::string_view list, std::size_t i) const { return root()[list].at(i); }

std::optional<std::uint32_t> Document::index(const Element& holder, std::string_view key,
                                             std::string_view list) const {
  const auto found = holder.find(key);
  if (!found) return std::nullopt;
  return found->index(count(list), list);
}

void Document::warn(std::string message) {
  if (std::find(warnings_.begin(), warnings_.end(), message) == warnings_.end())
    warnings_.push_back(std::move(message));
}

void Document::warn_once(std::string_view key, std::string message) {
  if (told_.emplace(key).second) warn(std::move(message));
}

void Document::take(const Element& what, double bytes) {
  constexpr double always = 1 << 30, times_read = 200;  // the densest codecs make 64 bytes of one
  bytes_made_ += bytes;
  if (bytes_made_ > always + times_read * bytes_read_)
    what.fail("would take more memory than a file of this size may");
}

Document::Owned Document::resource(const Element& uri) {
  std::string why;
  if (is_data_uri(uri.text())) {
    std::optional<Owned> bytes = decoded_data_uri(uri.text(), why);
    if (!bytes) uri.fail(why);
    return std::move(*bytes);
  }
  const auto name = decoded_uri(uri.text(), why);
  const auto path = name ? find_file_(*name, why) : std::nullopt;
  if (!path) uri.fail(why);
  try {
    Owned bytes = read_file_bytes(*path);
    bytes_read_ += static_cast<double>(bytes.size());
    return bytes;
  } catch (const Malformed& m) {
    uri.fail(fmt::format("names '{}', which {}", *name, m.reason));
  }
}

Bytes Document::buffer(std::uint32_t i) {
  const Element buffer = item("buffers", i);
  const std::uint64_t length = buffer["byteLength"].count();
  const auto uri = buffer.find("uri");
  Bytes bytes;
  if (!uri) {
    if (i != 0 || !binary_) buffer.fail("has no uri, and the file no binary chunk for it");
    bytes = *binary_;
  } else {
    auto known = buffers_.find(i);
    if (known == buffers_.end()) known = buffers_.emplace(i, resource(*uri)).first;
    bytes = known->second;
  }
  if (bytes.size() < length)
    buffer["byteLength"].fail(fmt::format("is {}, but there are {} bytes", length, bytes.size()));
  return bytes.first(length);
}

Bytes Document::part_of_buffer(const Element& holder) {
  const std::uint32_t index = holder["buffer"].index(count("buffers"), "buffers");
  const Bytes bytes = buffer(index);
  const std::uint64_t offset = holder.count("byteOffset", 0), length = holder["byteLength"].count();
  if (offset > bytes.size() || length > bytes.size() - offset)
    holder.fail(fmt::format("is bytes {} to {} of buffers[{}], which has {}", offset, offset + length, index,
                            bytes.size()));
  return bytes.subspan(offset, length);
}

Bytes Document::view(std::uint32_t i) {
  const Element view = item("bufferViews", i);
  const auto packed = view.extension("EXT_meshopt_compression");
  if (!packed) return part_of_buffer(view);
  auto known = views_.find(i);
  if (known == views_.end()) {
    Owned bytes = unpacked_meshopt(*packed, part_of_buffer(*packed));
    take(view, static_cast<double>(bytes.size()));
    known = views_.emplace(i, std::move(bytes)).first;
  }
  return known->second;
}

Bytes Document::image(std::uint32_t i) {
  const Element image = item("images", i);
  if (const auto view_index = index(image, "bufferView", "bufferViews")) return view(*view_index);
  const auto known = images_.find(i);
  if (known != images_.end()) return known->second;
  return images_[i] = resource(image["uri"]);
}

std::string name_of(const Element& element) {
  const std::string name = element.text("name");
  return name.empty() ? element.path() : name;
}

}  // namespace tyndall::gltf
