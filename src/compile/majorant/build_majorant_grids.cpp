#include "compile/majorant/build_majorant_grids.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/check.h"
#include "base/numerics.h"
#include "base/overloaded.h"
#include "compile/geometry/geometry.h"
#include "compile/kept.h"
#include "compile/majorant/majorant_grid.h"

namespace tyndall::compile {

namespace {

bool reads_world(const vm::Program& program) {
  return std::any_of(program.inputs.begin(), program.inputs.end(),
                     [](vm::Input input) { return vm::Input::P_x <= input && input <= vm::Input::P_z; });
}

// Of the shutter, where a medium changes while it is open: bounds over all of it would hold for everything
// that the medium is in between. A power of two: where one ends is exact.
constexpr std::uint32_t time_slabs = 8;

// Number of a volume's transform from its medium to the world.
constexpr std::size_t of_medium = 1;

// Lets the domain know where the medium's space is in the world in a part of the time that the shutter is
// open: at the ends of ways that are straight but for the bend.
void set_way(MajorantGrid::Domain& domain, const scene::Moving<scene::Volume>& motion,
             const Interval<double>& part) {
  domain.world_from_medium.clear();
  for (const double moment : scene::moments(motion, part.lo, part.hi))
    domain.world_from_medium.push_back(scene::at(motion, moment).world_from_medium);
  domain.bend = scene::bend(motion, of_medium);
  if (domain.bend > 0) domain.pivot = motion.turnings[of_medium].pivot;
}

// The box moved outward to a lattice of 2^-20 of its size: instances of one prototype, whose transforms round
// differently, have the same.
Bounds snapped(const Bounds& b) {
  const Vec3d extent = b.hi - b.lo;
  const double size = std::max({extent.x, extent.y, extent.z});
  if (!(size > 0)) return b;
  const double unit = std::exp2(std::floor(std::log2(size) + 0.3) - 20);
  Bounds out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.lo[axis] = (std::floor(b.lo[axis] / unit + 0.25) - 1) * unit;
    out.hi[axis] = (std::ceil(b.hi[axis] / unit - 0.25) + 1) * unit;
  }
  return out;
}

// Pixels across which the volume appears to the camera from outside; infinite from inside or when it cannot
// be told.
double pixels_across(const CompiledScene& world, const CompiledVolume& volume, const Bounds& shape) {
  const Bounds box = placed_bounds(shape, volume.render_from_shape);
  const Vec3d center = (box.lo + box.hi) * 0.5;
  const double radius = length(box.hi - box.lo) * 0.5, distance = length(center) - radius;  // camera at 0
  const double height = world.scene.settings.resolution.height;
  return std::visit(
      Overloaded{[&](const scene::PerspectiveCamera& c) {
                   return distance > 0 ? radius * height / (distance * std::tan(c.fov.radians / 2))
                                       : infinity;
                 },
                 [&](const scene::OrthographicCamera& c) { return 2 * radius * height / c.height; },
                 [&](const scene::SphericalCamera&) {
                   return distance > 0 ? 2 * std::atan2(radius, distance) * height / pi : infinity;
                 }},
      world.scene.camera);
}

// A step that is chosen for a volume is no wider than this share of the volume, however thin it is: light and
// shadow vary in it, too.
double widest_step(const Bounds& in_world) {
  const Vec3d extent = in_world.hi - in_world.lo;
  return std::max({extent.x, extent.y, extent.z}) / 16;
}

// Where the medium's space is looked into, at any time of the shutter.
Bounds box_in_medium(const CompiledScene& world, const CompiledVolume& volume) {
  const Bounds still = placed_bounds(*world.geometry->bounds_of(volume.shape),
                                     volume.medium_from_render * volume.render_from_shape);
  if (!volume.motion) return still;
  // A shape that moves within its medium goes a way that has no simple form: many moments of it, and the room
  // that a parabola through three of them would take.
  constexpr int pieces = 16;  // from one moment to the next
  const std::vector<double> moments = scene::moments(volume.motion->keys());
  std::optional<Bounds> swept;
  std::array<Bounds, 2> before{};
  Vec3d room;
  int seen = 0;
  for (std::size_t k = 0; k + 1 < moments.size(); ++k)
    for (int i = k == 0 ? 0 : 1; i <= pieces; ++i) {
      const scene::Volume now =
          scene::at(volume.motion->keys(), moments[k] + (moments[k + 1] - moments[k]) * i / pieces);
      const auto medium_from_world = now.world_from_medium.inverse();
      if (!medium_from_world) continue;  // flat for this moment
      const Bounds box = placed_bounds(*turned_bounds(now.shape, world.geometry->parts()),
                                       *medium_from_world * now.world_from_shape);
      swept = swept ? united(*swept, box) : box;
      for (int axis = 0; axis < 3 && seen >= 2; ++axis)
        for (const auto end : {&Bounds::lo, &Bounds::hi})
          room[axis] = std::max(
              room[axis], std::abs((box.*end)[axis] - 2 * (before[1].*end)[axis] + (before[0].*end)[axis]));
      before = {before[1], box};
      ++seen;
    }
  return {swept->lo - room, swept->hi + room};
}

// Walking through a grid costs about as much as marching a few dozen cheap segments.
constexpr double least_plain_share = 0.04;

// Half as fine as pixels is fine enough: bounds are for majorants, not for looks. Steps that are proven take
// fewer segments the finer they are.
std::uint32_t cells_for(double pixels) {
  const double along = std::clamp(pixels / 2, 8.0, 64.0);
  return static_cast<std::uint32_t>(along * along * along);
}

// What the grids tell of their volumes: majorants, and whether walking through them pays.
void heed_grids(CompiledScene& world) {
  std::vector<double> plain;
  for (const auto& grid : world.grids) plain.push_back(grid->plain_share());
  for (CompiledVolume& volume : world.volumes) {
    if (volume.grid == no_index) continue;
    const auto first = plain.begin() + volume.grid;
    for (std::uint32_t slab = 0; slab < volume.time_slabs; ++slab)
      volume.majorant = std::max(volume.majorant, world.grids[volume.grid + slab]->majorant());
    volume.skips =
        std::accumulate(first, first + volume.time_slabs, 0.0) >= least_plain_share * volume.time_slabs;
  }
}

}  // namespace

