// One grid of a NanoVDB file. Nodes are taken as they lie, level by level, and every place of theirs is
// checked.
#include "import/vdb/nano.h"

#include <blosc.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <unordered_map>
#include <utility>

#include "import/vdb/make_voxels.h"
#include "import/vdb/nano_layout.h"

namespace tyndall::import {

namespace {

using nano::Level;

[[noreturn]] void refuse_place() { throw Refused("places in it are wrong"); }

std::vector<char> read_bytes(const std::string& path, std::int64_t place, std::uint64_t bytes) {
  std::vector<char> read(bytes);
  std::ifstream file(path, std::ios::binary);
  file.seekg(place);
  file.read(read.data(), static_cast<std::streamsize>(bytes));
  if (!file.good()) throw Refused("the file ends too early");
  return read;
}

// Blocks, each after its length; one of zlib, as many as there are of Blosc.
void unpack(const std::vector<char>& packed, nano::Codec codec, std::vector<char>& to) {
  std::size_t from = 0, done = 0;
  while (done < to.size()) {
    std::uint64_t length = 0;
    if (packed.size() - from < sizeof length) throw Refused("the file ends too early");
    std::memcpy(&length, packed.data() + from, sizeof length);
    from += sizeof length;
    if (length > packed.size() - from) throw Refused("a compressed block of values is broken");
    std::size_t unpacked = 0;
    if (codec == nano::Codec::zip) {
      uLongf size = to.size() - done;
      const int result = ::uncompress(reinterpret_cast<Bytef*>(to.data() + done), &size,
                                      reinterpret_cast<const Bytef*>(packed.data() + from), length);
      if (result == Z_OK) unpacked = size;
    } else if (::blosc_cbuffer_validate(packed.data() + from, length, &unpacked) != 0 ||
               unpacked > to.size() - done ||
               ::blosc_decompress_ctx(packed.data() + from, to.data() + done, unpacked, 1) !=
                   static_cast<int>(unpacked)) {
      unpacked = 0;
    }
    if (unpacked == 0) throw Refused("a compressed block of values is broken");
    from += length;
    done += unpacked;
  }
}

// A grid's bytes, and a Source of make_voxels.h.
class NanoGrid {
 public:
  NanoGrid(std::vector<char> bytes) : bytes_(std::move(bytes)) {
    if (nano::major_of(number<std::uint32_t>(nano::version_at)) != nano::major_version) refuse_place();
    type_ = nano::type_of(number<std::uint32_t>(nano::type_at));
    if (!type_) refuse_place();
    tree_ = nano::grid_bytes;
    for (std::size_t level = Level::leaf; level <= Level::root; ++level)
      first_[level] = tree_ + number<std::uint64_t>(tree_ + nano::node_offsets_at + 8 * level);
    for (std::size_t level = Level::leaf; level < Level::root; ++level)
      counts_[level] = number<std::uint32_t>(tree_ + nano::node_counts_at + 4 * level);
    value_bytes_ = bytes_of_value();
    find_leaves();
    find_tiles();
  }

  int components() const { return type_->components; }
  Numbers background() const { return background_; }
  bool is_level_set() const { return number<std::uint32_t>(nano::class_at) == nano::level_set_class; }
  // Counted: the file's own number may be any.
  std::int64_t active_voxels() const {
    std::int64_t all = 0;
    for (const auto& [key, leaf] : leaves_)
      for (std::uint64_t word = 0; word < 8; ++word)
        all += std::popcount(number<std::uint64_t>(leaf.place + nano::leaf_mask_at + 8 * word));
    for (const Tile& tile : tiles_)
      if (tile.active) all += std::int64_t{tile.side} * tile.side * tile.side;
    return all;
  }
  std::optional<VoxelBox> active_box() const {
    VoxelBox box{coord(first_[Level::root]), coord(first_[Level::root] + 12)};
    for (std::size_t i = 0; i < 3; ++i)
      if (box.first[i] > box.last[i]) return std::nullopt;
    return box;
  }
  // p = M i + v, M by rows.
  Transform from_index() const {
    const auto m = [&](std::size_t row, std::size_t column) {
      return number<double>(nano::matrix_at + 8 * (3 * row + column));
    };
    const auto column = [&](std::size_t c) { return Vec3d{m(0, c), m(1, c), m(2, c)}; };
    const auto v = [&](std::size_t i) { return number<double>(nano::vec_at + 8 * i); };
    return {column(0), column(1), column(2), {v(0), v(1), v(2)}};
  }

