// Phase functions as values: isotropic, rayleigh, hg, draine, droplets and mixtures of them.
#include <fmt/format.h>

#include "eval/calls.h"
#include "eval/operators.h"

namespace tyndall::eval {

namespace {

Value lobe(PhaseLobe::Kind kind, const Scalar& first = {}, const Scalar& second = {}) {
  return Value::of_heavy(Type::phase, std::vector<PhaseLobe>{PhaseLobe{kind, {first, second}, Scalar{1}}});
}

// Ranges as optics::parameters has them (tests/shader compares).
constexpr double greatest_g = 0.9999, greatest_a = 1e6, least_droplet = 5e-6, greatest_droplet = 50e-6;

// Whether a number, where it is known, lies in [low, high]: reported.
bool in_range(CallSite& site, std::size_t i, const Value& value, double low, double high,
              std::string_view range = {}) {
  const Scalar& s = value.scalars[0];
  if (!s.known() || (s.value >= low && s.value <= high)) return true;
  site.ev.error(
      site.spans[i],
      fmt::format("{} must lie in {}, found {}", site.what(i),
                  range.empty() ? fmt::format("[{}, {}]", low, high) : std::string(range), text_of(value)));
  return false;
}

Value isotropic(CallSite&) { return lobe(PhaseLobe::Kind::isotropic); }
Value rayleigh(CallSite&) { return lobe(PhaseLobe::Kind::rayleigh); }

Value hg(CallSite& site) {
  bool ok = true;
  const Value g = site.as(Type::number, 0, ok);
  if (!ok || !in_range(site, 0, g, -greatest_g, greatest_g)) return {};
  return lobe(PhaseLobe::Kind::hg, g.scalars[0]);
}

Value draine(CallSite& site) {
  bool ok = true;
  const Value g = site.as(Type::number, 0, ok), a = site.as(Type::number, 1, ok);
  if (!ok || !in_range(site, 0, g, -greatest_g, greatest_g) || !in_range(site, 1, a, 0, greatest_a))
    return {};
  return lobe(PhaseLobe::Kind::draine, g.scalars[0], a.scalars[0]);
}

Value droplets(CallSite& site) {
  bool ok = true;
  const Value diameter = site.as(Type::number, 0, ok);
  if (!ok) return {};
  if (diameter.unit != syntax::Unit::none && diameter.unit != syntax::Unit::length)
    return site.ev.error(site.spans[0], fmt::format("{} wants a length", site.what(0)),
                         "for instance 0.01mm");
  if (!in_range(site, 0, diameter, least_droplet, greatest_droplet, "[0.005mm, 0.05mm]")) return {};
  return lobe(PhaseLobe::Kind::droplets, diameter.scalars[0]);
}

// mix(a, b, w) of two phase functions; a weight that is not known is kept in [0, 1] as it is computed. Each
// lobe remembers it as it was.
Value mix(CallSite& site) {
  bool ok = true;
  const Value w = site.as(Type::number, 2, ok);
  if (!ok || !in_range(site, 2, w, 0, 1)) return {};
  const Scalar given = w.scalars[0];
  if (given.known()) return mixed_phases(site.ev, site.arguments[0], site.arguments[1], given, site.span);
  const Scalar weight = site.ev.emit(vm::Op::limit, {given, Scalar{0}, Scalar{1}}, site.spans[2]);
  const Value mixed = mixed_phases(site.ev, site.arguments[0], site.arguments[1], weight, site.span);
  std::vector<PhaseLobe> lobes = *mixed.get<std::vector<PhaseLobe>>();
  for (PhaseLobe& lobe : lobes) lobe.shares.push_back(given);
  return Value::of_heavy(Type::phase, std::move(lobes));
}

}  // namespace

Handlers phase_handler(std::string_view name) {
  if (name == "isotropic") return {isotropic};
  if (name == "rayleigh") return {rayleigh};
  if (name == "hg") return {hg};
  if (name == "draine") return {draine};
  if (name == "droplets") return {droplets};
  if (name == "mix") return {mix};
  return {};
}

std::span<const vm::Builtin> phase_builtins() {
  using vm::Builtin;
  using vm::Shape;
  static const std::vector<Builtin> rows = {
      {"isotropic",
       Shape::custom,
       {},
       {},
       "phase",
       "Scatters alike in all directions.",
       "isotropic"},
      {"rayleigh",
       Shape::custom,
       {},
       {},
       "phase",
       "Scatters as particles far smaller than the wavelength do.",
       "rayleigh"},
      {"hg",
       Shape::custom,
       {},
       {{"g", "number", ""}},
       "phase",
       "Henyey and Greenstein's phase function of mean cosine g in [-0.9999, 0.9999]: forward for g > 0.",
       "hg(0.6)"},
      {"draine",
       Shape::custom,
       {},
       {{"g", "number", ""}, {"a", "number", ""}},
       "phase",
       "Draine's phase function of dust, g in [-0.9999, 0.9999], a in [0, 1e6]; a = 0 is hg, a = 1 and g = 0 "
       "is rayleigh.",
       "draine(0.5, 1)"},
      {"droplets",
       Shape::custom,
       {},
       {{"diameter", "number", ""}},
       "phase",
       "Water droplets of that diameter in metres, 0.005mm to 0.05mm, as in fog and clouds.",
       "droplets(0.01mm)"},
  };
  return rows;
}

}  // namespace tyndall::eval
