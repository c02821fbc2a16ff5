#include "nano_writer.h"

#include <blosc.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <set>

namespace tyndall::import {

namespace {

// nanovdb/NanoVDB.h, version 32.
template <int log2>
struct Mask {
  std::uint64_t words[1 << (3 * log2 - 6)]{};
  void set(std::size_t n) { words[n / 64] |= std::uint64_t{1} << (n % 64); }
};
struct Map {
  float mat_f[9]{}, inverse_f[9]{}, vec_f[3]{}, taper_f = 1;
  double mat_d[9]{}, inverse_d[9]{}, vec_d[3]{}, taper_d = 1;
};
struct alignas(32) GridData {
  std::uint64_t magic = 0x304244566f6e614e, checksum = ~std::uint64_t{0};
  std::uint32_t version = 32u << 21 | 6u << 10, flags = 0, index = 0, count = 1;
  std::uint64_t size = 0;
  char name[256]{};
  Map map{};
  double world_box[6]{}, voxel[3]{};
  std::uint32_t grid_class = 2, type = 1;
  std::int64_t blind_offset = 0;
  std::uint32_t blind_count = 0, data0 = 0;
  std::uint64_t data1 = 0, data2 = 0;
};
static_assert(sizeof(GridData) == 672);
struct alignas(32) TreeData {
  std::uint64_t offsets[4]{};
  std::uint32_t nodes[3]{}, tiles[3]{};
  std::uint64_t voxels = 0;
};
static_assert(sizeof(TreeData) == 64);
template <class Value, class Stat>
struct alignas(32) Root {
  std::int32_t box[6];
  std::uint32_t tiles;
  Value background, least, most;
  Stat mean, deviation;
};
template <class Value>
struct alignas(32) RootTile {
  std::uint64_t key;
  std::int64_t child;
  std::uint32_t state;
  Value value;
};
template <class Value>
union Entry {
  Value value;
  std::int64_t child;
};
template <class Value, class Stat, int log2>
struct alignas(32) Node {
  std::int32_t box[6];
  std::uint64_t flags;
  Mask<log2> values, children;
  Value least, most;
  Stat mean, deviation;
  alignas(32) Entry<Value> table[1 << (3 * log2)];
};
struct LeafHead {
  std::int32_t first[3];
  std::uint8_t extent[3], flags;
  Mask<3> values;
};
template <class Value, class Stat>
struct alignas(32) Leaf {
  LeafHead head;
  Value least, most;
  Stat mean, deviation;
  alignas(32) Value voxels[512];
};
struct alignas(32) MaskLeaf {
  LeafHead head;
  std::uint64_t padding[2];
};
struct alignas(32) BoolLeaf {
  LeafHead head;
  Mask<3> voxels;
  std::uint64_t padding[2];
};
struct alignas(32) CodedLeaf {
  LeafHead head;
  float least, step;
  std::uint16_t statistics[4];
};
static_assert(sizeof(CodedLeaf) == 96);

using Vec3f = std::array<float, 3>;
using Vec3 = std::array<double, 3>;

template <class T>
T value_of(double number) {
  if constexpr (std::is_same_v<T, Vec3f> || std::is_same_v<T, Vec3>)
    return {static_cast<typename T::value_type>(number), static_cast<typename T::value_type>(number + 1),
            static_cast<typename T::value_type>(number + 2)};
  else if constexpr (std::is_same_v<T, bool>)
    return number > 0;
  else
    return static_cast<T>(number);
}

template <class T>
std::string bytes_of(const T& object) {
  return {reinterpret_cast<const char*>(&object), sizeof object};
}
// Not a copy: a node may be large.
template <class T>
T& put(std::string& bytes, std::size_t place) {
  return *reinterpret_cast<T*>(bytes.data() + place);
}

VoxelCoord origin(const VoxelCoord& at, int side) {
  return {at[0] & ~(side - 1), at[1] & ~(side - 1), at[2] & ~(side - 1)};
}
std::size_t place_in(const VoxelCoord& at, int log2_side, int log2_child) {
  std::size_t place = 0;
  for (const std::int32_t n : at)
    place = place << log2_side | static_cast<std::size_t>(n >> log2_child & ((1 << log2_side) - 1));
  return place;
}

// A leaf with its 512 values.
template <class Value, class Stat>
std::string leaf_of(const NanoFixture& fixture, const LeafHead& head, const std::vector<double>& numbers) {
  const auto coded = [&](int bits, std::uint8_t flags) {
    CodedLeaf leaf{};
    leaf.head = head;
    leaf.head.flags = flags;
    const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
    leaf.least = static_cast<float>(*least);
    leaf.step = static_cast<float>((*most - *least) / ((1 << bits) - 1));
    std::string codes(static_cast<std::size_t>(64 * bits), '\0');
    for (std::size_t n = 0; n < 512; ++n) {
      const double steps = leaf.step > 0 ? (numbers[n] - *least) / static_cast<double>(leaf.step) : 0;
      const auto code = static_cast<std::uint32_t>(std::lround(steps));
      for (std::size_t b = 0; b < static_cast<std::size_t>(bits); ++b)
        if (code >> b & 1)
          codes[(n * static_cast<std::size_t>(bits) + b) / 8] |=
              static_cast<char>(1 << (n * static_cast<std::size_t>(bits) + b) % 8);
    }
    return bytes_of(leaf) + codes;
  };
  switch (fixture.type) {
    case NanoType::mask: {
      MaskLeaf leaf{};
      leaf.head = head;
      return bytes_of(leaf);
    }
    case NanoType::boolean: {
      BoolLeaf leaf{};
      leaf.head = head;
      for (std::size_t n = 0; n < 512; ++n)
        if (numbers[n] > 0) leaf.voxels.set(n);
      return bytes_of(leaf);
    }
    case NanoType::fp4:
      return coded(4, 0);
    case NanoType::fp8:
      return coded(8, 0);
    case NanoType::fp16:
      return coded(16, 0);
    case NanoType::fpn: {  // leaves take different widths
      const int power = 2 + (head.first[0] >> 3 & 1) + (head.first[1] >> 3 & 1);
      return coded(1 << power, static_cast<std::uint8_t>(power << 5));
    }
    default: {
      const auto leaf = std::make_unique<Leaf<Value, Stat>>();
      leaf->head = head;
      for (std::size_t n = 0; n < 512; ++n) leaf->voxels[n] = value_of<Value>(numbers[n]);
      return bytes_of(*leaf);
    }
  }
}

template <class Value, class Stat>
std::string grid_of(const NanoFixture& fixture, std::uint32_t type) {
  // What leaves and nodes there are, by origin.
  std::map<VoxelCoord, std::string> leaves;
  std::uint64_t voxels = 0;
  for (int x = fixture.first[0] & ~7; x <= fixture.last[0]; x += 8)
    for (int y = fixture.first[1] & ~7; y <= fixture.last[1]; y += 8)
      for (int z = fixture.first[2] & ~7; z <= fixture.last[2]; z += 8) {
        LeafHead head{{x, y, z}, {7, 7, 7}, 0, {}};
        // The coordinate of a leaf is that of the first active voxel, anywhere in it.
        for (std::size_t i = 0; i < 3; ++i) head.first[i] = std::max(head.first[i], fixture.first[i]);
        std::vector<double> numbers(512, fixture.background);
        for (std::size_t n = 0; n < 512; ++n) {
          const VoxelCoord at{x + static_cast<int>(n >> 6), y + static_cast<int>(n >> 3 & 7),
                              z + static_cast<int>(n & 7)};
          bool active = true;
          for (std::size_t i = 0; i < 3; ++i) active &= at[i] >= fixture.first[i] && at[i] <= fixture.last[i];
          if (!active) continue;
          ++voxels;
          head.values.set(n);
          numbers[n] = fixture.value(at[0], at[1], at[2]);
        }
        leaves[{x, y, z}] = leaf_of<Value, Stat>(fixture, head, numbers);
      }
  std::set<VoxelCoord> lowers, uppers;
  for (const auto& [at, leaf] : leaves) lowers.insert(origin(at, 128));
  for (const NanoFixture::Tile& tile : fixture.tiles) {
    if (tile.side == 8) lowers.insert(origin(tile.origin, 128));
    uppers.insert(origin(tile.origin, 4096));
  }
  for (const VoxelCoord& at : lowers) uppers.insert(origin(at, 4096));

  using Lower = Node<Value, Stat, 4>;
  using Upper = Node<Value, Stat, 5>;
  using RootNode = Root<Value, Stat>;
  const std::size_t root = sizeof(GridData) + sizeof(TreeData),
                    upper = root + sizeof(RootNode) + uppers.size() * sizeof(RootTile<Value>),
                    lower = upper + uppers.size() * sizeof(Upper),
                    leaf = lower + lowers.size() * sizeof(Lower);
  std::string bytes(leaf, '\0');
  std::map<VoxelCoord, std::size_t> leaf_at, lower_at, upper_at;
  for (const auto& [at, text] : leaves) {
    leaf_at[at] = bytes.size();
    bytes += text;
  }
  for (const VoxelCoord& at : lowers) lower_at.emplace(at, lower + lower_at.size() * sizeof(Lower));
  for (const VoxelCoord& at : uppers) upper_at.emplace(at, upper + upper_at.size() * sizeof(Upper));

  GridData grid;
  grid.size = bytes.size();
  std::strncpy(grid.name, fixture.name.c_str(), sizeof grid.name - 1);
  grid.type = type;
  if (fixture.level_set) grid.grid_class = 1;
  const Transform& t = fixture.local_from_index;
  const Vec3d* const columns[] = {&t.x, &t.y, &t.z};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) grid.map.mat_d[3 * r + c] = (*columns[c])[r];
    grid.map.vec_d[r] = t.t[r];
  }
  TreeData tree;
  const std::size_t places[] = {leaf, lower, upper, root};
  for (std::size_t i = 0; i < 4; ++i) tree.offsets[i] = places[i] - sizeof(GridData);
  tree.nodes[0] = static_cast<std::uint32_t>(leaves.size());
  tree.nodes[1] = static_cast<std::uint32_t>(lowers.size());
  tree.nodes[2] = static_cast<std::uint32_t>(uppers.size());
  tree.voxels = voxels;
  std::memcpy(bytes.data(), &grid, sizeof grid);
  std::memcpy(bytes.data() + sizeof grid, &tree, sizeof tree);
  auto& root_node = put<RootNode>(bytes, root);
  for (std::size_t i = 0; i < 3; ++i) {
    root_node.box[i] = fixture.first[i];
    root_node.box[i + 3] = fixture.last[i];
  }
  for (const NanoFixture::Tile& tile : fixture.tiles)
    for (std::size_t i = 0; i < 3; ++i) {
      root_node.box[i] = std::min(root_node.box[i], tile.origin[i]);
      root_node.box[i + 3] = std::max(root_node.box[i + 3], tile.origin[i] + tile.side - 1);
    }
  root_node.tiles = static_cast<std::uint32_t>(uppers.size());
  root_node.background = value_of<Value>(fixture.background);
  std::size_t tile_at = root + sizeof(RootNode);
  for (const auto& [at, place] : upper_at) {
    auto& tile = put<RootTile<Value>>(bytes, tile_at);
    tile.child = static_cast<std::int64_t>(place - root);
    tile_at += sizeof tile;
  }
  const auto begin_node = [&](auto& node, const VoxelCoord& at) {
    for (std::size_t i = 0; i < 3; ++i) node.box[i] = at[i] + 1;  // somewhere within
    for (auto& entry : node.table) entry.value = value_of<Value>(fixture.background);
  };
  for (const auto& [at, place] : upper_at) begin_node(put<Upper>(bytes, place), at);
  for (const auto& [at, place] : lower_at) {
    begin_node(put<Lower>(bytes, place), at);
    const std::size_t above = upper_at.at(origin(at, 4096)), n = place_in(at, 5, 7);
    put<Upper>(bytes, above).children.set(n);
    put<Upper>(bytes, above).table[n].child = static_cast<std::int64_t>(place - above);
  }
  for (const auto& [at, place] : leaf_at) {
    const std::size_t above = lower_at.at(origin(at, 128)), n = place_in(at, 4, 3);
    put<Lower>(bytes, above).children.set(n);
    put<Lower>(bytes, above).table[n].child = static_cast<std::int64_t>(place - above);
  }
  for (const NanoFixture::Tile& tile : fixture.tiles) {
    const bool small = tile.side == 8;
    const auto set = [&](auto& node, std::size_t n) {
      node.values.set(n);
      node.table[n].value = value_of<Value>(tile.value);
    };
    if (small)
      set(put<Lower>(bytes, lower_at.at(origin(tile.origin, 128))), place_in(tile.origin, 4, 3));
    else
      set(put<Upper>(bytes, upper_at.at(origin(tile.origin, 4096))), place_in(tile.origin, 5, 7));
  }
  return bytes;
}

