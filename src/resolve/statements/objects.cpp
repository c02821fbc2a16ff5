// Objects placed: the body is run once, and each `place` refers to what it made.
#include <fmt/format.h>

#include "resolve/expansion_notes.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// How often variables around an object were read: when that grows while its body is run, the body must be run
// again for each placement.
std::uint64_t variable_reads(const eval::Scope* scope) {
  std::uint64_t reads = 0;
  for (; scope; scope = scope->parent.get()) reads += scope->variable_reads;
  return reads;
}

// Runs the object's body in its own space. `around`: the scope of its arguments, or where it was defined.
BuiltObject built(Run& run, const Site& site, const eval::ObjectDefinition& object,
                  const std::shared_ptr<const eval::Scope>& around) {
  BuiltObject result;
  result.things.name = std::string(run.symbols.text(object.item->name.symbol));
  Site inside = site;
  inside.tree = object.tree;
  inside.scope = std::make_shared<eval::Scope>();
  inside.scope->parent = around;
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
std::optional<KnownObject> prototype_of(Run& run, const Site& site, const eval::Value& value,
                                        const std::shared_ptr<const eval::Scope>& arguments, Span span) {
  std::pair<const eval::Heavy*, std::string> key{value.heavy.get(), {}};
  if (arguments) {
    key.second = run.evaluator.key_of(*arguments);
    // Arguments that depend on `time` may be equal at one moment and differ at another: what was shared when
    // the shutter opened is shared.
    const auto known = run.argument_keys.find(key);
    const auto& made = run.objects_of_arguments;
    const std::size_t number =
        run.structure.settled(known == run.argument_keys.end() ? made.size() : known->second);
    if (number < made.size()) return made[number];
  } else if (const auto known = run.objects.find(key.first); known != run.objects.end()) {
    return known->second;
  }
  if (run.scene.prototypes.size() >= max_objects) {
    run.diagnostics.error(span, fmt::format("more than {} objects, each with a body of its own", max_objects),
                          "define an object once, outside of what repeats");
    run.stopped = true;
    return std::nullopt;
  }
  const Nested nested(run, span);
  if (!nested.entered()) return std::nullopt;
  const auto& object = *value.get<eval::ObjectDefinition>();
  const std::uint64_t reads = variable_reads(object.scope.get());
  BuiltObject made = built(run, site, object, arguments ? arguments : object.scope);
  const bool changes = variable_reads(object.scope.get()) > reads || made.sets_variable;
  // What an inner object sets outside this one is set by each placement of this one.
  if (run.building && made.sets_variable) run.building->sets_variable = true;
  KnownObject result{value,
                     scene::PrototypeId(run.scene.prototypes.size()),
                     std::move(made.lights),
                     made.inherits_material,
                     made.placed + static_cast<double>(made.things.volumes.size()),
                     made.volumes};
  run.scene.prototypes.push_back(std::move(made.things));
  if (arguments) {
    if (!changes) run.argument_keys.insert_or_assign(std::move(key), run.objects_of_arguments.size());
    run.objects_of_arguments.push_back(result);
    run.object_arguments.push_back(arguments);
  } else if (!changes) {
    run.objects.emplace(key.first, result);
  }
  return result;
}

// Writes the lights of a placed object into the scene. `placements`: of the objects around them, outermost
// first.
void add_lights(Run& run, const ObjectLights& lights, std::vector<Transform>& placements) {
  for (const auto& entry : lights.list) {
    if (const auto* own = std::get_if<ObjectLight>(&entry)) {
      Transform placed = own->object_from_light;
      for (std::size_t i = placements.size(); i-- > 0;) placed = placements[i] * placed;
      add_light(run, *own, placed);
    } else {
      const auto& inner = std::get<ObjectLights::Placed>(entry);
      placements.push_back(inner.object_from_inner);
      add_lights(run, *inner.lights, placements);
      placements.pop_back();
    }
  }
}

}  // namespace

void place_known(Run& run, const Site& site, const KnownObject& object, const Transform& world_from_object,
                 scene::MaterialId material, Span span) {
  if (!run.may_place(object, span)) return;
  if (!material.valid() && object.inherits_material) {
    if (run.building)
      run.building->inherits_material = true;
    else
      material = default_material(run);
  }
  if (run.building && object.lights->count > 0)
    run.building->lights->list.emplace_back(ObjectLights::Placed{object.lights, world_from_object});
  std::vector<Transform> placements{world_from_object};
  if (!run.building) add_lights(run, *object.lights, placements);
  const scene::Prototype& things = run.scene.prototypes[object.prototype.index];
  if (things.shapes.empty() && things.volumes.empty() && things.instances.empty()) return;
  run.instances().push_back({object.prototype, world_from_object, material, site.visible, span});
}

bool Run::may_place(const KnownObject& object, Span span) {
  if (stopped) return false;  // within the object: told already
  double& things = building ? building->placed : placed;
  things += 1 + object.holds;
  if (things > static_cast<double>(options.max_repetitions)) {
    diagnostics.error(span, fmt::format("more than {} things placed by objects", options.max_repetitions),
                      fmt::format("this one makes them {:.15g}: objects within objects multiply", things));
    stopped = true;
    return false;
  }
  return may_add_lights(object.lights->count, span) && may_add_volumes(object.volumes, span);
}

static bool may_add(Run& run, std::string_view noun, double& count, double more, int most, Span span) {
  if (run.stopped) return false;
  count += more;
  if (count <= most) return true;
  run.diagnostics.error(
      span, fmt::format("more than {} {} in a scene", most, noun),
      more > 1 ? fmt::format("this one makes them {:.15g}: objects within objects multiply", count)
               : "loops and templates that call each other multiply");
  run.stopped = true;
  return false;
}

bool Run::may_add_lights(double more, Span span) {
  return may_add(*this, "lights", building ? building->lights->count : lights, more, max_lights, span);
}

bool Run::may_add_volumes(double more, Span span) {
  return may_add(*this, "volumes", building ? building->volumes : volumes_made, more, max_volumes, span);
}

void run_place(Run& run, const Site& site, const syntax::PlaceItem& place) {
  const std::string_view name = run.symbols.text(place.name.symbol);
  if (run.combining) {
    run.combining->complete = false;
    return run.diagnostics.error(place.name.span,
                                 fmt::format("an object cannot be a part of '{}'", run.combining->keyword),
                                 "a template can make parts: `def name(…) { … }`, called as name(…)");
  }
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
  reader.finish(
      object->item->parameters.count > 0
          ? fmt::format("its own parameters stand in ( ): place {}(…) {{ … }}", name)
          : fmt::format("give the object parameters: object {0}(…) {{ … }}, place {0}(…) {{ … }}", name));
  if (!reader.ok() || !run.may_repeat(1, place.name.span)) return;
  const auto world_from_local = placed(reader, site, given.transform);
  if (!world_from_local) return;
  scene::MaterialId material = site.material;
  if (given.material.given()) {
    material = material_of(run, given.material);
    if (!material.valid()) return;
  }
  std::shared_ptr<const eval::Scope> arguments;
  if (object->item->parameters.count + place.arguments.count > 0) {
    arguments = run.evaluator.bind_arguments(*object->tree, object->item->parameters, object->scope,
                                             *site.tree, place.arguments, site.scope, name, place.name.span);
    if (!arguments) return;
  }
  if (const auto known = prototype_of(run, site, binding->value, arguments, place.name.span))
    place_known(run, site, *known, *world_from_local, material, place.name.span);
}

}  // namespace tyndall::resolve
