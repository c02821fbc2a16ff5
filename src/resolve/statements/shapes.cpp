// Shapes, the volumes that they enclose, and groups.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/check.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// The words of the statements that make closed shapes: "sphere, box".
std::string closed_shapes(const Run& run) {
  std::vector<std::string_view> names;
  for (const Statement& row : run.statements.rows())
    if (row.closed) names.push_back(row.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Reader::Others others_of(const Statement& row) {
  return row.holds_parts ? Reader::Others::allowed : Reader::Others::refused;
}

// Once for each place in the text.
void warn_if_open(Run& run, const scene::Mesh& mesh, const syntax::ThingExpr& thing, std::string_view word) {
  const std::size_t open = scene::open_edges(run.scene.meshes[mesh.mesh.index]);
  if (open == 0 || !run.warned_meshes.insert(&thing).second) return;
  if (const std::string_view help = way_to_close(word); !help.empty())
    return run.diagnostics.warning(thing.keyword.span,
                                   fmt::format("this {} is open: a volume fills what is closed", word),
                                   std::string(help));
  run.diagnostics.warning(
      thing.keyword.span,
      fmt::format("the mesh is open or badly wound at {} edge{}", open, open == 1 ? "" : "s"),
      "a volume fills what is closed: give every edge a triangle on either side, both "
      "counter-clockwise seen from outside");
}

// How far what stands in the grid's voxels is carried while the shutter is open, so many seconds after the
// grid was stored, along each axis of them.
VoxelRange carried_along(const VoxelGrid& carried, const VoxelGrid& velocity, const Intervald& seconds,
                         std::size_t axis) {
  VoxelRange way;
  const Transform& t = carried.voxels_from_local;
  const Vec3d along{t.x[axis], t.y[axis], t.z[axis]};
  for (std::size_t k = 0; k < 3; ++k) {
    const VoxelRange speed = velocity.components[k]->levels.back().ranges[0];
    VoxelRange carried_by;
    for (const double since : {seconds.lo, seconds.hi}) {
      const auto by = static_cast<float>(along[k] * since);
      carried_by.lo = std::min({carried_by.lo, by * speed.lo, by * speed.hi});
      carried_by.hi = std::max({carried_by.hi, by * speed.lo, by * speed.hi});
    }
    way.lo += carried_by.lo;
    way.hi += carried_by.hi;
  }
  return way;
}

// Around all that lookups reach from active voxels.
std::optional<PlacedShape> box_of(Run& run, const eval::Grid& grid) {
  const VoxelGridPointer data = run.grids.read(grid, eval::LookedUpAt::known);
  if (!data) return std::nullopt;
  constexpr double reach_of[] = {0.5, 1, 2};  // nearest, linear, cubic
  const double reach = reach_of[static_cast<std::size_t>(grid.filter)];
  const Vec3d border{reach, reach, reach};
  scene::Box box{data->first_active - border, data->last_active + border};
  if (!grid.velocity.empty() && run.context.shutter_seconds > 0) {
    const double opened = run.context.opened - run.context.frame_time;
    const Intervald seconds{opened, opened + run.context.shutter_seconds};
    const VoxelGridPointer velocity = run.grids.read_velocity(grid);
    if (!velocity) return std::nullopt;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const VoxelRange way = carried_along(*data, *velocity, seconds, axis);
      box.min[axis] += way.lo;
      box.max[axis] += way.hi;
    }
  }
  return PlacedShape{box, data->local_from_voxels};
}

// Around the grids that a medium looks up at its own p; nothing when there are none, or others.
std::optional<PlacedShape> box_of_grids(Run& run, scene::MediumId medium) {
  const auto found = run.bodies.grids_of_medium.find(medium.index);
  if (found == run.bodies.grids_of_medium.end()) return std::nullopt;
  const std::vector<eval::Grid>& grids = found->second;
  if (grids.size() == 1) return box_of(run, grids[0]);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  scene::Box all{Vec3d(infinity), Vec3d(-infinity)};
  for (const eval::Grid& grid : grids) {
    const std::optional<PlacedShape> placed = box_of(run, grid);
    if (!placed) return std::nullopt;
    const auto& box = std::get<scene::Box>(placed->shape);
    for (int corner = 0; corner < 8; ++corner) {
      const auto end = [&](std::size_t k) { return corner >> k & 1 ? box.max[k] : box.min[k]; };
      const Vec3d p = placed->outer_from_shape.point({end(0), end(1), end(2)});
      for (std::size_t k = 0; k < 3; ++k) {
        all.min[k] = std::min(all.min[k], p[k]);
        all.max[k] = std::max(all.max[k], p[k]);
      }
    }
  }
  return PlacedShape{all, {}};
}

}  // namespace

