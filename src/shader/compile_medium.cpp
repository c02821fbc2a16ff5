// A medium's body to its two programs: language.md "Medium".
#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/numerics.h"
#include "eval/operators.h"
#include "shader/compile_body.h"
#include "shader/limits.h"
#include "shader/outputs.h"

namespace tyndall::shader {

using eval::Scalar;
using eval::Type;
using eval::Value;

namespace {

enum Index : std::size_t { density, albedo, extinction, scattering, absorption, emission, phase };

constexpr OutputRule rules[] = {
    {"density", Type::number, false, 0, infinity, "at least 0", "a factor of all other coefficients", "1"},
    {"albedo", Type::vec, true, 0, 1, "in [0, 1]", "the fraction of extinction that is scattering"},
    {"extinction", Type::vec, true, 0, infinity, "at least 0",
     "extinction per metre where the density is 1, a number or a colour", "1 if only `albedo` is set"},
    {"scattering", Type::vec, true, 0, infinity, "at least 0",
     "the coefficient per metre where the density is 1, with `absorption` instead of `albedo` and "
     "`extinction`"},
    {"absorption", Type::vec, true, 0, infinity, "at least 0", "likewise"},
    {"emission", Type::vec, true, 0, infinity, "at least 0",
     "emitted power [W·m⁻³·sr⁻¹] where the density is 1", "0"},
    {"phase", Type::phase, false, 0, 0, "",
     "the phase function: `droplets` for fog and clouds, `rayleigh` for air, `fournier_forand` for sea "
     "water, `hg` "
     "for anything else, or a `mix` of two; see the end of [built-in functions](#built-in-functions)",
     "isotropic"},
};

using Outputs = std::vector<std::optional<Output>>;
using Rgb3 = std::array<Scalar, 3>;

// Coefficients per metre, density multiplied in, and the statements they came from.
struct Coefficients {
  Rgb3 sigma_s, sigma_t;
  Span sigma_s_span, sigma_t_span;
};

// Reports outputs that do not go together.
bool combine(eval::Evaluator& ev, const eval::Body& body, const Outputs& outputs) {
  const std::optional<Output>& of_albedo = outputs[albedo] ? outputs[albedo] : outputs[extinction];
  const std::optional<Output>& of_parts = outputs[scattering] ? outputs[scattering] : outputs[absorption];
  if (of_albedo && of_parts) {
    ev.error(of_parts->span, "a medium has albedo and extinction, or scattering and absorption, not both",
             "keep one of the two", {{of_albedo->span, "the other is set here"}});
    return false;
  }
  if (outputs[extinction] && !outputs[albedo]) {
    ev.error(outputs[extinction]->span, "'extinction' without 'albedo'",
             "albedo says which part of it is scattered: albedo = 0 for none");
    return false;
  }
  if (!of_albedo && !of_parts && !outputs[emission]) {
    ev.error(body.definition, fmt::format("'{}' neither scatters, absorbs nor emits", body.name),
             "set albedo, or scattering and absorption, or emission");
    return false;
  }
  return true;
}

class MediumCompiler {
 public:
  MediumCompiler(eval::Evaluator& ev, const eval::Body& body, const Outputs& given)
      : ev_(ev), body_(body), outputs_(given), limits_(ev), list_(ev) {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (i == phase || !outputs_[i]) continue;
      const NumberRange range{std::string(rules[i].name),
                              outputs_[i]->span,
                              rules[i].lowest,
                              std::min(rules[i].highest, double{scene::largest_coefficient}),
                              i != albedo,
                              i != albedo && i != emission,
                              outputs_[i]->branches};
      for (Scalar& s : outputs_[i]->value.scalars) s = limits_.limited(s, range);
    }
  }

  std::optional<scene::Medium> compile() {
    scene::Medium medium;
    medium.name = body_.name;
    medium.definition = body_.definition;
    const Coefficients c = coefficients();
    medium.sigma_t = list_.indices(c.sigma_t, c.sigma_t_span);
    medium.sigma_s = list_.indices(c.sigma_s, c.sigma_s_span);
    if (outputs_[emission]) medium.emission = list_.indices(scaled(emission), outputs_[emission]->span);
    const bool scatters = !(is_zero(c.sigma_s[0]) && is_zero(c.sigma_s[1]) && is_zero(c.sigma_s[2]));
    if (scatters) medium.phase = lobes();
    OutputList extinction_list(ev_);
    medium.extinction_sigma_t = extinction_list.indices(c.sigma_t, c.sigma_t_span);
    medium.given = limits_.given(list_, extinction_list);
    medium.output_spans = list_.spans;
    const auto full = ev_.builder()->finish(list_.nodes);
    const auto only_extinction = ev_.builder()->finish(extinction_list.nodes);
    if (!full || !only_extinction || list_.too_many()) {
      ev_.error(body_.definition, fmt::format("'{}' is too large to compile", body_.name),
                "unrolled loops make it long: use fewer rounds");
      return std::nullopt;
    }
    medium.full = *full;
    medium.extinction = *only_extinction;
    medium.lattice_places = lattice_places_of(*ev_.builder(), list_.nodes);
    return medium;
  }

 private:
  static bool is_zero(const Scalar& s) { return s.known() && s.value == 0; }

  // An output times density, 0 where it is not set.
  Rgb3 scaled(Index which) const {
    if (!outputs_[which]) return {};
    Rgb3 result = outputs_[which]->value.scalars;
    if (outputs_[density])
      for (Scalar& s : result)
        s = eval::product(ev_, outputs_[density]->value.scalars[0], s, outputs_[density]->span);
    return result;
  }

