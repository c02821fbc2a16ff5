// The one file that knows OpenVDB, a module of its own (module.h says why).
#include <blosc.h>
#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/silence.h"
#include "import/vdb/make_voxels.h"
#include "import/vdb/module.h"
#include "import/vdb/nano.h"
#include "import/vdb/watched_file.h"

// OpenVDB's functions of these names believe the lengths that a file states, and write beyond their buffers.
// The module is searched before the library that it is linked with, so these are called instead.
namespace openvdb::OPENVDB_VERSION_NAME::io {

namespace {

// What stands for `size` bytes in the file: themselves (true), or compressed ones.
bool stands_as_it_is(std::istream& stream, char* data, std::size_t size, std::vector<char>& compressed) {
  std::int64_t length = 0;
  stream.read(reinterpret_cast<char*>(&length), sizeof length);
  // Of neither codec is a block that was made larger by it kept.
  const auto most = static_cast<std::int64_t>(size) + (std::int64_t{64} << 10);
  if (length <= 0 ? length != -static_cast<std::int64_t>(size) : length > most)
    throw std::runtime_error("a block of values has a length that is not possible");
  if (data == nullptr) return stream.seekg(std::abs(length), std::ios::cur), true;
  if (length <= 0) return stream.read(data, -length), true;
  compressed.resize(static_cast<std::size_t>(length));
  stream.read(compressed.data(), length);
  return false;
}

[[noreturn]] void refuse_block() { throw std::runtime_error("a compressed block of values is broken"); }

}  // namespace

void unzipFromStream(std::istream& stream, char* data, std::size_t size) {
  std::vector<char> compressed;
  if (stands_as_it_is(stream, data, size, compressed)) return;
  uLongf length = size;
  const int result = ::uncompress(reinterpret_cast<Bytef*>(data), &length,
                                  reinterpret_cast<const Bytef*>(compressed.data()), compressed.size());
  if (result != Z_OK || length != size) refuse_block();
}

void bloscFromStream(std::istream& stream, char* data, std::size_t size) {
  std::vector<char> compressed;
  if (stands_as_it_is(stream, data, size, compressed)) return;
  std::size_t length = 0;
  if (::blosc_cbuffer_validate(compressed.data(), compressed.size(), &length) != 0 || length != size ||
      ::blosc_decompress_ctx(compressed.data(), data, size, 1) != static_cast<int>(size))
    refuse_block();
}

}  // namespace openvdb::OPENVDB_VERSION_NAME::io

namespace tyndall::import {
namespace {

// openvdb::io::File reads through a stream of its own.
class Archive final : public openvdb::io::Archive {
 public:
  openvdb::GridBase::Ptr read(std::istream& stream, const GridEntry& entry) {
    readHeader(stream);
    setFormatVersion(stream);
    setLibraryVersion(stream);
    setDataCompression(stream);
    openvdb::io::GridDescriptor tree, own;
    openvdb::GridBase::Ptr grid = read_at(stream, entry.tree_place, tree);
    if (entry.place == entry.tree_place) return grid;
    // An instance: another name and place for the same tree.
    const openvdb::GridBase::Ptr instance = read_at(stream, entry.place, own);
    instance->setTree(grid->baseTreePtr());
    return instance;
  }

 private:
  static openvdb::GridBase::Ptr read_at(std::istream& stream, std::int64_t place,
                                        openvdb::io::GridDescriptor& descriptor) {
    stream.seekg(place);
    openvdb::GridBase::Ptr grid = descriptor.read(stream);
    descriptor.seekToGrid(stream);
    readGrid(grid, descriptor, stream);
    return grid;
  }
};

VoxelBox box_of(const openvdb::CoordBBox& box) {
  return {{box.min().x(), box.min().y(), box.min().z()}, {box.max().x(), box.max().y(), box.max().z()}};
}

// A grid of OpenVDB as make_voxels.h wants it.
template <class Grid>
class GridSource {
 public:
  using Value = typename Grid::ValueType;
  static constexpr bool is_vec = openvdb::VecTraits<Value>::IsVec;

