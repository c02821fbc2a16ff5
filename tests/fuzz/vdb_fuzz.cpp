// Any bytes as an OpenVDB file: an error, or grids whose values are finite.
#include <cmath>

#include "base/check.h"
#include "file.h"
#include "import/vdb/vdb.h"

// OpenVDB's root node does not let go of the child that it is making when an exception leaves it, which is how
// every broken file ends: the leak checker is not to tell of that.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libopenvdb"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  const fuzz::File file(data, size);
  if (!file.whole()) return 0;
  for (const import::GridEntry& entry : import::list_grids(file.path()).grids) {
    if (!entry.supported) continue;
    const import::GridResult result = import::read_grid(file.path(), entry, std::uint64_t{64} << 20);
    CHECK(result.error.empty() == (result.grid != nullptr));
    if (!result.grid) continue;
    for (const VoxelsPointer& voxels : result.grid->components) {
      const VoxelRange range = voxels->range({}, voxels->size);
      CHECK(std::isfinite(range.lo) && std::isfinite(range.hi) && range.lo <= range.hi);
    }
  }
  return 0;
}