// nanovdb/io/IO.h
struct FileHeader {
  std::uint64_t magic = 0x304244566f6e614e;
  std::uint32_t version = 32u << 21 | 6u << 10;
  std::uint16_t grids = 0;
  NanoCodec codec{};
};
struct FileMetaData {
  std::uint64_t grid_size, file_size, name_key, voxels;
  std::uint32_t type, grid_class;
  double world_box[6];
  std::int32_t index_box[6];
  double voxel[3];
  std::uint32_t name_size, nodes[4], tiles[3];
  NanoCodec codec;
  std::uint16_t padding;
  std::uint32_t version;
};
static_assert(sizeof(FileMetaData) == 176);

std::string packed(const std::string& bytes, NanoCodec codec) {
  if (codec == NanoCodec::none) return bytes;
  const auto block = [](const std::string& data) { return bytes_of<std::uint64_t>(data.size()) + data; };
  if (codec == NanoCodec::zip) {
    uLongf size = ::compressBound(bytes.size());
    std::string out(size, '\0');
    ::compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               bytes.size());
    return block(out.substr(0, size));
  }
  std::string all;
  constexpr std::size_t most = 100'000;  // several blocks
  for (std::size_t begin = 0; begin < bytes.size(); begin += most) {
    const std::size_t count = std::min(most, bytes.size() - begin);
    std::string out(count + BLOSC_MAX_OVERHEAD, '\0');
    const int size = ::blosc_compress_ctx(9, 1, sizeof(float), count, bytes.data() + begin, out.data(),
                                          out.size(), "lz4", 0, 1);
    all += block(out.substr(0, static_cast<std::size_t>(size)));
  }
  return all;
}

