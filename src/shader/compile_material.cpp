// A material's body to its program: a diffuse surface whose colour and emission are computed.
#include <fmt/format.h>

#include "base/numerics.h"
#include "shader/compile_body.h"
#include "shader/outputs.h"

namespace tyndall::shader {

using eval::Type;

namespace {

enum Index : std::size_t { base_color, emission, first_without_effect };

constexpr OutputRule rules[] = {
    {"base_color", Type::vec, true, 0, 1, "in [0, 1]"},
    {"emission", Type::vec, true, 0, infinity, "at least 0"},
    {"metallic", Type::number, false, 0, 1, "in [0, 1]"},
    {"roughness", Type::number, false, 0, 1, "in [0, 1]"},
    {"specular", Type::number, false, 0, 1, "in [0, 1]"},
    {"transmission", Type::number, false, 0, 1, "in [0, 1]"},
    {"ior", Type::number, false, 1, infinity, "at least 1"},
    {"opacity", Type::number, false, 0, 1, "in [0, 1]"},
    {"normal", Type::vec, false, -infinity, infinity, "a direction"},
    {"coat", Type::number, false, 0, 1, "in [0, 1]"},
    {"sheen", Type::vec, true, 0, 1, "in [0, 1]"},
};

// Reflectance of a surface whose body does not set base_color.
constexpr double default_base_color = 0.8;

}  // namespace

std::span<const OutputRule> material_outputs() { return rules; }

std::optional<scene::Material> compile_material(eval::Context& context, const eval::Body& body,
                                                const Options& options) {
  eval::Evaluator in_scene(context);
  const std::optional<eval::Body> with_defaults = in_scene.bound(body, body.definition);
  if (!with_defaults) return std::nullopt;
  vm::Builder builder(options.fold);
  eval::Evaluator ev(context, &builder, syntax::BodyKind::material);
  bool failed = false;
  const auto outputs = run_body(ev, *with_defaults, rules, failed);
  if (failed) return std::nullopt;
  for (std::size_t i = first_without_effect; i < outputs.size(); ++i)
    if (outputs[i])
      context.diagnostics->warning(outputs[i]->span, fmt::format("'{}' has no effect yet", rules[i].name),
                                   "surfaces are diffuse for now: base_color and emission count");
  scene::Material material;
  material.name = body.name;
  material.definition = body.definition;
  OutputList list(ev);
  const eval::Scalar grey{default_base_color};
  material.base_color = outputs[base_color]
                            ? list.indices(outputs[base_color]->value.scalars, outputs[base_color]->span)
                            : list.indices({grey, grey, grey}, body.definition);
  if (outputs[emission])
    material.emission = list.indices(outputs[emission]->value.scalars, outputs[emission]->span);
  material.output_spans = list.spans;
  const auto program = builder.finish(list.nodes);
  if (!program) {
    ev.error(body.definition, fmt::format("'{}' is too large to compile", body.name),
             "unrolled loops make it long: use fewer rounds");
    return std::nullopt;
  }
  material.program = *program;
  return material;
}

}  // namespace tyndall::shader