std::optional<PlacedShape> read_shape_value(Run& run, const Thing& in, Inside inside, Reader& outer) {
  if (in.value.is_error()) return std::nullopt;
  if (const auto* bounds = in.value.get<eval::GridBounds>()) return box_of(run, bounds->grid);
  const auto* literal = in.value.get<eval::ShapeLiteral>();
  CHECK(literal);
  const syntax::ThingExpr& thing = *literal->thing;
  const std::string_view word = run.symbols.text(thing.keyword.symbol);
  const Statement* row = run.statements.find(thing.keyword.symbol, {});
  if (!row || !row->is_shape()) {
    report_no_shape(run, thing);
    return std::nullopt;
  }
  const Statement* const of_file = run.statements.of_file(*row);
  if (thing.file.valid() ? !of_file : row->of_file) {
    run.diagnostics.error(thing.keyword.span, thing.file.valid() ? fmt::format("'{}' takes no file", word)
                                                                 : fmt::format("'{}' needs a file", word));
    return std::nullopt;
  }
  if (thing.file.valid()) row = of_file;
  if (inside == Inside::needed && !row->closed && !row->of_file) {
    run.diagnostics.error(thing.keyword.span, fmt::format("a '{}' is open: a volume needs an inside", word),
                          fmt::format("closed shapes are: {}", closed_shapes(run)));
    return std::nullopt;
  }
  const auto scope = std::make_shared<eval::Scope>();
  scope->parent = literal->scope;
  Reader reader(run.evaluator, run.schemas, {literal->tree, &scope, &run.statements}, thing.block, word,
                thing.keyword.span, others_of(*row));
  std::optional<PlacedShape> shape;
  if (!row->of_file) {
    Site site;
    site.tree = literal->tree;
    site.scope = scope;
    if (auto read = row->read_shape(run, reader, {site, thing.block, thing.keyword.span}))
      shape = PlacedShape{std::move(*read), {}};
  } else if (const auto file = named_file(run, *literal->tree, thing.file, literal->scope))
    shape = row->read_file_shape(run, reader, *file);
  const auto placement = reader.read<Placement>();
  reader.finish({}, &outer);
  if (!reader.ok() || !shape) return std::nullopt;
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape->shape); mesh && inside == Inside::needed)
    warn_if_open(run, *mesh, thing, word);
  return PlacedShape{shape->shape, placement.transform * shape->outer_from_shape};
}

void report_no_shape(Run& run, const syntax::ThingExpr& thing) {
  const std::string_view word = run.symbols.text(thing.keyword.symbol);
  std::vector<std::string_view> shapes;
  for (const Statement& s : run.statements.rows())
    if (s.is_shape()) shapes.push_back(s.name);
  std::string help = did_you_mean(word, shapes);
  if (help.empty()) help = fmt::format("closed shapes are: {}", closed_shapes(run));
  run.diagnostics.error(thing.keyword.span, fmt::format("'{}' is not a shape", word), std::move(help));
}

std::optional<Transform> placed(Reader& reader, const Site& site, const Transform& transform) {
  const Transform world_from_thing = site.world_from_local * transform;
  if (world_from_thing.inverse()) return world_from_thing;
  reader.error(reader.place("transform"), "the transforms together flatten space: they cannot be undone",
               "their scales are too small or too large");
  return std::nullopt;
}

void run_shape(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader = reader_of(run, site, thing, row, others_of(row));
  const std::optional<scene::Shape> shape = row.read_shape(run, reader, {site, thing.block, header(thing)});
  const auto placement = reader.read<ShapePlacement>();
  reader.finish();
  if (run.combining) run.combining->complete &= reader.ok() && shape;
  if (!reader.ok() || !shape) return;
  if (run.combining) return add_part(run, site, reader, *shape, placement, header(thing));
  const auto world_from_object = placed(reader, site, placement.transform);
  if (!world_from_object) return;
  scene::MaterialId material = site.material;
  if (placement.material.given()) {
    material = material_of(run, placement.material);
    if (!material.valid()) return;
  } else if (!material.valid()) {
    if (run.building)
      run.building->inherits_material = true;
    else
      material = default_material(run);
  }
  run.shapes().push_back({*shape, *world_from_object, material, site.visible && placement.visible,
                          header(thing), placement.priority});
}

void run_volume(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader = reader_of(run, site, thing, row);
  const auto given = reader.read<VolumeParameters>();
  if (given.step && given.step->fixed() && !(given.step->metres > 0))
    reader.error(reader.place("step"), fmt::format("'step' must be above 0, found {}", given.step->metres));
  std::optional<PlacedShape> in;
  if (given.in.given()) in = read_shape_value(run, given.in, Inside::needed, reader);
  scene::MediumId medium;
  if (given.medium.given()) medium = medium_of(run, given.medium);
  if (!given.in.given() && medium.valid()) in = box_of_grids(run, medium);
  if (in) reader.settle("in");
  reader.finish();
  scene::MaterialId material;
  if (given.material.given()) {
    material = material_of(run, given.material);
    if (!material.valid()) return;
  }
  if (!reader.ok() || !in || !medium.valid() || !run.may_add_volumes(1, header(thing))) return;
  const auto world_from_medium = placed(reader, site, given.transform);
  if (!world_from_medium) return;
  scene::Volume volume{in->shape,          *world_from_medium * in->outer_from_shape,
                       *world_from_medium, medium,
                       given.step,         site.visible && given.visible,
                       header(thing),      given.priority};
  if (material.valid()) {
    if (!volume.priority) volume.priority = 0;
    volume.boundary = static_cast<std::uint32_t>(run.shapes().size());
    run.shapes().push_back({volume.shape, volume.world_from_shape, material, volume.visible,
                            volume.definition, *volume.priority});
  }
  run.volumes().push_back(std::move(volume));
}

void run_group(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader = reader_of(run, site, thing, row, Reader::Others::allowed);
  const auto given = reader.read<GroupParameters>();
  reader.finish();
  // What is in it is read even when its own parameters are wrong: for its errors.
  const auto world_from_local = reader.ok() ? placed(reader, site, given.transform) : std::nullopt;
  Site inside = site;
  if (world_from_local) inside.world_from_local = *world_from_local;
  if (given.material.given()) inside.material = material_of(run, given.material);
  inside.visible = site.visible && given.visible;
  refuse_of_part(run, reader, given.material.given(), "material");
  refuse_of_part(run, reader, !given.visible, "visible");
  run_inner_block(run, inside, thing.block, Parameters::read);
}

}  // namespace tyndall::resolve