  template <class F>
  void for_each_leaf(F&& f) const {
    for (const auto& [key, leaf] : leaves_) f(box_at(leaf.origin, 8));
  }
  template <class F>
  void for_each_tile(F&& f) const {
    for (const Tile& tile : tiles_) f(box_at(tile.origin, tile.side), tile.value);
  }
  template <class F>
  void for_each_active(F&& f) const {
    for (const auto& [key, leaf] : leaves_)
      for (std::size_t n = 0; n < 512; ++n)
        if (bit(leaf.place + nano::leaf_mask_at, n)) f(voxel(leaf.place, n), std::uint64_t{1});
    for (const Tile& tile : tiles_)
      if (tile.active) {
        const auto side = static_cast<std::uint64_t>(tile.side);
        f(tile.value, side * side * side);
      }
  }
  auto reader() const {
    // Neighbours are asked for one after another: most stand in the same leaf, or tile.
    return [this, key = no_key, found = Found{}](const VoxelCoord& at) mutable {
      if (const std::uint64_t wanted = key_of(at, 3); wanted != key) {
        key = wanted;
        found = find(at);
      }
      if (!found.in_leaf) return found.value;
      return voxel(found.leaf, static_cast<std::size_t>((at[0] & 7) << 6 | (at[1] & 7) << 3 | (at[2] & 7)));
    };
  }

 private:
  struct Leaf {
    VoxelCoord origin;
    std::uint64_t place;
  };
  struct Tile {
    VoxelCoord origin;
    std::int32_t side;
    Numbers value;
    bool active;
  };

  // What holds a box of 8³ voxels: a leaf, or one value.
  struct Found {
    bool in_leaf = false;
    std::uint64_t leaf = 0;
    Numbers value{};
  };

  static constexpr std::uint64_t no_key = ~std::uint64_t{0};
  static constexpr std::size_t most_tiles = std::size_t{1} << 22;

  template <class T>
  T number(std::uint64_t place) const {
    if (bytes_.size() < sizeof(T) || place > bytes_.size() - sizeof(T)) refuse_place();
    T value;
    std::memcpy(&value, bytes_.data() + place, sizeof value);
    return value;
  }
  bool bit(std::uint64_t place, std::size_t n) const {
    return number<std::uint8_t>(place + n / 8) >> (n % 8) & 1;
  }
  VoxelCoord coord(std::uint64_t place) const {
    return {number<std::int32_t>(place), number<std::int32_t>(place + 4), number<std::int32_t>(place + 8)};
  }
  // Where the node stands whose box begins with that coordinate.
  static VoxelCoord origin_of(const VoxelCoord& within, std::int32_t side) {
    VoxelCoord origin;
    for (std::size_t i = 0; i < 3; ++i) origin[i] = within[i] & ~(side - 1);
    return origin;
  }
  static VoxelBox box_at(const VoxelCoord& origin, std::int32_t side) {
    VoxelBox box{origin, origin};
    // None is so far out that it wraps, or it is cut there.
    for (std::int32_t& n : box.last)
      n = static_cast<std::int32_t>(
          std::min<std::int64_t>(std::int64_t{n} + side - 1, std::numeric_limits<std::int32_t>::max()));
    return box;
  }
  static std::uint64_t key_of(const VoxelCoord& at, int bits) {
    std::uint64_t key = 0;
    for (const std::int32_t n : at) key = key << 21 | (static_cast<std::uint32_t>(n >> bits) & 0x1fffff);
    return key;
  }

