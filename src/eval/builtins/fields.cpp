// Noise and what is made of it: a point, an optional time and options become operands.
#include <fmt/format.h>

#include <cmath>

#include "eval/builtins/maker.h"
#include "vm/kernels/noise_constants.h"

namespace tyndall::eval {

using vm::Op;

namespace {

// Reads options that settle the instruction itself, so they must be known. False after an error.
bool read_whole(CallSite& site, std::string_view name, double lowest, double highest, double& value) {
  const auto& parameters = site.entry.row->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name != name || !site.given[i]) continue;
    bool ok = true;
    const Value given = site.as(Type::number, i, ok);
    if (!ok) return false;
    if (!given.known()) {
      site.ev.error(site.spans[i], fmt::format("{} must be known when the scene is read", site.what(i)),
                    "use a constant or a parameter");
      return false;
    }
    value = given.as_number();
    if (value != std::floor(value) || value < lowest || value > highest) {
      site.ev.error(site.spans[i], fmt::format("{} wants a whole number in {}..{}, found {}", site.what(i),
                                               lowest, highest, text_of(given)));
      return false;
    }
  }
  return true;
}

struct Field {
  std::vector<Scalar> operands;
  std::uint8_t octaves = 0;
  std::uint32_t seed = 0;
};

// Reads a point, an optional time and options by their names; nothing after an error.
std::optional<Field> read_field(CallSite& site) {
  Field field;
  bool ok = true;
  const Value point = site.as(Type::vec, 0, ok);
  if (!ok) return std::nullopt;
  field.operands.assign(point.scalars.begin(), point.scalars.end());
  double octaves = 0, seed = 0;
  const auto& parameters = site.entry.row->parameters;
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    if (parameters[i].name == "octaves")
      octaves = std::strtod(std::string(parameters[i].default_value).c_str(), nullptr);
    if (parameters[i].name == "time" && site.given[i])
      field.operands.push_back(site.as(Type::number, i, ok).scalars[0]);
  }
  if (!ok || !read_whole(site, "octaves", 1, max_octaves, octaves) ||
      !read_whole(site, "seed", 0, 4294967295.0, seed))
    return std::nullopt;
  field.octaves = static_cast<std::uint8_t>(octaves);
  field.seed = static_cast<std::uint32_t>(seed);
  return field;
}

// The seed of one component of a vec of noises that have nothing to do with each other, nor with the noise of
// the seed itself or of another.
std::uint32_t seed_of_component(std::uint32_t seed, std::uint32_t component) {
  std::uint32_t h = seed * 0x9e3779b1u + (component + 1) * 0x85ebca77u;
  h = (h ^ (h >> 16)) * 0x21f0aaadu;
  h = (h ^ (h >> 15)) * 0x735a2d97u;
  return h ^ (h >> 15);
}

// Three independent noises: `space` of them, or `space_and_time` with a time.
Value three_noises(CallSite& site, const Field& field, Op space, Op space_and_time) {
  Value result = Value::of(Type::vec, {});
  for (std::uint32_t i = 0; i < 3; ++i)
    result.scalars[i] = site.ev.emit(field.operands.size() == 4 ? space_and_time : space, field.operands,
                                     site.span, field.octaves, seed_of_component(field.seed, i));
  return result;
}

Value vnoise(CallSite& site) {
  const std::optional<Field> field = read_field(site);
  return field ? three_noises(site, *field, Op::noise3, Op::noise4) : Value{};
}

// p, moved by noise.
Value warp(CallSite& site) {
  bool ok = true;
  const Value amount = site.as(Type::vec, 1, ok, true);
  const std::optional<Field> field = read_field(site);
  if (!ok || !field) return {};
  const Maker m = maker(site);
  Value result = three_noises(site, *field, Op::fbm3, Op::fbm4);
  for (std::size_t i = 0; i < 3; ++i)
    result.scalars[i] = m.add(field->operands[i], m.mul(amount.scalars[i], result.scalars[i]));
  return result;
}

// A field that lies in [least, most] without a time and with one, and is carried to [0, 1].
struct UnitField {
  Op space, space_and_time;
  struct Range {
    double least, most;
  } ranges[2];
};

constexpr UnitField::Range even(double most) { return {-most, most}; }
constexpr UnitField::Range turbulent(double mean, double most) {
  return {-mean / (1 - mean), (most - mean) / (1 - mean)};
}
constexpr UnitField::Range ridged(double mean) { return {-1, 1 / mean - 1}; }

UnitField unit_field(std::string_view name) {
  const double most3 = double{vm::noise_constants3.supremum}, most4 = double{vm::noise_constants4.supremum};
  if (name == "noise01") return {Op::noise3, Op::noise4, {even(most3), even(most4)}};
  if (name == "fbm01") return {Op::fbm3, Op::fbm4, {even(most3), even(most4)}};
  if (name == "ridged01")
    return {Op::ridged3, Op::ridged4, {ridged(double{vm::mean_ridge3}), ridged(double{vm::mean_ridge4})}};
  return {Op::turbulence3,
          Op::turbulence4,
          {turbulent(double{vm::mean_absolute3}, most3), turbulent(double{vm::mean_absolute4}, most4)}};
}

Value field01(CallSite& site) {
  const std::optional<Field> field = read_field(site);
  if (!field) return {};
  const UnitField unit = unit_field(site.name());
  const bool has_time = field->operands.size() == 4;
  const UnitField::Range& range = unit.ranges[has_time];
  const double scale = 1 / (range.most - range.least);
  const Maker m = maker(site);
  const Scalar value = site.ev.emit(has_time ? unit.space_and_time : unit.space, field->operands, site.span,
                                    field->octaves, field->seed);
  return number(m.op(Op::saturate, {m.add(m.mul(value, Scalar{scale}), Scalar{-range.least * scale})}));
}

}  // namespace

Value call_field(CallSite& site) {
  const std::optional<Field> field = read_field(site);
  if (!field) return {};
  const Op op = site.entry.row->ops[field->operands.size() == 4 ? 1 : 0];
  return Value::of(Type::number, {site.ev.emit(op, field->operands, site.span, field->octaves, field->seed)});
}

Value call_vector_field(CallSite& site) {
  const std::optional<Field> field = read_field(site);
  if (!field) return {};
  Value result = Value::of(Type::vec, {});
  const std::size_t first = field->operands.size() == 4 ? 3 : 0;
  for (std::size_t i = 0; i < 3; ++i)
    result.scalars[i] =
        site.ev.emit(site.entry.row->ops[first + i], field->operands, site.span, field->octaves, field->seed);
  return result;
}

Handlers field_handler(std::string_view name) {
  if (name == "vnoise") return {vnoise};
  if (name == "warp") return {warp};
  if (name == "noise01" || name == "fbm01" || name == "turbulence01" || name == "ridged01") return {field01};
  return {};
}

}  // namespace tyndall::eval