void add_grids(CompiledScene& world, Kept& kept) {
  // Medium, the box's six ends, and of a program that reads the world's position the volume too.
  using Key = std::array<double, 8>;
  std::map<Key, std::uint32_t> known;
  std::vector<MajorantGrid::Domain> domains;
  std::vector<std::uint32_t> media;
  const std::vector<scene::Volume> volumes = scene::all_volumes(world.scene);
  for (std::uint32_t v = 0; v < world.volumes.size(); ++v) {
    CompiledVolume& volume = world.volumes[v];
    const std::optional<Bounds> shape = world.geometry->bounds_of(volume.shape);
    CHECK(shape.has_value());  // volumes are closed
    volume.widest_step = widest_step(placed_bounds(*shape, volume.render_from_shape));
    if (world.media[volume.medium].uniform) continue;
    const CompiledMedium& medium = world.media[volume.medium];
    const bool in_world = reads_world(medium.full), sweeps = in_world && volume.motion;
    if (world.shutter_seconds > 0 && (sweeps || medium.full.reads(vm::Input::time)))
      volume.time_slabs = time_slabs;
    MajorantGrid::Domain domain;
    domain.box = snapped(box_in_medium(world, volume));
    if (in_world && !sweeps) domain.world_from_medium = {volumes[v].world_from_medium};
    domain.cells = volume.step.proven ? max_grid_cells : cells_for(pixels_across(world, volume, *shape));
    const Bounds& b = domain.box;
    const Key key = {static_cast<double>(volume.medium),       b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z,
                     in_world ? static_cast<double>(v) + 1 : 0};
    const auto [found, added] = known.emplace(key, static_cast<std::uint32_t>(domains.size()));
    volume.grid = found->second;
    for (std::uint32_t slab = 0; slab < volume.time_slabs; ++slab) {
      if (!added) {
        MajorantGrid::Domain& shared = domains[volume.grid + slab];
        shared.cells = std::max(shared.cells, domain.cells);
        continue;
      }
      const Interval<double> part{slab / double(volume.time_slabs), (slab + 1) / double(volume.time_slabs)};
      domain.time = {world.seconds_at(part.lo), world.seconds_at(part.hi)};
      if (sweeps) set_way(domain, volume.motion->keys(), part);
      domains.push_back(domain);
      media.push_back(volume.medium);
    }
  }
  const std::size_t share =
      domains.empty() ? 0 : max_grid_bytes / domains.size() / MajorantGrid::bytes_per_cell;
  const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(share, max_grid_cells));
  BoundsScratch scratch;
  for (std::size_t i = 0; i < domains.size(); ++i) {
    domains[i].cells = std::min(domains[i].cells, most);
    const CompiledMedium& medium = world.media[media[i]];
    std::unique_ptr<MajorantGrid> grid = kept_grid(medium, domains[i], kept);
    kept.reused_grids.count(grid != nullptr);
    if (!grid) {
      grid = std::make_unique<MajorantGrid>(medium, domains[i]);
      grid->survey(scratch);
    }
    world.grids.push_back(std::move(grid));
  }
  heed_grids(world);
}

}  // namespace tyndall::compile