  std::size_t bytes_of_value() const {
    switch (type_->kind) {
      case nano::Kind::f64:
      case nano::Kind::i64:
        return 8 * static_cast<std::size_t>(type_->components);
      case nano::Kind::i16:
        return 2;
      case nano::Kind::bit:
        return 1;
      case nano::Kind::f32:
      case nano::Kind::i32:
      case nano::Kind::u32:
      case nano::Kind::quantised:
      case nano::Kind::quantised_by_leaf:
        return 4 * static_cast<std::size_t>(type_->components);
    }
    return 0;
  }
  std::size_t value_alignment() const { return value_bytes_ / static_cast<std::size_t>(type_->components); }

  // As roots and tiles hold it.
  Numbers value(std::uint64_t place) const {
    Numbers numbers{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(type_->components); ++i)
      numbers[i] = scalar(place + i * value_alignment());
    return numbers;
  }
  double scalar(std::uint64_t place) const {
    switch (type_->kind) {
      case nano::Kind::f64:
        return number<double>(place);
      case nano::Kind::i16:
        return number<std::int16_t>(place);
      case nano::Kind::i32:
        return number<std::int32_t>(place);
      case nano::Kind::i64:
        return static_cast<double>(number<std::int64_t>(place));
      case nano::Kind::u32:
        return number<std::uint32_t>(place);
      case nano::Kind::bit:
        return number<std::uint8_t>(place) & 1;
      case nano::Kind::f32:
      case nano::Kind::quantised:
      case nano::Kind::quantised_by_leaf:
        return static_cast<double>(number<float>(place));
    }
    return 0;
  }

  std::size_t bits_of_voxel(std::uint64_t leaf) const {
    if (type_->kind != nano::Kind::quantised_by_leaf) return type_->leaf_bits;
    const int power = number<std::uint8_t>(leaf + nano::leaf_flags_at) >> 5;
    if (power > 4) refuse_place();
    return std::size_t{1} << power;
  }
  Numbers voxel(std::uint64_t leaf, std::size_t n) const {
    const std::uint64_t values = leaf + type_->leaf_values;
    if (type_->kind == nano::Kind::bit) return {bit(values, n) ? 1.0 : 0.0, 0, 0};
    const std::size_t bits = bits_of_voxel(leaf);
    if (type_->kind != nano::Kind::quantised && type_->kind != nano::Kind::quantised_by_leaf)
      return value(values + n * bits / 8);
    std::uint32_t code = bits == 16 ? number<std::uint16_t>(values + 2 * n)
                                    : number<std::uint8_t>(values + n * bits / 8) >> (n * bits % 8);
    code &= (1u << bits) - 1;
    return {static_cast<double>(number<float>(leaf + nano::leaf_minimum_at)) +
                code * static_cast<double>(number<float>(leaf + nano::leaf_step_at)),
            0, 0};
  }

