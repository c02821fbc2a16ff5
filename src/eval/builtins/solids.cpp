// Distances to solids, and how they are joined.
#include <fmt/format.h>

#include "eval/builtins/maker.h"

namespace tyndall::eval {

using vm::Op;

namespace {

// Distances to solids, negative inside. After Inigo Quilez, "Distance functions" (iquilezles.org).
Value sd_sphere(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::vec, 0, ok), radius = site.as(Type::number, 1, ok);
  const Maker m = maker(site);
  return ok ? number(m.sub(m.length(p), radius.scalars[0])) : Value{};
}

Value sd_box(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::vec, 0, ok), half = site.as(Type::vec, 1, ok, true);
  if (!ok) return {};
  const Maker m = maker(site);
  Value outside = p;
  std::array<Scalar, 3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    q[i] = m.sub(m.op(Op::abs, {p.scalars[i]}), half.scalars[i]);
    outside.scalars[i] = m.max(q[i], Scalar{0});
  }
  return number(m.add(m.length(outside), m.min(m.max(q[0], m.max(q[1], q[2])), Scalar{0})));
}

// Around the y axis: `ring` from the axis to the middle of the tube, `tube` the radius of the tube.
Value sd_torus(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::vec, 0, ok), ring = site.as(Type::number, 1, ok),
              tube = site.as(Type::number, 2, ok);
  if (!ok) return {};
  const Maker m = maker(site);
  const Scalar q = m.sub(m.op(Op::length2, {p.scalars[0], p.scalars[2]}), ring.scalars[0]);
  return number(m.sub(m.op(Op::length2, {q, p.scalars[1]}), tube.scalars[0]));
}

Value sd_capsule(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::vec, 0, ok), a = site.as(Type::vec, 1, ok), b = site.as(Type::vec, 2, ok);
  const Value radius = site.as(Type::number, 3, ok);
  if (!ok) return {};
  const Maker m = maker(site);
  const Value pa = m.subtract(p, a), ba = m.subtract(b, a);
  const Scalar length_squared = m.dot(ba, ba);
  Scalar h{0};  // a capsule of no length is a sphere
  if (!length_squared.known() || length_squared.value > 0)
    h = m.op(Op::clamp, {m.div(m.dot(pa, ba), length_squared), Scalar{0}, Scalar{1}});
  return number(m.sub(m.length(m.subtract(pa, m.scaled(ba, h))), radius.scalars[0]));
}

// A place beside a rod: its distance to the axis, how far along it is (0 at `from`, 1 at `to`), and the rod's
// length.
struct BesideRod {
  Scalar radial, along, length;
};

// Of the arguments `p`, `from` and `to`, the first three; nothing after an error.
std::optional<BesideRod> beside_rod(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::vec, 0, ok), a = site.as(Type::vec, 1, ok), b = site.as(Type::vec, 2, ok);
  if (!ok) return std::nullopt;
  const Maker m = maker(site);
  const Value pa = m.subtract(p, a), ba = m.subtract(b, a);
  const Scalar square = m.dot(ba, ba);
  if (square.known() && square.value == 0) {
    site.ev.error(site.spans[2], fmt::format("{} is the same place as 'from'", site.what(2)),
                  "give the two ends of its axis");
    return std::nullopt;
  }
  const Scalar along = m.div(m.dot(pa, ba), square);
  return BesideRod{m.length(m.subtract(pa, m.scaled(ba, along))), along, m.length(ba)};
}

// How far beyond the nearer end, negative between the ends; in parts of the length.
Scalar beyond_ends(const Maker& m, const BesideRod& place) {
  return m.sub(m.op(Op::abs, {m.sub(place.along, Scalar{0.5})}), Scalar{0.5});
}

Value sd_cylinder(CallSite& site) {
  bool ok = true;
  const Value radius = site.as(Type::number, 3, ok);
  const std::optional<BesideRod> place = beside_rod(site);
  if (!ok || !place) return {};
  const Maker m = maker(site);
  const Scalar x = m.sub(place->radial, radius.scalars[0]), y = m.mul(beyond_ends(m, *place), place->length);
  const Scalar outside = m.op(Op::length2, {m.max(x, Scalar{0}), m.max(y, Scalar{0})});
  return number(m.add(m.min(m.max(x, y), Scalar{0}), outside));
}

// The nearer of its ends and its side; negative where the place is inside of both.
Value sd_cone(CallSite& site) {
  bool ok = true;
  const Scalar radius = site.as(Type::number, 3, ok).scalars[0];
  const Scalar tip = site.given[4] ? site.as(Type::number, 4, ok).scalars[0] : Scalar{0};
  const std::optional<BesideRod> place = beside_rod(site);
  if (!ok || !place) return {};
  const Maker m = maker(site);
  const Scalar zero{0}, growth = m.sub(tip, radius), square = m.mul(place->length, place->length);
  const Scalar end_radius = m.op(Op::select, {m.op(Op::less, {place->along, Scalar{0.5}}), radius, tip});
  const Scalar beyond = beyond_ends(m, *place);
  const Scalar to_end =
      m.op(Op::length2, {m.max(m.sub(place->radial, end_radius), zero), m.mul(beyond, place->length)});
  const Scalar wider = m.sub(place->radial, radius);
  const Scalar foot = m.op(Op::clamp, {m.div(m.add(m.mul(growth, wider), m.mul(place->along, square)),
                                             m.add(m.mul(growth, growth), square)),
                                       zero, Scalar{1}});
  const Scalar from_side = m.sub(wider, m.mul(foot, growth));
  const Scalar to_side = m.op(Op::length2, {from_side, m.mul(m.sub(place->along, foot), place->length)});
  const Scalar distance = m.min(to_end, to_side);
  const Scalar inside =
      m.op(Op::logical_and, {m.op(Op::less, {from_side, zero}), m.op(Op::less, {beyond, zero})});
  return number(m.op(Op::select, {inside, m.op(Op::neg, {distance}), distance}));
}

