// The list of a NanoVDB file's grids.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "import/vdb/nano.h"
#include "import/vdb/nano_layout.h"

namespace tyndall::import {

namespace {

// Numbers of a file in order, until one is not there.
class File {
 public:
  explicit File(const std::string& path) : file_(path, std::ios::binary) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(path, failed);
    size_ = failed ? 0 : size;
  }
  std::uint64_t size() const { return size_; }
  std::uint64_t place = 0;

  // False when they are not all there.
  bool read(void* to, std::uint64_t bytes) {
    if (bytes > size_ - std::min(place, size_)) return false;
    file_.seekg(static_cast<std::streamoff>(place));
    file_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    place += bytes;
    return file_.good();
  }

 private:
  std::ifstream file_;
  std::uint64_t size_ = 0;
};

// io::FileHeader and io::FileMetaData.
struct Header {
  std::uint64_t magic;
  std::uint32_t version;
  std::uint16_t grids;
  nano::Codec codec;
};
static_assert(sizeof(Header) == nano::file_header_bytes);
struct Metadata {
  std::uint64_t grid_bytes, file_bytes, name_key, voxels;
  std::uint32_t type, grid_class;
  double world_box[6];
  std::int32_t index_box[6];
  double voxel[3];
  std::uint32_t name_bytes, nodes[4], tiles[3];
  nano::Codec codec;
  std::uint16_t padding;
  std::uint32_t version;
};
static_assert(sizeof(Metadata) == nano::metadata_bytes);

GridEntry entry_of(const Metadata& metadata, const std::string& name, std::uint64_t place) {
  GridEntry entry;
  entry.name = name;
  const nano::Type* const type = nano::type_of(metadata.type);
  entry.supported = type != nullptr;
  entry.type = type ? std::string(type->name) : fmt::format("NanoVDB's type {}", metadata.type);
  entry.is_vec = type && type->components == 3;
  entry.place = entry.tree_place = static_cast<std::int64_t>(place);
  entry.nano =
      NanoEntry{metadata.grid_bytes, metadata.file_bytes, static_cast<std::uint16_t>(metadata.codec)};
  return entry;
}

// A header and the grids behind it; why it cannot be read, or an empty text.
std::string read_segment(File& file, std::vector<GridEntry>& grids) {
  Header header{};
  if (!file.read(&header, sizeof header)) return "the file ends too early";
  if ((header.magic & nano::magic_mask) != nano::magic) return "it is no NanoVDB file";
  if (nano::major_of(header.version) != nano::major_version)
    return fmt::format("it is of version {} of NanoVDB, and {} is known", nano::major_of(header.version),
                       nano::major_version);
  if (header.codec > nano::Codec::blosc) return "it is packed in a way that is not known";
  std::vector<std::pair<Metadata, std::string>> listed;
  for (int i = 0; i < header.grids; ++i) {
    Metadata metadata{};
    constexpr std::uint32_t most_letters = 1 << 16;
    if (!file.read(&metadata, sizeof metadata) || metadata.name_bytes > most_letters ||
        metadata.codec > nano::Codec::blosc)
      return fmt::format("the entry of grid {} of {} is broken or cut off", i + 1, header.grids);
    std::string name(metadata.name_bytes, '\0');
    if (!file.read(name.data(), name.size())) return "the file ends too early";
    name.resize(std::strlen(name.c_str()));
    listed.emplace_back(metadata, std::move(name));
  }
  for (const auto& [metadata, name] : listed) {
    if (metadata.file_bytes > file.size() - file.place) return "the file ends too early";
    grids.push_back(entry_of(metadata, name, file.place));
    file.place += metadata.file_bytes;
  }
  return {};
}

// "density[1]" is the second one of that name.
void tell_names_apart(std::vector<GridEntry>& grids) {
  std::map<std::string, int> known;
  for (GridEntry& grid : grids)
    if (const int before = known[grid.name]++; before > 0) grid.name += fmt::format("[{}]", before);
}

}  // namespace

bool is_nano_file(const std::string& path) {
  File file(path);
  std::uint64_t first = 0;
  return file.read(&first, sizeof first) && (first & nano::magic_mask) == nano::magic;
}

GridList list_nano_grids(const std::string& path) {
  File file(path);
  GridList list;
  constexpr std::size_t most_grids = 1 << 16;
  while (file.place < file.size() && list.grids.size() < most_grids)
    if (const std::string problem = read_segment(file, list.grids); !problem.empty())
      return {fmt::format("cannot read '{}': {}", path, problem), {}};
  tell_names_apart(list.grids);
  return list;
}

}  // namespace tyndall::import