  explicit GridSource(const Grid& grid) : grid_(grid) {}

  int components() const { return openvdb::VecTraits<Value>::Size; }
  Numbers background() const { return numbers(grid_.background()); }
  bool is_level_set() const { return grid_.getGridClass() == openvdb::GRID_LEVEL_SET; }
  std::int64_t active_voxels() const { return static_cast<std::int64_t>(grid_.activeVoxelCount()); }
  std::optional<VoxelBox> active_box() const {
    const openvdb::CoordBBox box = grid_.evalActiveVoxelBoundingBox();
    return box.empty() ? std::nullopt : std::optional(box_of(box));
  }
  Transform from_index() const {
    if (!grid_.transform().isLinear())
      throw Refused("its transform is a frustum: only linear ones are possible");
    // Of rows, which stand on the left of a matrix.
    const openvdb::Mat4d m = grid_.transform().baseMap()->getAffineMap()->getMat4();
    const auto row = [&](int i) { return Vec3d{m(i, 0), m(i, 1), m(i, 2)}; };
    return {row(0), row(1), row(2), row(3)};
  }

  template <class F>
  void for_each_leaf(F&& f) const {
    for (auto leaf = grid_.tree().cbeginLeaf(); leaf; ++leaf) f(box_of(leaf->getNodeBoundingBox()));
  }
  template <class F>
  void for_each_tile(F&& f) const {
    auto tile = grid_.tree().cbeginValueAll();
    tile.setMaxDepth(static_cast<openvdb::Index>(Grid::TreeType::DEPTH) - 2);
    for (; tile; ++tile) {
      openvdb::CoordBBox box;
      tile.getBoundingBox(box);
      f(box_of(box), numbers(tile.getValue()));
    }
  }
  template <class F>
  void for_each_active(F&& f) const {
    for (auto value = grid_.cbeginValueOn(); value; ++value)
      f(numbers(value.getValue()), value.getVoxelCount());
  }
  auto reader() const {
    return [accessor = grid_.getConstAccessor()](const VoxelCoord& at) mutable {
      return numbers(accessor.getValue(openvdb::Coord(at[0], at[1], at[2])));
    };
  }

 private:
  static Numbers numbers(const Value& value) {
    if constexpr (is_vec)
      return {static_cast<double>(value[0]), static_cast<double>(value[1]), static_cast<double>(value[2])};
    else
      return {static_cast<double>(value), 0, 0};
  }

  const Grid& grid_;
};

// The first type that the grid is of.
template <class... Grids>
GridResult result_of_any(const openvdb::GridBase& grid, const std::string& name, std::uint64_t most_bytes,
                         const GridUse& use) {
  GridResult result;
  const bool is_one =
      ((grid.isType<Grids>() &&
        (result = result_of(GridSource(static_cast<const Grids&>(grid)), name, most_bytes, use), true)) ||
       ...);
  if (!is_one) throw Refused(fmt::format("grids of type '{}' are not possible", grid.type()));
  return result;
}

GridResult read(const std::string& path, const GridEntry& entry, std::uint64_t most_bytes,
                const GridUse& use) {
  if (entry.nano) return read_nano(path, entry, most_bytes, use);
  return result_or_error([&] {
    const Silence silence;
    openvdb::initialize();
    WatchedFile bytes(path, most_bytes);
    std::istream stream(&bytes);
    stream.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
    const openvdb::GridBase::Ptr grid = Archive().read(stream, entry);
    using namespace openvdb;
    return result_of_any<FloatGrid, DoubleGrid, BoolGrid, Int32Grid, Int64Grid, MaskGrid, Vec3SGrid,
                         Vec3DGrid, Vec3IGrid>(*grid, listed_name(path, entry), most_bytes, use);
  });
}

}  // namespace
}  // namespace tyndall::import

extern "C" const tyndall::import::VdbModule tyndall_vdb{tyndall::import::read};