std::uint32_t number_of(NanoType type) {
  constexpr std::uint32_t numbers[] = {1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 13, 14, 15, 16};
  return numbers[static_cast<std::size_t>(type)];
}

}  // namespace

std::string nano_grid(const NanoFixture& fixture) {
  const std::uint32_t type = number_of(fixture.type);
  switch (fixture.type) {
    case NanoType::double_:
      return grid_of<double, double>(fixture, type);
    case NanoType::int16:
      return grid_of<std::int16_t, float>(fixture, type);
    case NanoType::int32:
      return grid_of<std::int32_t, float>(fixture, type);
    case NanoType::int64:
      return grid_of<std::int64_t, double>(fixture, type);
    case NanoType::uint32:
      return grid_of<std::uint32_t, float>(fixture, type);
    case NanoType::vec3f:
      return grid_of<Vec3f, float>(fixture, type);
    case NanoType::vec3d:
      return grid_of<Vec3, double>(fixture, type);
    case NanoType::mask:
    case NanoType::boolean:
      return grid_of<bool, float>(fixture, type);
    default:
      return grid_of<float, float>(fixture, type);
  }
}

namespace {

std::string file_of(const std::vector<NanoFixture>& fixtures, const std::vector<std::string>& bytes,
                    NanoCodec codec) {
  FileHeader header;
  header.grids = static_cast<std::uint16_t>(fixtures.size());
  header.codec = codec;
  std::string entries, grids;
  for (std::size_t i = 0; i < fixtures.size(); ++i) {
    const std::string data = packed(bytes[i], codec);
    FileMetaData entry{};
    entry.grid_size = bytes[i].size();
    entry.file_size = data.size();
    entry.type = number_of(fixtures[i].type);
    entry.name_size = static_cast<std::uint32_t>(fixtures[i].name.size() + 1);
    entry.codec = codec;
    entry.version = header.version;
    entries += bytes_of(entry) + fixtures[i].name + '\0';
    grids += data;
  }
  return bytes_of(header) + entries + grids;
}

}  // namespace

std::string nano_file(const std::vector<NanoFixture>& fixtures, NanoCodec codec) {
  std::vector<std::string> bytes;
  for (const NanoFixture& fixture : fixtures) bytes.push_back(nano_grid(fixture));
  return file_of(fixtures, bytes, codec);
}

std::string nano_file_of(const NanoFixture& fixture, const std::string& grid, NanoCodec codec) {
  return file_of({fixture}, {grid}, codec);
}

}  // namespace tyndall::import
