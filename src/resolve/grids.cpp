#include "resolve/grids.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "resolve/kept_parts.h"

namespace tyndall::resolve {

namespace {

// A grid of nothing, of numbers or vecs.
VoxelGridPointer empty_grid(bool is_vec) {
  VoxelGrid grid;
  const VoxelsPointer nothing = VoxelsBuilder({1, 1, 1}, 0).finish("", nullptr);
  grid.components.assign(is_vec ? 3 : 1, nothing);
  return std::make_shared<const VoxelGrid>(std::move(grid));
}

std::uint64_t bytes_of(const VoxelGrid& grid) {
  std::uint64_t bytes = 0;
  for (const VoxelsPointer& voxels : grid.components) bytes += voxels->bytes();
  return bytes;
}

}  // namespace

std::string Grids::find(const std::string& file, Span file_span, const std::string& name, Span name_span,
                        eval::Holding holding) {
  const auto path = find_file(run_, "file of grids", file, file_span);
  if (!path) return {};
  std::error_code failed;
  if (!std::filesystem::is_regular_file(*path, failed)) {
    run_.diagnostics.error(file_span, fmt::format("cannot read '{}': it is not a file", file));
    return {};
  }
  const auto [known, is_new] = known_.lists.try_emplace(path->string());
  import::GridList& list = known->second;
  if (is_new) {
    const import::GridList* before = kept_list(path->string());
    list = before ? *before : import::list_grids(path->string());
  }
  if (!list.error.empty()) {
    run_.diagnostics.error(file_span, list.error);
    return {};
  }
  const std::string has = list.grids.empty() ? "it has none" : "it has: " + import::names_of(list);
  const import::GridEntry* entry = import::find_grid(list, name);
  if (!entry) {
    run_.diagnostics.error(name_span, fmt::format("'{}' has no grid '{}'", file, name), has);
    return {};
  }
  if (!entry->supported) {
    run_.diagnostics.error(
        name_span, fmt::format("grid '{}' is of type '{}', which cannot be looked up", name, entry->type),
        has + "; numbers, bools and vecs of three can be");
    return {};
  }
  if (holding == eval::Holding::vecs && !entry->is_vec) {
    run_.diagnostics.error(
        name_span, fmt::format("grid '{}' is of type '{}': velocities are vecs", name, entry->type), has);
    return {};
  }
  return path->string();
}

std::vector<eval::Grid> Grids::looked_up_since() {
  std::vector<eval::Grid> grids = std::exchange(looked_up_, {});
  if (std::exchange(elsewhere_, false)) grids.clear();
  return grids;
}

VoxelGridPointer Grids::read(const eval::Grid& grid, eval::LookedUpAt place) {
  elsewhere_ |= place == eval::LookedUpAt::elsewhere;
  const bool again = std::any_of(looked_up_.begin(), looked_up_.end(), [&](const eval::Grid& other) {
    return other.path == grid.path && other.name == grid.name && other.filter == grid.filter &&
           other.velocity == grid.velocity && other.max_speed == grid.max_speed;
  });
  if (place == eval::LookedUpAt::p && !again) looked_up_.push_back(grid);
  return looked_up(grid, grid.name, {});
}

VoxelGridPointer Grids::read_velocity(const eval::Grid& grid) {
  return looked_up(grid, grid.velocity, {.is_velocity = true, .max_speed = grid.max_speed});
}

VoxelGridPointer Grids::looked_up(const eval::Grid& grid, const std::string& name,
                                  const import::GridUse& use) {
  if (stand_in_) return empty_grid(import::find_grid(known_.lists[grid.path], name)->is_vec);
  const auto [known, is_new] = known_.grids.try_emplace({grid.path, name, use});
  if (!is_new) return known->second;
  known->second = take_kept(grid, name, use);
  const bool is_kept = known->second != nullptr;
  if (run_.options.kept) run_.options.kept->files.count(is_kept);
  if (!is_kept) known->second = read_now(grid, name, use);
  if (!known->second) return nullptr;
  const std::uint64_t bytes = bytes_of(*known->second);
  bytes_left_ -= std::min(bytes_left_, bytes);
  note_asset(run_, {grid.path, "grid", name}, bytes);
  return known->second;
}

const import::GridList* Grids::kept_list(const std::string& path) const {
  const KeptParts* kept = kept_parts(run_);
  if (!kept) return nullptr;
  const auto before = kept->grids.lists.find(path);
  return before == kept->grids.lists.end() ? nullptr : &before->second;
}

VoxelGridPointer Grids::take_kept(const eval::Grid& grid, const std::string& name,
                                  const import::GridUse& use) {
  const KeptParts* kept = kept_parts(run_);
  if (!kept) return nullptr;
  const auto before = kept->grids.grids.find({grid.path, name, use});
  return before != kept->grids.grids.end() && bytes_of(*before->second) <= bytes_left_ ? before->second
                                                                                       : nullptr;
}

void Grids::keep_in(KeptParts& parts) {
  std::erase_if(known_.grids, [](const auto& known) { return !known.second; });  // not to be read
  std::erase_if(known_.lists, [](const auto& known) { return !known.second.error.empty(); });
  parts.grids = known_;
}

VoxelGridPointer Grids::read_now(const eval::Grid& grid, const std::string& name,
                                 const import::GridUse& use) {
  const import::GridEntry& entry = *import::find_grid(known_.lists[grid.path], name);
  const import::GridResult result = import::read_grid(grid.path, entry, bytes_left_, use);
  if (!result.error.empty()) {
    run_.diagnostics.error(grid.span, result.error);
    return nullptr;
  }
  if (result.not_finite > 0)
    run_.diagnostics.warning(grid.span,
                             fmt::format("grid '{}' holds {} value{} that are not finite, or beyond 1e30",
                                         name, result.not_finite, result.not_finite == 1 ? "" : "s"),
                             "they count as 0");
  if (result.slowed > 0 && use.max_speed == 0)
    run_.diagnostics.warning(
        grid.span,
        fmt::format("grid '{}' has {} velocit{} far beyond the others, up to {:.4g} m/s", name, result.slowed,
                    result.slowed == 1 ? "y" : "ies", result.fastest),
        fmt::format(
            "they are cut to {0:.4g} m/s; write max_speed: {1:.4g} to keep them, or max_speed: {0:.4g} "
            "to cut them without a warning",
            result.speed_limit, result.fastest));
  return result.grid;
}

}  // namespace tyndall::resolve
