// The grids of a scene: found beside the file that names them, read once something looks them up.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "eval/grids.h"
#include "import/vdb/vdb.h"

namespace tyndall::resolve {

struct Run;
struct KeptParts;

// Memory of all grids of a scene.
inline constexpr std::uint64_t max_grid_bytes = std::uint64_t{4} << 30;

class Grids final : public eval::GridReader {
 public:
  explicit Grids(Run& run) : run_(run) {}

  std::string find(const std::string& file, Span file_span, const std::string& name, Span name_span,
                   eval::Holding holding) override;
  VoxelGridPointer read(const eval::Grid& grid, eval::LookedUpAt place) override;
  VoxelGridPointer read_velocity(const eval::Grid& grid) override;

  // Those that bodies looked up since the last call, each once; none when one was looked up elsewhere than at
  // p.
  std::vector<eval::Grid> looked_up_since();

  struct Known {
    std::map<std::string, import::GridList> lists;  // by path
    std::map<std::tuple<std::string, std::string, import::GridUse>, VoxelGridPointer>
        grids;  // by path, name and use
  };
  // What another run of the same scene has read.
  void share(const Grids& other) { known_ = other.known_; }
  // Gives the next frame what this one looked up.
  void keep_in(KeptParts& parts);
  // While nothing will be rendered from what is evaluated, lookups are in stand-ins and no grid is read.
  void stand_in(bool on) { stand_in_ = on; }

 private:
  VoxelGridPointer looked_up(const eval::Grid& grid, const std::string& name, const import::GridUse& use);
  VoxelGridPointer read_now(const eval::Grid& grid, const std::string& name, const import::GridUse& use);

  Run& run_;
  // The frame before's; null: none.
  const import::GridList* kept_list(const std::string& path) const;
  // The frame before's, while there is memory for it; null: not kept.
  VoxelGridPointer take_kept(const eval::Grid& grid, const std::string& name, const import::GridUse& use);

  Known known_;
  std::uint64_t bytes_left_ = max_grid_bytes;
  std::vector<eval::Grid> looked_up_;
  bool elsewhere_ = false;
  bool stand_in_ = false;
};

}  // namespace tyndall::resolve
