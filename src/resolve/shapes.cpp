// Shapes, the volumes that they enclose, and groups.
#include <fmt/format.h>

#include "base/check.h"
#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

// The words of the statements that make closed shapes: "sphere, box".
std::string closed_shapes(const Run& run) {
  std::vector<std::string_view> names;
  for (const Statement& row : run.statements.rows())
    if (row.closed) names.push_back(row.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// Once for each place in the text.
void warn_if_open(Run& run, const scene::Mesh& mesh, const syntax::ThingExpr& thing) {
  const std::size_t open = scene::open_edges(run.scene.meshes[mesh.mesh.index]);
  if (open == 0 || !run.warned_meshes.insert(&thing).second) return;
  run.diagnostics.warning(
      thing.keyword.span,
      fmt::format("the mesh is open or badly wound at {} edge{}", open, open == 1 ? "" : "s"),
      "a volume fills what is closed: give every edge a triangle on either side, both "
      "counter-clockwise seen from outside");
}

}  // namespace

std::optional<PlacedShape> read_shape_value(Run& run, const Thing& in, Inside inside, Reader& outer) {
  if (in.value.is_error()) return std::nullopt;
  const auto* literal = in.value.get<eval::ShapeLiteral>();
  CHECK(literal);
  const syntax::ThingExpr& thing = *literal->thing;
  const std::string_view word = run.symbols.text(thing.keyword.symbol);
  const Statement* row = run.statements.find(thing.keyword.symbol, {});
  if (!row || (row->run && !row->read_shape)) {
    report_no_shape(run, thing);
    return std::nullopt;
  }
  if (!row->run) {
    run.diagnostics.error(thing.keyword.span, fmt::format("'{}' is not available yet", row->name));
    return std::nullopt;
  }
  if (inside == Inside::needed && !row->closed) {
    run.diagnostics.error(thing.keyword.span, fmt::format("a '{}' is open: a volume needs an inside", word),
                          fmt::format("closed shapes are: {}", closed_shapes(run)));
    return std::nullopt;
  }
  const auto scope = std::make_shared<eval::Scope>();
  scope->parent = literal->scope;
  Reader reader(run.evaluator, run.schemas, {literal->tree, &scope, &run.statements}, thing.block, word,
                thing.keyword.span);
  const scene::Shape shape = row->read_shape(run, reader);
  const auto placement = reader.read<Placement>();
  reader.finish({}, &outer);
  if (!reader.ok()) return std::nullopt;
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape); mesh && inside == Inside::needed)
    warn_if_open(run, *mesh, thing);
  return PlacedShape{shape, placement.transform};
}

void report_no_shape(Run& run, const syntax::ThingExpr& thing) {
  const std::string_view word = run.symbols.text(thing.keyword.symbol);
  std::vector<std::string_view> shapes;
  for (const Statement& s : run.statements.rows())
    if (s.read_shape) shapes.push_back(s.name);
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
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const scene::Shape shape = row.read_shape(run, reader);
  const auto placement = reader.read<ShapePlacement>();
  reader.finish();
  if (!reader.ok()) return;
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
  run.shapes().push_back({shape, *world_from_object, material, site.visible && placement.visible,
                          header(thing), placement.priority});
}

void run_volume(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<VolumeParameters>();
  if (given.step && !given.step->automatic() && !(given.step->metres > 0))
    reader.error(reader.place("step"), fmt::format("'step' must be above 0, found {}", given.step->metres));
  std::optional<PlacedShape> in;
  if (given.in.given()) in = read_shape_value(run, given.in, Inside::needed, reader);
  reader.finish();
  scene::MediumId medium;
  if (given.medium.given()) medium = medium_of(run, given.medium);
  scene::MaterialId material;
  if (given.material.given()) {
    material = material_of(run, given.material);
    if (!material.valid()) return;
  }
  if (!reader.ok() || !in || !medium.valid()) return;
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
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing), Reader::Others::allowed);
  const auto given = reader.read<GroupParameters>();
  reader.finish();
  // What is in it is read even when its own parameters are wrong: for its errors.
  const auto world_from_local = reader.ok() ? placed(reader, site, given.transform) : std::nullopt;
  Site inside = site;
  if (world_from_local) inside.world_from_local = *world_from_local;
  if (given.material.given()) inside.material = material_of(run, given.material);
  inside.visible = site.visible && given.visible;
  run_inner_block(run, inside, thing.block, Parameters::read);
}

}  // namespace tyndall::resolve
