#include "compile/kept.h"

#include <algorithm>
#include <utility>

#include "compile/geometry/geometry.h"

namespace tyndall::compile {

namespace {

// Whether grids of bounds of the two, where their domains are the same, are the same.
bool bound_alike(const scene::Medium& a, const scene::Medium& b) {
  const auto same_given = [](const scene::GivenNumber& x, const scene::GivenNumber& y) {
    return x.output == y.output && x.scales == y.scales && x.branches.size() == y.branches.size() &&
           x.branch_output == y.branch_output;
  };
  return a.full.fingerprint != 0 && a.full.fingerprint == b.full.fingerprint && a.sigma_t == b.sigma_t &&
         a.sigma_s == b.sigma_s && a.emission == b.emission &&
         std::equal(a.given.begin(), a.given.end(), b.given.begin(), b.given.end(), same_given);
}

}  // namespace

void keep(CompiledScene& world, Kept& kept) {
  const auto meshes = world.geometry->parts().meshes;
  kept.meshes.assign(meshes.begin(), meshes.end());
  kept.grids = std::move(world.grids);
  kept.media = std::move(world.media);
}

std::vector<CompiledMesh> compiled_meshes(const std::vector<scene::SharedMesh>& meshes, Kept& kept) {
  std::vector<CompiledMesh> out;
  out.reserve(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    // Mostly it stands where it stood.
    const bool stays = i < kept.meshes.size() && kept.meshes[i].is_like(meshes[i]);
    kept.reused_meshes.count(stays);
    if (stays)
      out.push_back(kept.meshes[i].made_of(meshes[i]));
    else
      out.emplace_back(meshes[i]);
  }
  return out;
}

std::unique_ptr<MajorantGrid> kept_grid(const scene::Medium& medium, const MajorantGrid::Domain& domain,
                                        Kept& kept) {
  const bool varies_in_time = medium.full.reads(vm::Input::time);
  for (std::unique_ptr<MajorantGrid>& grid : kept.grids) {
    if (!grid || !bound_alike(grid->medium(), medium)) continue;
    MajorantGrid::Domain before = grid->domain();
    if (!varies_in_time) before.time = domain.time;
    if (!(before == domain)) continue;
    grid->refer_to(medium);
    return std::move(grid);
  }
  return nullptr;
}

std::shared_ptr<const optics::AlbedoTables> albedo_tables(std::vector<double> etas, Kept& kept) {
  if (kept.albedo_tables && kept.etas == etas) return kept.albedo_tables;
  kept.albedo_tables = std::make_shared<const optics::AlbedoTables>(etas);
  kept.etas = std::move(etas);
  return kept.albedo_tables;
}

}  // namespace tyndall::compile