  void find_leaves() {
    std::uint64_t place = first_[Level::leaf];
    if (counts_[Level::leaf] > bytes_.size() / 96) refuse_place();
    for (std::uint32_t i = 0; i < counts_[Level::leaf]; ++i) {
      const std::size_t bits = bits_of_voxel(place);
      const std::size_t bytes = nano::aligned(std::max(type_->leaf_values + 64 * bits, std::size_t{96}));
      if (place > bytes_.size() || bytes > bytes_.size() - place) refuse_place();
      const VoxelCoord origin = origin_of(coord(place), 8);
      leaves_[key_of(origin, 3)] = {origin, place};
      place += bytes;
    }
  }
  void find_tiles() {
    const std::uint64_t root = first_[Level::root];
    const std::size_t align = value_alignment();
    background_ = value(root + nano::aligned(nano::root_background_after, align));
    add_tiles_of_nodes(Level::upper, 32, 128);
    add_tiles_of_nodes(Level::lower, 16, 8);
  }
  void add_tiles_of_nodes(Level level, std::size_t across, std::int32_t side) {
    const std::size_t children = across * across * across, mask = children / 8;
    const std::size_t tile = std::max<std::size_t>(8, nano::aligned(value_bytes_, 8));
    // The least, greatest and mean value and their deviation stand between masks and values.
    const std::size_t summary = type_->components == 3 && type_->kind == nano::Kind::f64 ? 64 : 32;
    const std::size_t values = nano::node_masks_at + 2 * mask + summary;
    const std::size_t bytes = nano::aligned(values + children * tile);
    if (counts_[level] > bytes_.size() / bytes) refuse_place();
    for (std::uint32_t i = 0; i < counts_[level]; ++i) {
      const std::uint64_t node = first_[level] + std::uint64_t{i} * bytes;
      const VoxelCoord origin = origin_of(coord(node), side * static_cast<std::int32_t>(across));
      for (std::size_t n = 0; n < children; ++n) {
        if (bit(node + nano::node_masks_at + mask, n)) continue;  // a node
        const bool active = bit(node + nano::node_masks_at, n);
        const Numbers found =
            type_->number == nano::mask_type ? Numbers{active ? 1.0 : 0.0} : value(node + values + n * tile);
        if (found == background_) continue;
        if (tiles_.size() == most_tiles)
          throw Refused(fmt::format("it has more than {} boxes of one value", most_tiles));
        const auto step = [&](std::size_t index) { return static_cast<std::int32_t>(index % across) * side; };
        const VoxelCoord at{origin[0] + step(n / (across * across)), origin[1] + step(n / across),
                            origin[2] + step(n)};
        tile_at_[key_of(at, side == 8 ? 3 : 7) << 1 | static_cast<std::uint64_t>(side == 8)] = tiles_.size();
        tiles_.push_back({at, side, found, active});
      }
    }
  }
  Found find(const VoxelCoord& at) const {
    const std::uint64_t key = key_of(at, 3);
    if (const auto leaf = leaves_.find(key); leaf != leaves_.end())
      return {.in_leaf = true, .leaf = leaf->second.place};
    if (tiles_.empty()) return {.value = background_};
    for (const std::uint64_t of_tile : {key << 1 | 1, key_of(at, 7) << 1})
      if (const auto tile = tile_at_.find(of_tile); tile != tile_at_.end())
        return {.value = tiles_[tile->second].value};
    return {.value = background_};
  }

  std::vector<char> bytes_;
  const nano::Type* type_ = nullptr;
  std::uint64_t tree_ = 0, first_[4]{};
  std::uint32_t counts_[3]{};
  std::size_t value_bytes_ = 0;
  Numbers background_{};
  std::unordered_map<std::uint64_t, Leaf> leaves_;
  std::vector<Tile> tiles_;
  std::unordered_map<std::uint64_t, std::size_t> tile_at_;
};

}  // namespace

GridResult read_nano(const std::string& path, const GridEntry& entry, std::uint64_t most_bytes,
                     const GridUse& use) {
  return result_or_error([&] {
    const NanoEntry& nano = *entry.nano;
    // The bytes of the file, those of the grid, and what is found of its nodes.
    if (nano.grid_bytes > most_bytes / 2 || nano.file_bytes > most_bytes) refuse_memory(most_bytes);
    std::vector<char> bytes = read_bytes(path, entry.place, nano.file_bytes);
    if (static_cast<nano::Codec>(nano.codec) != nano::Codec::none) {
      std::vector<char> packed = std::exchange(bytes, std::vector<char>(nano.grid_bytes));
      unpack(packed, static_cast<nano::Codec>(nano.codec), bytes);
    }
    return result_of(NanoGrid(std::move(bytes)), listed_name(path, entry), most_bytes, use);
  });
}

}  // namespace tyndall::import
