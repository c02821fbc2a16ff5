// Rays against combined shapes, by the intervals of a line within each part.
//
// An end of the combination's interval is, bit by bit, an end of one part's: so it is found again, and what a
// hit tells is what that part tells. Intervals are half-open, so parts that meet in a face leave nothing
// between them. Faces that are meant to be in one place may differ by rounding, when transforms or different
// numbers lead there: what is left of a difference or an intersection, and what separates two parts of a
// union, counts for nothing where it is shorter than `coincidence` of the largest coordinate.
#include "shapes/combination.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "shapes/combined_parts.h"
#include "shapes/placed_error.h"

namespace tyndall::shapes {

namespace {

// 2^12 roundings: faces that are the same but for a transform and back, met down to a 1000th of a radian.
constexpr double coincidence = 0x1p-40;

void append(Stays& out, const Intervald& stay) {
  if (!stay.empty()) out.push_back(stay);
}
template <std::size_t N>
void append(Stays& out, const std::array<Intervald, N>& stays) {
  for (const Intervald& stay : stays) append(out, stay);
}
void append(Stays& out, const Stays& stays) {
  for (const Intervald& stay : stays) append(out, stay);
}

void append_longer(Stays& out, const Intervald& stay, double least) {
  if (stay.hi - stay.lo > least) out.push_back(stay);
}

Stays in_both(const Stays& a, const Stays& b, double least) {
  Stays out;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    append_longer(out, a[i].clipped_to(b[k]), least);
    if (a[i].hi < b[k].hi)
      ++i;
    else
      ++k;
  }
  return out;
}

Stays in_either(const Stays& a, const Stays& b, double least) {
  Stays out;
  for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
    const bool from_a = k == b.size() || (i < a.size() && a[i].lo <= b[k].lo);
    const Intervald& next = from_a ? a[i++] : b[k++];
    if (!out.empty() && next.lo - out[out.size() - 1].hi <= least)
      out[out.size() - 1].hi = std::max(out[out.size() - 1].hi, next.hi);
    else
      out.push_back(next);
  }
  return out;
}

Stays in_first_alone(const Stays& a, const Stays& b, double least) {
  Stays out;
  std::size_t k = 0;
  for (Intervald rest : a) {
    while (k < b.size() && b[k].hi <= rest.lo) ++k;
    for (std::size_t i = k; i < b.size() && b[i].lo < rest.hi; ++i) {
      append_longer(out, {rest.lo, b[i].lo}, least);
      rest.lo = b[i].hi;
    }
    append_longer(out, rest, least);
  }
  return out;
}

// Whether a line goes through a box, which has room for rounding.
bool meets(const Bounds& box, const Vec3d& origin, const Vec3d& direction) {
  return !Box{box.lo, box.hi}.inside(origin, direction).empty();
}

double largest_coordinate(const Bounds& b) { return max_component(larger(b.lo, b.hi)); }

Bounds with_room(const Bounds& b) {
  const Vec3d room(coincidence * largest_coordinate(b));
  return {b.lo - room, b.hi + room};
}

Bounds placed_bounds(const Bounds& b, const Transform& to) {
  const Vec3d middle = to.point((b.lo + b.hi) * 0.5);
  return around(middle, middle, spread(to, (b.hi - b.lo) * 0.5));
}

Bounds around_both(const Bounds& a, const Bounds& b) {
  Bounds out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.lo[axis] = std::min(a.lo[axis], b.lo[axis]);
    out.hi[axis] = std::max(a.hi[axis], b.hi[axis]);
  }
  return out;
}

Bounds common(const Bounds& a, const Bounds& b) {
  Bounds out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
    out.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
  }
  return out;
}

// Calls visit(shape) for the closed shape that a part is.
template <class Visit>
auto visit_closed(const Shape& shape, Visit&& visit) {
  using Result = std::invoke_result_t<Visit, const Sphere&>;
  return std::visit(
      [&](const auto& s) -> Result {
        if constexpr (Closed<std::decay_t<decltype(s)>>) {
          return visit(s);
        } else {
          CHECK(false);
          return {};
        }
      },
      shape);
}

Bounds bounds_of(const Shape& shape) {
  return visit_closed(shape, [](const auto& s) { return s.bounds(); });
}

}  // namespace

CombinedPart::CombinedPart(const Shape& part, const Transform& outer_from_part)
    : shape(part), bounds(bounds_of(part)) {
  if (outer_from_part != Transform{}) {
    const Transform back = inverse_of(outer_from_part);
    placed = {outer_from_part, back,
              std::sqrt(length_squared(back.x) + length_squared(back.y) + length_squared(back.z))};
    bounds = placed_bounds(bounds, outer_from_part);
  }
  bounds = with_room(bounds);
}

Stays CombinedPart::inside(const Vec3d& origin, const Vec3d& direction) const {
  Stays out;
  if (!meets(bounds, origin, direction)) return out;
  const Vec3d o = placed ? placed->part_from_outer.point(origin) : origin;
  const Vec3d d = placed ? placed->part_from_outer.vector(direction) : direction;
  visit_closed(shape, [&](const auto& s) {
    append(out, s.inside(o, d));
    return true;
  });
  return out;
}

