#include "tools/inspect_grids.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "import/vdb/vdb.h"
#include "resolve/grids.h"
#include "tools/report.h"

namespace tyndall::tools {

namespace {

using import::GridEntry;
using import::GridResult;

struct Summary {
  VoxelRange range{};
  std::uint64_t bytes = 0;
  Vec3d voxels;  // of the active box
};
Summary summary_of(const VoxelGrid& grid) {
  Summary summary;
  summary.range = grid.components[0]->levels.back().ranges[0];
  for (const VoxelsPointer& voxels : grid.components) {
    summary.range.add(voxels->levels.back().ranges[0]);
    summary.bytes += voxels->bytes();
  }
  summary.voxels = grid.last_active - grid.first_active + Vec3d(1);
  return summary;
}

std::string text_of(const GridEntry& entry, const GridResult& result) {
  const Summary s = summary_of(*result.grid);
  const Vec3d low = result.grid->local_from_voxels.point(result.grid->first_active);
  return fmt::format(
      "{}\n"
      "  type           {}{}\n"
      "  voxel          {:.6g} x {:.6g} x {:.6g}{}\n"
      "  active voxels  {} in {} x {} x {}, the first at ({:.6g}, {:.6g}, {:.6g})\n"
      "  values         {:.6g} to {:.6g}\n"
      "  memory         {:.1f} MB\n",
      entry.name, entry.type, result.is_level_set ? ", a level set, read as 1 inside and 0 outside" : "",
      result.voxel[0], result.voxel[1], result.voxel[2], result.is_rotated ? ", not along the axes" : "",
      result.active_voxels, s.voxels.x, s.voxels.y, s.voxels.z, low.x, low.y, low.z, s.range.lo, s.range.hi,
      static_cast<double>(s.bytes) / 1e6);
}

nlohmann::json json_of(const GridEntry& entry, const GridResult& result) {
  const Summary s = summary_of(*result.grid);
  const Vec3d low = result.grid->local_from_voxels.point(result.grid->first_active);
  return {{"name", entry.name},
          {"type", entry.type},
          {"level_set", result.is_level_set},
          {"voxel_size", result.voxel},
          {"along_axes", !result.is_rotated},
          {"active_voxels", result.active_voxels},
          {"active_box", {s.voxels.x, s.voxels.y, s.voxels.z}},
          {"first_voxel", {low.x, low.y, low.z}},
          {"range", {s.range.lo, s.range.hi}},
          {"bytes", s.bytes}};
}

}  // namespace

bool is_grid_file(const std::string& path) { return path.ends_with(".vdb") || path.ends_with(".nvdb"); }

ExitStatus inspect_grids(const std::string& path, bool json) {
  const import::GridList list = import::list_grids(path);
  nlohmann::json grids = nlohmann::json::array();
  std::string error = list.error;
  for (const GridEntry& entry : list.grids) {
    if (!entry.supported) {
      if (json)
        grids.push_back({{"name", entry.name}, {"type", entry.type}, {"error", "cannot be looked up"}});
      else
        print_result(
            fmt::format("{}\n  type           {}, which cannot be looked up\n", entry.name, entry.type));
      continue;
    }
    const GridResult result = import::read_grid(path, entry, resolve::max_grid_bytes);
    if (!result.error.empty())
      error = result.error;
    else if (json)
      grids.push_back(json_of(entry, result));
    else
      print_result(text_of(entry, result));
  }
  if (json && error.empty()) print_json({{"file", path}, {"grids", grids}});
  if (error.empty()) return ExitStatus::done;
  print_error(error);
  return ExitStatus::problem;
}

}  // namespace tyndall::tools
