// What the compiled scene of a frame leaves to that of the next: what takes a while to make and is a function
// of parts of the scene that seldom change. Whoever takes something over has what it would have made.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/reuse.h"
#include "compile/compiled_scene.h"
#include "compile/geometry/mesh.h"
#include "compile/majorant/majorant_grid.h"
#include "optics/albedo_tables.h"
#include "optics/sky.h"

namespace tyndall::compile {

struct Kept {
  std::vector<CompiledMesh> meshes;
  std::vector<CompiledMedium> media;  // that the grids refer to
  std::vector<std::unique_ptr<MajorantGrid>> grids;
  std::vector<std::shared_ptr<const optics::Sky>> skies;
  std::shared_ptr<const optics::AlbedoTables> albedo_tables;
  std::vector<double> etas;  // of the tables

  // Of the scene that was compiled last: meshes with their trees; grids of bounds.
  Reuse reused_meshes, reused_grids;

  // What nobody has taken over. Tables, which are small, stay.
  void forget_the_rest() {
    meshes.clear();
    grids.clear();
    media.clear();
  }
};

// Takes out of a scene, which is done with, what another frame may use.
void keep(CompiledScene& world, Kept& kept);

// The scene's meshes ready for rays.
std::vector<CompiledMesh> compiled_meshes(const std::vector<scene::SharedMesh>& meshes, Kept& kept);
// With its bricks as far as they were made, and surveyed; null: there is none of such a medium and domain.
std::unique_ptr<MajorantGrid> kept_grid(const scene::Medium& medium, const MajorantGrid::Domain& domain,
                                        Kept& kept);
std::shared_ptr<const optics::AlbedoTables> albedo_tables(std::vector<double> etas, Kept& kept);

}  // namespace tyndall::compile