ShapeHit CombinedPart::hit_at(const Vec3d& origin, const Vec3d& direction, double t) const {
  const Vec3d o = placed ? placed->part_from_outer.point(origin) : origin;
  const Vec3d d = placed ? placed->part_from_outer.vector(direction) : direction;
  std::optional<ShapeHit> found =
      visit_closed(shape, [&](const auto& s) { return s.hit(o, d, std::nextafter(t, -infinity), infinity); });
  CHECK(found.has_value());
  ShapeHit hit = *found;
  hit.t = t;
  if (!placed) return hit;
  const Transform &out = placed->outer_from_part, &back = placed->part_from_outer;
  hit.position = out.point(found->position);
  hit.normal = out.normal(found->normal);
  hit.shading_normal = out.normal(found->shading_normal);
  hit.reach = placed_error(out, back, found->position, hit.position, found->reach * rounding) / rounding;
  return hit;
}

double CombinedPart::depth(const Vec3d& p) const {
  return visit_closed(shape, [&](const auto& s) {
    return placed ? s.depth(placed->part_from_outer.point(p)) / placed->growth : s.depth(p);
  });
}

CombinedParts::CombinedParts(Combining how_, std::vector<CombinedPart> list_)
    : how(how_), list(std::move(list_)) {
  CHECK(!list.empty());
  bounds = list[0].bounds;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const CombinedParts* const inner = parts_of(list[i].shape);
    count += inner ? inner->count : 1;
    depth = std::max(depth, inner ? inner->depth + 1 : 1);
    extent = std::max(extent, largest_coordinate(list[i].bounds));
    if (how == Combining::union_) bounds = around_both(bounds, list[i].bounds);
    if (how == Combining::intersection) bounds = common(bounds, list[i].bounds);
  }
  empty = !(min_component(bounds.hi - bounds.lo) > 0);
  if (empty) bounds = list[0].bounds;
}

const CombinedParts* parts_of(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> const CombinedParts* {
        if constexpr (requires { s.parts; })
          return s.parts.get();
        else
          return nullptr;
      },
      shape);
}

bool same(const CombinedParts& a, const CombinedParts& b) {
  if (a.how != b.how || a.list.size() != b.list.size()) return false;
  for (std::size_t i = 0; i < a.list.size(); ++i) {
    const CombinedPart &p = a.list[i], &q = b.list[i];
    if (p.shape.index() != q.shape.index() || p.placed.has_value() != q.placed.has_value()) return false;
    if (p.placed && p.placed->outer_from_part != q.placed->outer_from_part) return false;
    if (const CombinedParts* const inner = parts_of(p.shape)) {
      if (!same(*inner, *parts_of(q.shape))) return false;
      continue;
    }
    const bool equal = std::visit(
        [&](const auto& s) {
          bool all = true;
          std::decay_t<decltype(s)>::fields([&](auto member, const FieldInfo&) {
            all &= s.*member == std::get<std::decay_t<decltype(s)>>(q.shape).*member;
          });
          return all;
        },
        p.shape);
    if (!equal) return false;
  }
  return true;
}

Stays CombinedShape::inside(const Vec3d& origin, const Vec3d& direction) const {
  Stays all = parts->list[0].inside(origin, direction);
  const double least = coincidence * parts->extent / length(direction);
  for (std::size_t i = 1; i < parts->list.size(); ++i) {
    if (all.empty() && parts->how != Combining::union_) break;
    const Stays next = parts->list[i].inside(origin, direction);
    if (parts->how == Combining::union_)
      all = in_either(all, next, least);
    else if (parts->how == Combining::intersection)
      all = in_both(all, next, least);
    else if (!next.empty())
      all = in_first_alone(all, next, least);
  }
  return all;
}

// Of the first part that has such an end there.
std::optional<ShapeHit> CombinedShape::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                           double t_max) const {
  double t = -1;
  bool enters = false;
  for (const Intervald& stay : inside(origin, direction)) {
    t = first_crossing(stay, t_min, t_max);
    enters = t == stay.lo;
    if (t >= 0) break;
  }
  if (t < 0) return std::nullopt;
  for (std::size_t i = 0; i < parts->list.size(); ++i) {
    const CombinedPart& part = parts->list[i];
    const bool enters_part = enters != parts->takes_away(i);
    for (const Intervald& stay : part.inside(origin, direction)) {
      if ((enters_part ? stay.lo : stay.hi) != t) continue;
      ShapeHit hit = part.hit_at(origin, direction, t);
      if (parts->takes_away(i)) {
        hit.normal = -hit.normal;
        hit.shading_normal = -hit.shading_normal;
      }
      return hit;
    }
  }
  CHECK(false);
  return std::nullopt;
}

double CombinedShape::depth(const Vec3d& p) const {
  double all = parts->list[0].depth(p);
  for (std::size_t i = 1; i < parts->list.size(); ++i) {
    const double next = parts->list[i].depth(p);
    if (parts->how == Combining::union_)
      all = std::max(all, next);
    else
      all = std::min(all, parts->takes_away(i) ? -next : next);
  }
  return all;
}

Bounds CombinedShape::bounds() const { return parts->bounds; }
Ball CombinedShape::ball() const {
  const Bounds b = parts->bounds;
  return {(b.lo + b.hi) * 0.5, length(b.hi - b.lo) / 2};
}

}  // namespace tyndall::shapes