// Of the first order: |p / r| - 1 in units of the radius in the direction of p, which lies between the least
// and the largest.
Value sd_ellipsoid(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::vec, 0, ok), radii = site.as(Type::vec, 1, ok, true);
  if (!ok) return {};
  for (const Scalar& r : radii.scalars)
    if (r.known() && !(r.value > 0))
      return site.ev.error(site.spans[1], fmt::format("{} must be greater than 0", site.what(1)));
  const Maker m = maker(site);
  Value once = p, twice = p;
  for (std::size_t i = 0; i < 3; ++i) {
    once.scalars[i] = m.div(p.scalars[i], radii.scalars[i]);
    twice.scalars[i] = m.div(once.scalars[i], radii.scalars[i]);
  }
  const auto& r = radii.scalars;
  const Scalar size = m.length(once);
  const Scalar radius = m.op(Op::clamp, {m.div(size, m.max(m.length(twice), Scalar{1e-30})),
                                         m.min(r[0], m.min(r[1], r[2])), m.max(r[0], m.max(r[1], r[2]))});
  return number(m.mul(m.sub(size, Scalar{1}), radius));
}

Value sd_plane(CallSite& site) {
  bool ok = true;
  const Value p = site.as(Type::vec, 0, ok), normal = site.as(Type::vec, 1, ok);
  const Scalar offset = site.given[2] ? site.as(Type::number, 2, ok).scalars[0] : Scalar{0};
  if (!ok) return {};
  const Maker m = maker(site);
  const Scalar length = m.length(normal);
  if (length.known() && length.value == 0)
    return site.ev.error(site.spans[1], "a vec of length 0 has no direction");
  return number(m.sub(m.div(m.dot(p, normal), length), offset));
}

// The lesser of a and b with the edge rounded over the width k > 0 that is the third argument: min - max(k -
// |a - b|, 0)^2 / (4 k). Nothing after an error.
std::optional<Scalar> rounded_least(CallSite& site, const Scalar& a, const Scalar& b) {
  bool ok = true;
  const Value k = site.as(Type::number, 2, ok);
  if (!ok) return std::nullopt;
  const Maker m = maker(site);
  const Scalar least = m.min(a, b);
  if (k.known() && k.as_number() < 0) {
    site.ev.error(site.spans[2], fmt::format("{} must not be negative", site.what(2)));
    return std::nullopt;
  }
  if (k.known() && k.as_number() == 0) return least;
  const Scalar h = m.max(m.sub(k.scalars[0], m.op(Op::abs, {m.sub(a, b)})), Scalar{0});
  return m.sub(least, m.div(m.mul(h, h), m.mul(Scalar{4}, k.scalars[0])));
}

Value smooth_union(CallSite& site) {
  bool ok = true;
  const Scalar a = site.as(Type::number, 0, ok).scalars[0], b = site.as(Type::number, 1, ok).scalars[0];
  if (!ok) return {};
  const std::optional<Scalar> least = rounded_least(site, a, b);
  return least ? number(*least) : Value{};
}

Value smooth_max(CallSite& site) {
  bool ok = true;
  const Scalar a = site.as(Type::number, 0, ok).scalars[0], b = site.as(Type::number, 1, ok).scalars[0];
  if (!ok) return {};
  const Maker m = maker(site);
  const std::optional<Scalar> least = rounded_least(site, m.op(Op::neg, {a}), m.op(Op::neg, {b}));
  return least ? number(m.op(Op::neg, {*least})) : Value{};
}

// max(a, -b): what is inside of a and outside of b.
Value smooth_subtract(CallSite& site) {
  bool ok = true;
  const Scalar a = site.as(Type::number, 0, ok).scalars[0], b = site.as(Type::number, 1, ok).scalars[0];
  if (!ok) return {};
  const Maker m = maker(site);
  const std::optional<Scalar> least = rounded_least(site, m.op(Op::neg, {a}), b);
  return least ? number(m.op(Op::neg, {*least})) : Value{};
}

}  // namespace

Handlers solid_handler(std::string_view name) {
  static constexpr std::pair<std::string_view, Value (*)(CallSite&)> handlers[] = {
      {"sd_sphere", sd_sphere},
      {"sd_box", sd_box},
      {"sd_torus", sd_torus},
      {"sd_capsule", sd_capsule},
      {"sd_cylinder", sd_cylinder},
      {"sd_cone", sd_cone},
      {"sd_ellipsoid", sd_ellipsoid},
      {"sd_plane", sd_plane},
      {"smooth_union", smooth_union},
      {"smooth_max", smooth_max},
      {"smooth_subtract", smooth_subtract}};
  for (const auto& [word, handler] : handlers)
    if (word == name) return {handler};
  return {};
}

}  // namespace tyndall::eval
