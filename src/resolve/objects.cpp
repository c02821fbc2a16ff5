// Objects placed: the body is run once, and each `place` refers to what it made.
#include <fmt/format.h>

#include "resolve/nested.h"
#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

// How often variables around an object were read: when that grows while its body is run, the body must be run
// again for each placement.
std::uint64_t variable_reads(const eval::Scope* scope) {
  std::uint64_t reads = 0;
  for (; scope; scope = scope->parent.get()) reads += scope->variable_reads;
  return reads;
}

// Runs the object's body in its own space.
BuiltObject built(Run& run, const Site& site, const eval::ObjectDefinition& object) {
  BuiltObject result;
  result.things.name = std::string(run.symbols.text(object.item->name.symbol));
  Site inside = site;
  inside.tree = object.tree;
  inside.scope = std::make_shared<eval::Scope>();
  inside.scope->parent = object.scope;
  std::unordered_set<std::string> included;
  inside.included = &included;
  inside.world_from_local = {};
  inside.material = {};
  inside.visible = true;
  inside.in_object = true;
  result.scope = inside.scope.get();
  BuiltObject* const outer = std::exchange(run.building, &result);
  run_block(run, inside, object.item->body);
  run.building = outer;
  report_unused(run, *inside.scope);
  return result;
}

// The object's prototype, from an earlier placement where that may be; nothing when it could not be entered.
std::optional<KnownObject> prototype_of(Run& run, const Site& site, const eval::Value& value, Span span) {
  const auto known = run.objects.find(value.heavy.get());
  if (known != run.objects.end()) return known->second;
  const Nested nested(run, span);
  if (!nested.entered()) return std::nullopt;
  const auto& object = *value.get<eval::ObjectDefinition>();
  const std::uint64_t reads = variable_reads(object.scope.get());
  BuiltObject made = built(run, site, object);
  const bool changes = variable_reads(object.scope.get()) > reads || made.sets_variable;
  // What an inner object sets outside this one is set by each placement of this one.
  if (run.building && made.sets_variable) run.building->sets_variable = true;
  KnownObject result{value, scene::PrototypeId(run.scene.prototypes.size()), std::move(made.lights),
                     made.inherits_material, made.placed + static_cast<double>(made.things.volumes.size())};
  run.scene.prototypes.push_back(std::move(made.things));
  if (!changes) run.objects.emplace(value.heavy.get(), result);
  return result;
}

void place_object(Run& run, const Site& site, const eval::Value& value, const Transform& world_from_object,
                  scene::MaterialId material, Span span) {
  const auto object = prototype_of(run, site, value, span);
  if (!object || !run.may_place(*object, span)) return;
  if (!material.valid() && object->inherits_material) {
    if (run.building)
      run.building->inherits_material = true;
    else
      material = default_material(run);
  }
  for (const ObjectLight& light : object->lights)
    add_light(run, light, world_from_object * light.object_from_light);
  const scene::Prototype& things = run.scene.prototypes[object->prototype.index];
  if (things.shapes.empty() && things.volumes.empty() && things.instances.empty()) return;
  run.instances().push_back({object->prototype, world_from_object, material, site.visible, span});
}

}  // namespace

bool Run::may_place(const KnownObject& object, Span span) {
  if (stopped) return false;  // within the object: told already
  double& things = building ? building->placed : placed;
  double& lights = building ? building->placed_lights : placed_lights;
  things += 1 + object.holds;
  lights += static_cast<double>(object.lights.size());
  const auto most_things = static_cast<double>(options.max_repetitions);
  const bool too_many_lights = lights > max_placed_lights;
  if (things <= most_things && !too_many_lights) return true;
  diagnostics.error(
      span,
      fmt::format("more than {} {} placed by objects", too_many_lights ? max_placed_lights : most_things,
                  too_many_lights ? "lights" : "things"),
      fmt::format("this one makes them {:.15g}: objects within objects multiply",
                  too_many_lights ? lights : things));
  stopped = true;
  return false;
}

void run_place(Run& run, const Site& site, const syntax::PlaceItem& place) {
  const std::string_view name = run.symbols.text(place.name.symbol);
  const eval::Binding* binding = site.scope->find(place.name.symbol);
  const auto* object = binding ? binding->value.get<eval::ObjectDefinition>() : nullptr;
  if (!object) {
    if (binding && binding->value.is_error()) return;
    std::vector<std::string_view> objects;
    for (const eval::Scope* scope = site.scope.get(); scope; scope = scope->parent.get())
      for (const eval::Binding& b : scope->bindings)
        if (b.value.type == eval::Type::object) objects.push_back(run.symbols.text(b.symbol));
    if (binding)
      return run.diagnostics.error(
          place.name.span,
          fmt::format("'{}' is {}, not an object", name, eval::describe(binding->value.type)),
          binding->value.type == eval::Type::function ? fmt::format("a template is called: {}(…)", name)
                                                      : std::string("an object is `object name { … }`"),
          {{binding->definition, "defined here"}});
    return report_undefined(run, place.name.symbol, place.name.span, fmt::format("no object '{}'", name),
                            did_you_mean(name, objects));
  }
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, place.block,
                PlaceParameters::keyword, place.name.span);
  const auto given = reader.read<PlaceParameters>();
  reader.finish("an object has no parameters of its own; a template has");
  if (!reader.ok() || !run.may_repeat(1, place.name.span)) return;
  const auto world_from_local = placed(reader, site, given.transform);
  if (!world_from_local) return;
  scene::MaterialId material = site.material;
  if (given.material.given()) {
    material = material_of(run, given.material);
    if (!material.valid()) return;
  }
  place_object(run, site, binding->value, *world_from_local, material, place.name.span);
}

}  // namespace tyndall::resolve
