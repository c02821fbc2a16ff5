// The directory of an OpenVDB file, read without OpenVDB: it trusts the lengths that stand there, which is
// why it comes second.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "import/vdb/nano.h"
#include "import/vdb/vdb.h"

namespace tyndall::import {

namespace {

// Formats of files: the oldest that OpenVDB 10 reads, those from which on something is there, the newest.
constexpr std::uint32_t oldest = 213, grid_instancing = 216, boost_uuid = 218, selective_compression = 220,
                        node_mask_compression = 222, newest = 224;
constexpr std::int64_t magic = 0x56444220;

// Numbers and strings in order, until one is not there.
class Bytes {
 public:
  explicit Bytes(const std::string& path) : file_(path, std::ios::binary) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(path, failed);
    left_ = size_ = failed ? 0 : static_cast<std::int64_t>(size);
  }
  bool ok() const { return ok_; }
  std::int64_t size() const { return size_; }
  std::int64_t place() const { return size_ - left_; }

  template <class T>
  T number() {
    T value{};
    if (take(sizeof value)) file_.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  }
  std::string string() {
    const auto length = number<std::uint32_t>();
    std::string text;
    if (!take(length)) return text;
    text.resize(length);
    file_.read(text.data(), static_cast<std::streamsize>(length));
    return text;
  }
  void skip(std::int64_t count) {
    if (take(count)) file_.seekg(count, std::ios::cur);
  }
  void go_to(std::int64_t place) {
    ok_ = ok_ && place >= 0 && place <= size_;
    if (!ok_) return;
    file_.seekg(place);
    left_ = size_ - place;
  }

 private:
  bool take(std::int64_t count) {
    ok_ = ok_ && file_.good() && count >= 0 && count <= left_;
    if (ok_) left_ -= count;
    return ok_;
  }

  std::ifstream file_;
  std::int64_t size_ = 0, left_ = 0;
  bool ok_ = true;
};

// Passes over named values of any types. False when one is not whole.
bool pass_metadata(Bytes& bytes) {
  const auto count = bytes.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && bytes.ok(); ++i) {
    bytes.string();
    bytes.string();
    bytes.skip(bytes.number<std::uint32_t>());
  }
  return bytes.ok();
}

// What comes before the entries: an error, or nothing.
std::string pass_header(Bytes& bytes, std::uint32_t& version) {
  const auto first = bytes.number<std::int64_t>();
  if (first != magic || !bytes.ok()) return "it is no OpenVDB file";
  version = bytes.number<std::uint32_t>();
  if (!bytes.ok()) return "the file ends too early";
  if (version < oldest || version > newest)
    return fmt::format("its format is {}, and those from {} to {} are known", version, oldest, newest);
  bytes.skip(8);  // of the library
  const bool has_places = bytes.number<char>() != 0;
  if (version >= selective_compression && version < node_mask_compression) bytes.skip(1);
  if (version >= boost_uuid) bytes.skip(36);
  if (bytes.ok() && !has_places) return "it was written as a stream, in which grids cannot be found";
  return pass_metadata(bytes) ? "" : "the file ends too early";
}

constexpr std::string_view half_suffix = "_HalfFloat";

// "Tree_float_5_4_3_HalfFloat" is "half".
void set_type(GridEntry& entry, std::string type) {
  const bool half = type.ends_with(half_suffix);
  if (half) type.resize(type.size() - half_suffix.size());
  constexpr std::string_view before = "Tree_", after = "_5_4_3";
  const bool usual = type.starts_with(before) && type.ends_with(after);
  if (usual) type = type.substr(before.size(), type.size() - before.size() - after.size());
  constexpr std::string_view known[] = {"float", "double", "bool",  "int32", "int64",
                                        "mask",  "vec3s",  "vec3d", "vec3i"};
  entry.supported = usual && std::find(std::begin(known), std::end(known), type) != std::end(known);
  entry.is_vec = type.starts_with("vec3");
  entry.type = half ? "half " + type : type;
  if (entry.type == "half float") entry.type = "half";
}

// Names that a file has several times are told apart by a number after a mark.
std::string readable(const std::string& unique_name) {
  const std::size_t mark = unique_name.find('\x1e');
  if (mark == std::string::npos) return unique_name;
  return fmt::format("{}[{}]", unique_name.substr(0, mark), unique_name.substr(mark + 1));
}

struct RawEntry {
  GridEntry entry;
  std::string unique_name, tree_of;
};

std::optional<RawEntry> read_entry(Bytes& bytes, std::uint32_t version) {
  RawEntry raw;
  raw.entry.place = raw.entry.tree_place = bytes.place();
  raw.unique_name = bytes.string();
  raw.entry.name = readable(raw.unique_name);
  set_type(raw.entry, bytes.string());
  if (version >= grid_instancing) raw.tree_of = bytes.string();
  const auto grid = bytes.number<std::int64_t>();
  bytes.number<std::int64_t>();
  const auto end = bytes.number<std::int64_t>();
  if (!bytes.ok() || grid < bytes.place() || end < grid || end > bytes.size()) return std::nullopt;
  bytes.go_to(grid);
  if (version >= node_mask_compression) bytes.skip(4);
  if (!pass_metadata(bytes)) return std::nullopt;
  bytes.go_to(end);
  return raw;
}

}  // namespace

GridList list_grids(const std::string& path) {
  const auto failed = [&](std::string_view why) {
    return GridList{fmt::format("cannot read '{}': {}", path, why), {}};
  };
  if (is_nano_file(path)) return list_nano_grids(path);
  Bytes bytes(path);
  std::uint32_t version = 0;
  if (const std::string problem = pass_header(bytes, version); !problem.empty()) return failed(problem);
  const auto count = bytes.number<std::int32_t>();
  std::vector<RawEntry> entries;
  for (std::int32_t i = 0; i < count; ++i) {
    std::optional<RawEntry> entry = read_entry(bytes, version);
    if (!entry) return failed(fmt::format("the entry of grid {} of {} is broken or cut off", i + 1, count));
    entries.push_back(std::move(*entry));
  }
  if (!bytes.ok()) return failed("the file ends too early");
  GridList list;
  for (RawEntry& raw : entries) {
    if (!raw.tree_of.empty()) {
      const auto holder = std::find_if(entries.begin(), entries.end(),
                                       [&](const RawEntry& e) { return e.unique_name == raw.tree_of; });
      if (holder == entries.end() || !holder->tree_of.empty())
        return failed(fmt::format("grid '{}' shares the tree of '{}', which is not there", raw.entry.name,
                                  readable(raw.tree_of)));
      raw.entry.tree_place = holder->entry.place;
    }
    list.grids.push_back(raw.entry);
  }
  return list;
}

std::string names_of(const GridList& list) {
  std::string text;
  for (const GridEntry& grid : list.grids)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", grid.name, grid.type);
  return text;
}

const GridEntry* find_grid(const GridList& list, const std::string& name) {
  for (const GridEntry& grid : list.grids)
    if (grid.name == name) return &grid;
  for (const GridEntry& grid : list.grids)
    if (grid.name.starts_with(name + "[")) return &grid;
  return nullptr;
}

}  // namespace tyndall::import
