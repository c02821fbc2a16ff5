// The caches of media and materials: see shader_cache.h.
#include "resolve/shader_cache.h"

#include <algorithm>

#include "base/check.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// The body with its parameters bound, or nothing after an error.
std::optional<eval::Body> body_of(Run& run, const Thing& thing) {
  if (thing.value.is_error()) return std::nullopt;
  const auto* body = thing.value.get<eval::Body>();
  CHECK(body);
  if (body->item) run.bodies.compiled.insert(body->item);
  return run.evaluator.bound(*body, thing.span);
}

// Whether a body says anything of how much light passes through.
bool sets_transparency(const Run& run, const syntax::SyntaxTree& tree, syntax::BlockId block) {
  const auto items = tree.list_of_items(tree[block].items);
  return std::any_of(items.begin(), items.end(), [&](syntax::ItemId id) {
    const auto& node = tree[id].node;
    if (const auto* loop = std::get_if<syntax::ForItem>(&node))
      return sets_transparency(run, tree, loop->body);
    if (const auto* choice = std::get_if<syntax::IfItem>(&node))
      return sets_transparency(run, tree, choice->then_block) ||
             (choice->else_block.valid() && sets_transparency(run, tree, choice->else_block));
    const auto* assign = std::get_if<syntax::AssignItem>(&node);
    const std::string_view name = assign ? run.symbols.text(assign->name.symbol) : "";
    return name == "transmission" || name == "opacity";
  });
}

}  // namespace

scene::MediumId medium_of(Run& run, const Thing& thing) {
  const auto body = body_of(run, thing);
  if (!body) return {};
  const auto [known, is_new] = run.bodies.media.try_emplace(body->key);
  if (!is_new) return known->second;
  run.grids.looked_up_since();
  auto medium = shader::compile_medium(run.context, *body, run.options.shader);
  if (!medium) return {};
  run.scene.media.push_back(std::move(*medium));
  const scene::MediumId id(run.scene.media.size() - 1);
  if (auto grids = run.grids.looked_up_since(); !grids.empty())
    run.bodies.grids_of_medium[id.index] = std::move(grids);
  return run.bodies.media[body->key] = id;
}

scene::MaterialId material_of(Run& run, const Thing& thing) {
  const auto of_value = run.bodies.material_of_value.find(thing.value.heavy.get());
  if (of_value != run.bodies.material_of_value.end()) return of_value->second;
  const auto body = body_of(run, thing);
  if (!body) return {};
  const auto [known, is_new] = run.bodies.materials.try_emplace(body->key);
  if (is_new) {
    if (auto material = shader::compile_material(run.context, *body, run.options.shader)) {
      run.scene.materials.push_back(std::move(*material));
      known->second = scene::MaterialId(run.scene.materials.size() - 1);
      if (sets_transparency(run, *body->tree, body->block))
        run.bodies.may_let_through.insert(known->second.index);
    }
  }
  // Only values that a name holds come again; the others would fill the memory.
  if (thing.value.heavy.use_count() > 1) {
    run.bodies.kept.push_back(thing.value);
    run.bodies.material_of_value.emplace(thing.value.heavy.get(), known->second);
  }
  return known->second;
}

scene::MaterialId default_material(Run& run) {
  if (!run.bodies.default_material.valid())
    run.bodies.default_material = scene::add_diffuse(run.scene, Rgb(0.8f));
  return run.bodies.default_material;
}

void note_definition(Run& run, const syntax::SyntaxTree& tree, const syntax::BodyItem& item,
                     const eval::Value& value) {
  if (run.bodies.defined.insert(&item).second) run.bodies.definitions.push_back({&tree, &item, value});
}

void check_unused_bodies(Run& run) {
  run.images.stand_in(true);
  run.grids.stand_in(true);
  for (const Bodies::Definition& definition : run.bodies.definitions) {
    if (run.bodies.compiled.contains(definition.item)) continue;
    const auto parameters = definition.tree->list_of_parameters(definition.item->parameters);
    const auto* body = definition.value.get<eval::Body>();
    if (!body) continue;
    if (!std::all_of(parameters.begin(), parameters.end(),
                     [](const syntax::Parameter& p) { return p.default_value.valid(); })) {
      shader::check_outputs(run.context, *definition.tree, definition.item->body, definition.item->kind,
                            run.symbols.text(definition.item->name.symbol));
      continue;
    }
    const auto with_defaults = run.evaluator.bound(*body, definition.item->name.span);
    if (!with_defaults) continue;
    switch (definition.item->kind) {
      case syntax::BodyKind::medium:
        shader::compile_medium(run.context, *with_defaults, run.options.shader);
        break;
      case syntax::BodyKind::material:
        shader::compile_material(run.context, *with_defaults, run.options.shader);
        break;
    }
  }
}

}  // namespace tyndall::resolve
