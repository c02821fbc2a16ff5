// Phase functions as values, one built-in for each of the family (optics/phase.h), and mixtures of them.
#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "eval/calls.h"
#include "eval/operators.h"
#include "optics/phase.h"

namespace tyndall::eval {

namespace {

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

const optics::PhaseInfo* find_phase_function(std::string_view name) {
  const auto all = optics::phase_functions();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.keyword == name; });
  return found == all.end() ? nullptr : &*found;
}

Value phase_function(CallSite& site) {
  const optics::PhaseInfo* info = find_phase_function(site.name());
  CHECK(info != nullptr);
  PhaseLobe lobe{info->kind};
  std::vector<Value> numbers;
  bool ok = true;
  for (std::size_t i = 0; i < info->parameters.size(); ++i) numbers.push_back(site.as(Type::number, i, ok));
  if (!ok) return {};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const optics::PhaseParameter& p = info->parameters[i];
    const syntax::Unit unit = numbers[i].unit;
    if (p.quantity == Quantity::length && unit != syntax::Unit::none && unit != syntax::Unit::length)
      return site.ev.error(site.spans[i], fmt::format("{} wants a length", site.what(i)),
                           "for instance 0.01mm");
    if (!in_range(site, i, numbers[i], p.lowest, p.highest, p.range)) return {};
    lobe.parameters[i] = numbers[i].scalars[0];
  }
  return Value::of_heavy(Type::phase, std::vector<PhaseLobe>{lobe});
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

// Of a phase function and its parameters, with their ranges.
std::string documentation_of(const optics::PhaseInfo& info) {
  std::string text(info.documentation);
  for (const optics::PhaseParameter& p : info.parameters) {
    const std::string range = fmt::format("[{}, {}]", p.lowest, p.highest);
    text += fmt::format(" {}: {}, in {}.", p.name, p.text, p.range.empty() ? range : std::string(p.range));
  }
  return text;
}

}  // namespace

Handlers phase_handler(std::string_view name) {
  if (find_phase_function(name) != nullptr) return {phase_function};
  if (name == "mix") return {mix};
  return {};
}

std::span<const vm::Builtin> phase_builtins() {
  static const std::vector<std::string> texts = [] {
    std::vector<std::string> all;
    for (const optics::PhaseInfo& info : optics::phase_functions()) all.push_back(documentation_of(info));
    return all;
  }();
  static const std::vector<vm::Builtin> rows = [] {
    std::vector<vm::Builtin> all;
    for (const optics::PhaseInfo& info : optics::phase_functions()) {
      vm::Builtin row{info.keyword, vm::Shape::custom, {}, {}, "phase", texts[all.size()], info.example};
      for (const optics::PhaseParameter& p : info.parameters)
        row.parameters.push_back({p.name, "number", ""});
      all.push_back(std::move(row));
    }
    return all;
  }();
  return rows;
}

}  // namespace tyndall::eval
