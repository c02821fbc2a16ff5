// What is told of media in their volumes: see medium_warnings.h.
#include "resolve/checks/medium_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/numerics.h"
#include "optics/phase.h"
#include "resolve/checks/medium_probe.h"
#include "resolve/checks/placed_things.h"
#include "resolve/resolve_context.h"
#include "resolve/told_values.h"

namespace tyndall::resolve {

namespace {

// A check is to take milliseconds: volumes of a medium, and of all media, that are looked into.
constexpr int most_volumes_of_a_medium = 4, most_volumes_in_all = 100;

// ------------------------------------------------------------------------------------------- values

std::string place_text(const Vec3d& p) { return fmt::format("p = ({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z); }

// The place at which the number is furthest out of its range, of each statement that gives such ones.
struct Furthest {
  OutOfRange kind = OutOfRange::undefined;
  float value = 0;
  Vec3d p;
  bool operator<(const Furthest& other) const {
    return kind == other.kind && (kind == OutOfRange::below ? value > other.value : value < other.value);
  }
};

std::map<std::pair<std::size_t, OutOfRange>, Furthest> furthest_of(const scene::GivenNumber& given,
                                                                   const MediumProbe& probe,
                                                                   const MediumProbe::Values& values) {
  std::map<std::pair<std::size_t, OutOfRange>, Furthest> all;
  // As the renderer compares them.
  const auto lowest = static_cast<float>(given.lowest), highest = static_cast<float>(given.highest);
  for (std::size_t i = 0; i < values.p.size(); ++i) {
    const float v = values.outputs[given.output][i];
    if (v >= lowest && v <= highest) continue;
    const OutOfRange kind = std::isnan(v) ? OutOfRange::undefined
                            : v < lowest  ? OutOfRange::below
                                          : OutOfRange::above;
    const auto branch =
        given.branches.empty() ? 0 : static_cast<std::size_t>(values.outputs[given.branch_output][i]);
    const Furthest now{kind, v, values.p[i]};
    const auto known = all.find({branch, kind});
    if ((known == all.end() || known->second < now) && probe.is_inside(values.p[i]))
      all.insert_or_assign({branch, kind}, now);
  }
  return all;
}

void warn_of_values(Run& run, const scene::Medium& medium, MediumProbe& probe) {
  for (const scene::GivenNumber& given : medium.given) {
    const MediumProbe::Values values = probe.values_where(given.output, given.lowest, given.highest);
    for (const auto& [which, furthest] : furthest_of(given, probe, values)) {
      const Span span = given.branches.empty() ? given.span : given.branches[which.first];
      std::string message = told_out_of_range(given.name, furthest.kind, given.lowest, given.highest);
      // Of every volume of the medium it is told once.
      const bool told =
          std::any_of(run.diagnostics.all().begin(), run.diagnostics.all().end(),
                      [&](const Diagnostic& d) { return d.span == span && d.message.starts_with(message); });
      if (told) continue;
      message += furthest.kind == OutOfRange::undefined
                     ? fmt::format(", at {}, and taken as {}", place_text(furthest.p),
                                   std::clamp(0.0, given.lowest, given.highest))
                     : fmt::format(": {:.3g} at {}, taken as {:.6g}", furthest.value, place_text(furthest.p),
                                   furthest.kind == OutOfRange::below ? given.lowest : given.highest);
      std::string help = help_for_out_of_range(furthest.kind, given.lowest, given.highest);
      if (run.options.strict)
        run.diagnostics.error(span, std::move(message), std::move(help));
      else
        run.diagnostics.warning(span, std::move(message), std::move(help));
    }
  }
}

// -------------------------------------------------------------------------------------------- empty

// Whether a product with a constant 0 may make it empty: someone has switched it off.
bool is_switched_off(const vm::Program& program) {
  const auto zero = [&](vm::Operand o) { return program.constant(o) && program.constants[o] == 0; };
  const auto by_zero = [&](const vm::Instruction& i) {
    return i.op == vm::Op::mul && (zero(i.operands[0]) || zero(i.operands[1]));
  };
  return std::any_of(program.lane_code.begin(), program.lane_code.end(), by_zero) ||
         std::any_of(program.uniform_code.begin(), program.uniform_code.end(), by_zero);
}

bool is_empty(const scene::Medium& medium, const MediumProbe& probe) {
  const auto is_zero = [](const vm::ValueBounds& b) { return b.hi <= 0 && !b.may_be_nan; };
  return is_zero(probe.bounds(medium.sigma_t)) &&
         (!medium.emission || is_zero(probe.bounds(*medium.emission)));
}

// --------------------------------------------------------------------------------------------- step

// Less than this much from the least to the most is no variation that a step could miss.
constexpr float even_ratio = 1.25f;

bool varies(const scene::Medium& medium, const MediumProbe& probe) {
  const auto range = [&](const scene::RgbOutputs& outputs) {
    const vm::ValueBounds b = probe.bounds(outputs);
    return b.may_be_nan || b.hi > even_ratio * std::max(b.lo, 0.0f);
  };
  return range(medium.sigma_t) || (medium.emission && range(*medium.emission));
}

void warn_of_step(Run& run, const scene::Volume& volume, const MediumProbe& probe,
                  const scene::RenderSettings& settings) {
  const scene::Step step = volume.step.value_or(settings.step);
  const double across = probe.diagonal();
  if (!step.fixed() || !(step.metres > across)) return;
  run.diagnostics.warning(
      volume.definition,
      fmt::format("a step of {:.3g} m is longer than this volume, which is {:.2g} m across: every ray looks "
                  "into its medium once",
                  step.metres, across),
      fmt::format("`step: {:.1g}`, a 30th of it, or no `step`, which chooses one", across / 30));
}

// ------------------------------------------------------------------------------------------ bounces

// Means over a volume.
struct Thickness {
  double sigma_t = 0, sigma_s = 0;  // of the brightest channel [1/m]
  double cosine = 0;                // of the phase functions, weighted by what each scatters
  double filled = 0;                // the share of places that have much of it
};

double mean_cosine(const scene::Medium& medium, const MediumProbe::Values& values, std::size_t i) {
  double sum = 0, weights = 0;
  const auto number = [&](const scene::PhaseLobe::Number& n) {
    return n.output ? values.outputs[*n.output][i] : n.value;
  };
  for (const scene::PhaseLobe& lobe : medium.phase) {
    std::array<float, optics::most_phase_parameters> parameters{};
    for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k] = number(lobe.parameters[k]);
    const double weight = number(lobe.weight);
    sum += weight * optics::Phase(lobe.kind, parameters).mean_cosine();
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

Thickness thickness_of(const scene::Medium& medium, const MediumProbe::Values& values) {
  Thickness out;
  double scattered = 0;
  std::array<double, 3> sigma_t{}, sigma_s{};
  for (std::size_t i = 0; i < values.p.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      sigma_t[c] += std::max(values.outputs[medium.sigma_t[c]][i], 0.0f);
      sigma_s[c] += std::max(values.outputs[medium.sigma_s[c]][i], 0.0f);
    }
    const double s = std::max(values.outputs[medium.sigma_s[1]][i], 0.0f);
    scattered += s;
    if (s > 0) out.cosine += s * mean_cosine(medium, values, i);
  }
  const auto brightest =
      static_cast<std::size_t>(std::max_element(sigma_s.begin(), sigma_s.end()) - sigma_s.begin());
  const auto count = static_cast<double>(values.p.size());
  out.sigma_t = sigma_t[brightest] / count;
  out.sigma_s = sigma_s[brightest] / count;
  if (scattered > 0) out.cosine /= scattered;
  for (const float s : values.outputs[medium.sigma_s[brightest]]) out.filled += s > out.sigma_s / 4;
  out.filled /= count;
  return out;
}

// About the part of the light that falls on a box of an even medium, and would leave it, that is scattered
// more often than `count` times. By the theory of diffusion: of light that enters a half-space which absorbs
// nothing, 1.3 / sqrt(n) is scattered more than n times (the square root that the albedo of a half-space has
// at 1: van de Hulst, "Multiple Light Scattering", 1980); each scattering absorbs its share, and lets leave
// as much as the slowest mode of the box loses. With n scaled by 1 - g for light that is scattered forwards.
double share_beyond(double count, const Thickness& t, const Vec3d& sides) {
  const double reduced = t.sigma_t - t.sigma_s * t.cosine, forward = 1 - std::max(t.cosine, 0.0);
  double leak = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) leak += sqr(pi / (sides[axis] * reduced + 1.42)) / 3;
  const double stays = std::log(t.sigma_s / t.sigma_t) - leak * forward;
  return std::min(1.0, 1.3 / std::sqrt(count * forward)) * std::exp(stays * count);
}

void warn_of_bounces(Run& run, const scene::Volume& volume, const scene::Medium& medium, MediumProbe& probe,
                     const scene::RenderSettings& settings) {
  // What the renderer measures is told from 1 % on; an estimate wants more to be believed.
  constexpr double told_share = 0.2, good_share = 0.01;
  // Light leaves thin shells and single clouds sooner than an even medium of the same mean.
  constexpr double least_filled = 0.25;
  // Direct light alone is asked for by that.
  if (settings.bounces == 0) return;
  if (!medium.scatters() || settings.multiple_scattering.approximate) return;
  const MediumProbe::Values& values = probe.values();
  if (values.p.empty()) return;
  const Thickness t = thickness_of(medium, values);
  if (!(t.sigma_s > 0) || !(t.sigma_t >= t.sigma_s) || t.filled < least_filled) return;
  const auto beyond = [&](double bounces) { return share_beyond(bounces + 1, t, probe.sides()); };
  const double cut = beyond(settings.bounces);
  if (!(cut > told_share)) return;
  double enough = std::max(settings.bounces, 1);
  while (enough < 1e6 && beyond(enough) > good_share) enough *= 1.25;
  const double unit = std::pow(10.0, std::floor(std::log10(enough)));
  run.diagnostics.warning(
      volume.definition,
      fmt::format("`bounces: {}` will leave out about {:.0f} % of the light that this medium scatters: it is "
                  "dense and bright",
                  settings.bounces, std::round(cut * 10) * 10),
      enough < 1e6
          ? fmt::format("`bounces: {:.0f}` would leave out 1 %; `multiple_scattering: approximate` "
                        "costs less than either",
                        std::ceil(enough / unit) * unit)
          : "`multiple_scattering: approximate` stands in for the light that is scattered more often");
}

}  // namespace

void warn_of_media(Run& run, const scene::RenderSettings& settings) {
  const scene::Scene& s = run.scene;
  Boxes boxes(s);
  std::map<std::uint32_t, int> looked_into;
  // By statement, as of volumes out of view: a volume is told of once, and is not empty when another is not.
  struct Seen {
    Span definition;
    bool empty = true, thick = false, coarse = false;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Seen> statements;
  int left = most_volumes_in_all;
  for (const scene::Volume& volume : scene::all_volumes(s)) {
    Seen& seen = statements[{volume.definition.source.index, volume.definition.begin}];
    seen.definition = volume.definition;
    const scene::Medium& medium = s.media[volume.medium.index];
    const bool looks = left > 0 && ++looked_into[volume.medium.index] <= most_volumes_of_a_medium;
    MediumProbe probe(s, volume, boxes, looks);
    if (!probe.fits()) {
      seen.empty = false;
      continue;
    }
    --left;
    const std::size_t told = run.diagnostics.all().size();
    warn_of_values(run, medium, probe);
    const bool is_right = run.diagnostics.all().size() == told;  // what is taken as 0 is told already
    seen.empty = seen.empty && is_right && !medium.homogeneous() && is_empty(medium, probe);
    if (!std::exchange(seen.coarse, true) && !medium.homogeneous() && varies(medium, probe))
      warn_of_step(run, volume, probe, settings);
    if (!std::exchange(seen.thick, true)) warn_of_bounces(run, volume, medium, probe, settings);
    if (seen.empty && is_switched_off(medium.full)) seen.empty = false;
  }
  if (!is_still(s.animation)) return;
  for (const auto& [place, seen] : statements)
    if (seen.empty)
      run.diagnostics.warning(
          seen.definition, "this volume is empty: its medium is proven to be 0 in all of it",
          "`p` is measured from the volume's own `transform`, `P` from the scene's origin");
}

}  // namespace tyndall::resolve
