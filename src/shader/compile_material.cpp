// A material's body to its program: the outputs that make a surface, those left out that are not used.
#include <fmt/format.h>

#include <algorithm>

#include "base/numerics.h"
#include "eval/operators.h"
#include "shader/compile_body.h"
#include "shader/material_outputs.h"

namespace tyndall::shader {

using eval::Scalar;
using eval::Type;

namespace {

enum Index : std::size_t {
  base_color,
  metallic,
  roughness,
  specular,
  transmission,
  ior,
  coat,
  sheen,
  emission,
  opacity,
  normal
};

constexpr OutputRule rules[] = {
    {"base_color", Type::vec, true, 0, 1, "in [0, 1]",
     "colour of the matte ground, of metal, or of what glass lets through (both faces together)", "0.8"},
    {"metallic", Type::number, false, 0, 1, "in [0, 1]", "the part that is metal, coloured by base_color",
     "0"},
    {"roughness", Type::number, false, 0, 1, "in [0, 1]",
     "of gloss, metal and glass: 0 is a polished mirror, 1 nearly matte", "0"},
    {"specular", Type::number, false, 0, 1, "in [0, 1]",
     "strength of the clear gloss over the matte ground, as bright as `ior` makes it",
     "1 where roughness, ior or transmission is set, else 0"},
    {"transmission", Type::number, false, 0, 1, "in [0, 1]",
     "the part that is glass: closed shapes refract, disks, quads and planes are thin panes", "0"},
    {"ior", Type::number, false, 1, 1e3, "from 1 to 1000",
     "index of refraction inside; one number for the whole surface, as it is when the shutter opens", "1.5"},
    {"coat", Type::number, false, 0, 1, "in [0, 1]", "strength of a nearly polished clear lacquer over all",
     "0"},
    {"sheen", Type::vec, true, 0, 1, "in [0, 1]", "colour of fine fibres, seen at grazing angles", "0"},
    {"emission", Type::vec, true, 0, infinity, "at least 0", "radiance from both sides [W/m²/sr]", "0"},
    {"opacity", Type::number, false, 0, 1, "in [0, 1]",
     "the part of the surface that is there; light goes straight through the rest", "1"},
    {"normal", Type::vec, false, -infinity, infinity, "a direction",
     "the normal to shade with, in object space like `n`, of any length", "the shape's"},
};

// Reflectance of a surface whose body does not set base_color.
constexpr double default_base_color = 0.8;

using Outputs = std::vector<std::optional<Output>>;

// Turns the outputs into indices of a program; those that are known to be at their defaults are left out.
class MaterialCompiler {
 public:
  MaterialCompiler(eval::Evaluator& ev, const eval::Body& body, const Outputs& outputs)
      : body_(body), outputs_(outputs), list_(ev, OutputList::Sharing::same_statement) {}

  scene::Material indices() {
    scene::Material m;
    m.name = body_.name;
    m.definition = body_.definition;
    const Scalar grey{default_base_color};
    m.base_color =
        outputs_[base_color] ? color(base_color) : list_.indices({grey, grey, grey}, body_.definition);
    m.metallic = number(metallic, 0);
    m.transmission = number(transmission, 0);
    m.coat = number(coat, 0);
    if (outputs_[specular]) {
      m.specular = number(specular, 0);
    } else {
      for (const Index cause : {roughness, ior, transmission})
        if (outputs_[cause] && !m.specular) m.specular = list_.index(Scalar{1}, outputs_[cause]->span);
    }
    m.sheen = nonblack(sheen);
    m.emission = nonblack(emission);
    m.opacity = number(opacity, 1);
    if (outputs_[normal]) m.normal = color(normal);
    if (!m.matte()) {
      m.roughness = number(roughness, 0);
      m.ior = number(ior, -1);
    }
    m.given = given();
    return m;
  }
  const OutputList& list() const { return list_; }

 private:
  // The rule of the statement that each output came from; none for what stands in where nothing is set.
  std::vector<scene::GivenNumber> given() {
    std::vector<scene::GivenNumber> out(list_.spans.size());
    for (std::size_t i = 0; i < std::size(rules); ++i)
      for (std::size_t k = 0; outputs_[i] && k < out.size(); ++k)
        if (list_.spans[k] == outputs_[i]->span)
          out[k] = {std::string(rules[i].name), outputs_[i]->span, rules[i].lowest,
                    i == normal ? infinity : std::min(rules[i].highest, double{scene::largest_coefficient})};
    for (scene::GivenNumber& number : out)
      for (const std::optional<Output>& output : outputs_) {
        if (!output || output->span != number.span || output->branches.constant) continue;
        if (output->branches.places.size() < 2) continue;
        number.branches = output->branches.places;
        number.branch_output = list_.index(output->branches.taken, output->span);
      }
    out.resize(list_.spans.size());
    return out;
  }
  scene::RgbOutputs color(Index which) {
    return list_.indices(outputs_[which]->value.scalars, outputs_[which]->span);
  }
  std::optional<scene::RgbOutputs> nonblack(Index which) {
    if (!outputs_[which]) return std::nullopt;
    bool black = true;
    for (const Scalar& s : outputs_[which]->value.scalars) black &= s.known() && s.value == 0;
    return black ? std::nullopt : std::optional(color(which));
  }
  std::optional<std::uint8_t> number(Index which, double standard) {
    if (!outputs_[which]) return std::nullopt;
    const Scalar& s = outputs_[which]->value.scalars[0];
    if (s.known() && s.value == standard) return std::nullopt;
    return list_.index(s, outputs_[which]->span);
  }

  const eval::Body& body_;
  const Outputs& outputs_;
  OutputList list_;
};

}  // namespace

std::span<const OutputRule> material_outputs() { return rules; }

std::optional<scene::Material> compile_material(eval::Context& context, const eval::Body& body,
                                                const Options& options) {
  eval::Evaluator in_scene(context);
  const std::optional<eval::Body> with_defaults = in_scene.bound(body, body.definition);
  if (!with_defaults) return std::nullopt;
  vm::Builder builder(options.fold, options.guards);
  eval::Evaluator ev(context, &builder, syntax::BodyKind::material);
  bool failed = false;
  const Outputs outputs = run_body(ev, *with_defaults, rules, failed);
  if (failed) return std::nullopt;
  MaterialCompiler compiler(ev, body, outputs);
  scene::Material material = compiler.indices();
  const auto program = builder.finish(compiler.list().nodes);
  if (!program || compiler.list().too_many()) {
    ev.error(body.definition, fmt::format("'{}' is too large to compile", body.name),
             "unrolled loops make it long: use fewer rounds");
    return std::nullopt;
  }
  material.program = *program;
  material.lattice_places = lattice_places_of(builder, compiler.list().nodes);
  if (material.ior && !material.program.uniform(material.program.outputs[*material.ior])) {
    ev.error(outputs[ior]->span, "'ior' must be one number for the whole surface",
             "it may depend on parameters and on time, not on the place; vary 'specular' instead");
    return std::nullopt;
  }
  return material;
}

}  // namespace tyndall::shader
