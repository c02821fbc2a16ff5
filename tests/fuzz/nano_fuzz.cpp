// NanoVDB files of every type and packing with any bytes changed: an error, or grids whose values are finite.
//
// A grid's tables of nodes alone are a third of a megabyte, and packed ones have checksums. So the bytes are
// not a file but what is done to one: its type, packing and kind, a length to cut it off at, and changes,
// before it is packed or after.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <span>

#include "base/check.h"
#include "file.h"
#include "import/nano_writer.h"
#include "import/vdb/vdb.h"

namespace {

using namespace tyndall;

// Numbers of the input in order; zeros where it has ended.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  bool ended() const { return left_.empty(); }
  std::uint64_t next(std::size_t bytes) {
    std::uint64_t number = 0;
    const std::size_t count = std::min(bytes, left_.size());
    if (count > 0) std::memcpy(&number, left_.data(), count);
    left_ = left_.subspan(count);
    return number;
  }

 private:
  std::span<const std::uint8_t> left_;
};

struct Change {
  bool packed = false;  // of the file; else of the grid before it is packed
  std::size_t place = 0, count = 1;
  std::uint64_t number = 0;

  void make(std::string& bytes) const {
    if (bytes.empty()) return;
    const std::size_t from = place % bytes.size();
    std::memcpy(bytes.data() + from, &number, std::min(count, bytes.size() - from));
  }
};

Change change_of(Bytes& input) {
  const std::uint64_t how = input.next(1);
  Change change;
  change.packed = (how & 1) != 0;
  change.count = std::size_t{1} << (how >> 1 & 3);
  // Most of what is checked stands at the begin, the rest at multiples of the nodes' sizes.
  change.place = (how & 8) != 0 ? input.next(3) * 4 : input.next(2) % 1200;
  change.number = input.next(change.count);
  return change;
}

const std::string& grid_of(const import::NanoFixture& fixture, std::uint64_t kind) {
  static std::map<std::uint64_t, std::string> made;
  std::string& grid = made[kind];
  if (grid.empty()) grid = import::nano_grid(fixture);
  return grid;
}

void read_all(const std::string& bytes, bool is_velocity) {
  const fuzz::File file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (!file.whole()) return;
  for (const import::GridEntry& entry : import::list_grids(file.path()).grids) {
    if (!entry.supported) continue;
    const import::GridResult result =
        import::read_grid(file.path(), entry, std::uint64_t{64} << 20, {.is_velocity = is_velocity});
    CHECK(result.error.empty() == (result.grid != nullptr));
    if (!result.grid) continue;
    CHECK(result.active_voxels >= 0);
    for (const VoxelsPointer& voxels : result.grid->components) {
      const VoxelRange range = voxels->range({}, voxels->size);
      CHECK(std::isfinite(range.lo) && std::isfinite(range.hi) && range.lo <= range.hi);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes input({data, size});
  import::NanoFixture fixture;
  const std::uint64_t first = input.next(1), type = first % import::nano_types, kind = input.next(1);
  fixture.type = static_cast<import::NanoType>(type);
  fixture.last = {9, 7, 10};
  fixture.level_set = (kind & 1) != 0 && fixture.type != import::NanoType::uint32;
  if (!fixture.level_set) fixture.value = [](int x, int y, int z) { return 20 + x + 0.5 * y - 0.25 * z; };
  if ((kind & 2) != 0) fixture.tiles = {{{-8, 16, 8}, 8, 3}};
  // Rarely: the voxels at its sides take a third of a second.
  const bool wide = first >= 253;
  if (wide) fixture.tiles.push_back({{128, 0, -128}, 128, 4});
  const bool is_velocity = (kind & 4) != 0, cut = (kind & 8) != 0;
  const auto codec = static_cast<import::NanoCodec>((kind >> 4) % 3);
  const std::uint64_t length = cut ? input.next(3) : 0;

  std::string grid = grid_of(fixture, type << 3 | (wide ? 4 : 0) | (kind & 3));
  std::vector<Change> changes;
  while (!input.ended()) changes.push_back(change_of(input));
  for (const Change& change : changes)
    if (!change.packed) change.make(grid);
  std::string bytes = import::nano_file_of(fixture, grid, codec);
  for (const Change& change : changes)
    if (change.packed) change.make(bytes);
  if (cut) bytes.resize(std::min<std::size_t>(bytes.size(), length));
  read_all(bytes, is_velocity);
  return 0;
}