  Coefficients coefficients() const {
    Coefficients c;
    c.sigma_t_span = c.sigma_s_span = body_.definition;
    if (outputs_[albedo]) {
      const Value full_extinction = Value::vec(Vec3d(1.0));
      c.sigma_s_span = outputs_[albedo]->span;
      c.sigma_t_span = outputs_[density]      ? outputs_[density]->span
                       : outputs_[extinction] ? outputs_[extinction]->span
                                              : c.sigma_s_span;
      c.sigma_t = outputs_[extinction] ? scaled(extinction) : full_extinction.scalars;
      if (!outputs_[extinction] && outputs_[density]) c.sigma_t.fill(outputs_[density]->value.scalars[0]);
      for (std::size_t i = 0; i < 3; ++i)
        c.sigma_s[i] = eval::product(ev_, c.sigma_t[i], outputs_[albedo]->value.scalars[i], c.sigma_s_span);
    } else if (outputs_[scattering] || outputs_[absorption]) {
      const Rgb3 absorbed = scaled(absorption);
      c.sigma_s = scaled(scattering);
      c.sigma_s_span = (outputs_[scattering] ? outputs_[scattering] : outputs_[absorption])->span;
      c.sigma_t_span = (outputs_[absorption] ? outputs_[absorption] : outputs_[scattering])->span;
      for (std::size_t i = 0; i < 3; ++i)
        c.sigma_t[i] = eval::sum(ev_, c.sigma_s[i], absorbed[i], c.sigma_t_span);
    }
    return c;
  }

  // What a lobe's number is called and where it belongs.
  NumberRange range_of(optics::PhaseKind kind, std::size_t parameter, const Output& output) const {
    const optics::PhaseInfo& function = optics::info(kind);
    const optics::PhaseParameter& p = function.parameters[parameter];
    return {fmt::format("{} of {}", p.name, function.keyword),
            output.span,
            p.lowest,
            p.highest,
            false,
            false,
            output.branches};
  }

  scene::PhaseLobe::Number number(const Scalar& s, Span span) {
    if (s.known()) return {static_cast<float>(s.value), std::nullopt};
    return {0, list_.index(s, span)};
  }

  // Mixtures keep the sum of weights at 1 (weights of b in [0, 1]), so nothing is left to normalise.
  std::vector<scene::PhaseLobe> lobes() {
    if (!outputs_[phase]) return {scene::PhaseLobe{optics::phase_kind<optics::Isotropic>, {}, {1}}};
    std::vector<scene::PhaseLobe> result;
    const Output& output = *outputs_[phase];
    const auto* mixture = output.value.get<std::vector<eval::PhaseLobe>>();
    CHECK(mixture != nullptr);
    for (const eval::PhaseLobe& lobe : *mixture) {
      scene::PhaseLobe compiled{lobe.kind, {}, number(lobe.weight, output.span)};
      for (std::size_t k = 0; k < optics::info(lobe.kind).parameters.size(); ++k)
        compiled.parameters[k] =
            number(limits_.limited(lobe.parameters[k], range_of(compiled.kind, k, output), lobe.weight),
                   output.span);
      for (const Scalar& share : lobe.shares)
        limits_.show(share, {"w of mix", output.span, 0, 1, false, false, output.branches}, lobe.weight);
      result.push_back(compiled);
    }
    return result;
  }

  eval::Evaluator& ev_;
  const eval::Body& body_;
  Outputs outputs_;  // limited
  Limits limits_;
  OutputList list_;
};

// The program of the name's value, an output as the body set it or a name of its own.
scene::Watched watched(eval::Evaluator& ev, const std::string& name, const Outputs& outputs,
                       const eval::Scope& scope) {
  scene::Watched result;
  const auto offer = [&](std::string_view offered, const Value& value) {
    const auto width = static_cast<std::size_t>(value.width());
    if (width == 0) return;
    result.names.emplace_back(offered);
    if (offered != name) return;
    std::vector<vm::NodeId> nodes;
    for (std::size_t i = 0; i < width; ++i) nodes.push_back(ev.node(value.scalars[i]));
    result.program = ev.builder()->finish(nodes);
  };
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (outputs[i]) offer(rules[i].name, outputs[i]->value);
  for (const eval::Binding& binding : scope.bindings) offer(ev.text(binding.symbol), binding.value);
  return result;
}

}  // namespace

std::span<const OutputRule> medium_outputs() { return rules; }

std::optional<scene::Medium> compile_medium(eval::Context& context, const eval::Body& body,
                                            const Options& options) {
  eval::Evaluator in_scene(context);
  const std::optional<eval::Body> with_defaults = in_scene.bound(body, body.definition);
  if (!with_defaults) return std::nullopt;
  vm::Builder builder(options.fold, options.guards);
  eval::Evaluator ev(context, &builder, syntax::BodyKind::medium);
  bool failed = false;
  const auto scope = std::make_shared<eval::Scope>();
  scope->parent = with_defaults->scope;
  const Outputs outputs = run_body(ev, *with_defaults, scope, rules, failed);
  if (failed || !combine(ev, body, outputs)) return std::nullopt;
  std::optional<scene::Medium> medium = MediumCompiler(ev, *with_defaults, outputs).compile();
  if (medium && !options.watch.empty()) medium->watched = watched(ev, options.watch, outputs, *scope);
  return medium;
}

}  // namespace tyndall::shader
