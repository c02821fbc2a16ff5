#include "compile/majorant/occupancy_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compile/majorant/occupancy_walk.cpp"
#include "hwy/foreach_target.h"
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::compile::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::ScalableTag<float>;
constexpr std::size_t widest_vector = 16;
static_assert(hn::MaxLanes(Lanes()) <= widest_vector);
using IntegerLanes = hn::RebindToSigned<Lanes>;
using Floats = hn::Vec<Lanes>;
using Integers = hn::Vec<IntegerLanes>;

// Sums are not fused: every SIMD class, and every axis that asks for the same plane, gets the same float.
HWY_INLINE HWY_ATTR Floats plane_at(const WalkAxis& axis, Floats k) {
  const Lanes d;
  return hn::Add(hn::Mul(k, hn::Set(d, axis.apart)), hn::Set(d, axis.first));
}

// How many planes of an axis are crossed before t; `first` when those at t are, too.
HWY_INLINE HWY_ATTR Floats crossed_before(const WalkAxis& axis, Floats t, bool first) {
  const Lanes d;
  const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f), all = hn::Set(d, static_cast<float>(axis.planes));
  const auto comes_first = [&](Floats plane) HWY_ATTR { return first ? hn::Le(plane, t) : hn::Lt(plane, t); };
  const Floats place = hn::Mul(hn::Sub(t, hn::Set(d, axis.first)), hn::Set(d, axis.per_metre));
  // NaN is on the left of Max and Min, which then give what is on the right.
  Floats count = hn::Min(hn::Max(hn::Add(hn::Floor(place), one), zero), all);
  // Right but for rounding: at most one too many or too few.
  const auto too_many = hn::AndNot(comes_first(plane_at(axis, hn::Sub(count, one))), hn::Gt(count, zero));
  const auto too_few = hn::And(comes_first(plane_at(axis, count)), hn::Lt(count, all));
  count = hn::IfThenElse(too_many, hn::Sub(count, one), count);
  return hn::IfThenElse(hn::AndNot(too_many, too_few), hn::Add(count, one), count);
}

// Finds where a group is entered, of [0, length), whose kind is not that of the one before, or says too
// little: in order for each axis, z, y and x one behind the other. Planes that lie in one place are crossed
// in this order. The arrays have room for all planes and one more. Gives where each axis' changes end.
std::array<std::size_t, 3> find_changes(const std::array<WalkAxis, 3>& axes, std::int32_t start, float length,
                                        const MajorantGrid::Kinds& kinds, float* times,
                                        std::int32_t* groups) {
  const Lanes d;
  const IntegerLanes di;
  constexpr auto uniform = static_cast<std::uint8_t>(CellKind::uniform);
  alignas(64) float t_lanes[widest_vector];
  alignas(64) std::int32_t group_lanes[widest_vector];
  std::array<std::size_t, 3> ends;
  std::size_t found = 0;
  for (std::size_t a = 3; a-- > 0;) {
    const WalkAxis& axis = axes[a];
    const Floats end = hn::Set(d, length), planes = hn::Set(d, static_cast<float>(axis.planes));
    for (std::int32_t k0 = 0; k0 < axis.planes; k0 += static_cast<std::int32_t>(hn::Lanes(d))) {
      const Floats k = hn::Iota(d, static_cast<float>(k0)), t = plane_at(axis, k);
      const auto there = hn::And(hn::Lt(t, end), hn::Lt(k, planes));
      if (hn::AllFalse(d, there)) break;
      Integers group = hn::Add(hn::Set(di, start), hn::Mul(hn::Add(hn::ConvertTo(di, k), hn::Set(di, 1)),
                                                           hn::Set(di, axis.stride)));
      for (std::size_t b = 0; b < 3; ++b) {
        if (b == a) continue;
        const Integers count = hn::ConvertTo(di, crossed_before(axes[b], t, b > a));
        group = hn::Add(group, hn::Mul(count, hn::Set(di, axes[b].stride)));
      }
      hn::Store(t, d, t_lanes);
      hn::Store(group, di, group_lanes);
      // One by one: gathering is no faster. Every crossing is written, and the next one over it unless it is
      // a change.
      const std::size_t count = hn::CountTrue(d, there);
      for (std::size_t i = 0; i < count; ++i) {
        const auto group_at = static_cast<std::size_t>(group_lanes[i]);
        const std::uint8_t kind = kinds.known(group_at),
                           before = kinds.known(group_at - static_cast<std::size_t>(axis.stride));
        times[found] = t_lanes[i];
        groups[found] = group_lanes[i];
        found += (kind != before) | (kind == uniform) | (kind == MajorantGrid::unknown);
      }
    }
    ends[2 - a] = found;
  }
  return ends;
}

}  // namespace tyndall::compile::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::compile {

namespace {

HWY_EXPORT(find_changes);

// At most so many groups are crossed along an axis in one go: places are floats, and off by no more than 1e-7
// of the way, which is less than what cells are larger than they seem (majorant_grid.cpp).
constexpr double longest_piece = 256;

}  // namespace

std::span<const OccupancySegment> OccupancyWalk::along(const MajorantGrid& grid,
                                                       const Transform& medium_from_render, const Ray& ray,
                                                       double t0, double t1, double step,
                                                       BoundsScratch& scratch) {
  segments_.clear();
  if (!(t0 < t1)) return segments_;
  const Vec3d o = medium_from_render.point(ray.origin) - grid.domain().box.lo,
              d = medium_from_render.vector(ray.direction), size = grid.cell_size();
  // A box without extent along an axis is one layer of cells.
  Vec3d origin(0.5), speed(0);  // in cells, then in groups
  for (std::size_t i = 0; i < 3; ++i)
    if (size[i] > 0) origin[i] = o[i] / size[i], speed[i] = d[i] / size[i];
  const auto fastest = [&] { return std::max({std::abs(speed.x), std::abs(speed.y), std::abs(speed.z)}); };
  int level = 0;
  while (level + 1 < MajorantGrid::levels && step * fastest() >= 2 << level) ++level;
  origin *= 1.0 / (1 << level);
  speed *= 1.0 / (1 << level);

  const MajorantGrid::Kinds kinds = grid.kinds(level);
  OccupancySegment open{t0, t1, CellKind::varying};
  std::size_t begin = 0;  // its first group
  bool is_open = false;
  const auto enter = [&](double t, std::size_t group) {
    const CellKind kind = kinds.at(group, scratch);
    if (is_open && kind == open.kind &&
        (kind != CellKind::uniform || grid.same_values(level, begin, group, scratch)))
      return;
    if (t > open.t0) {
      segments_.push_back({open.t0, t, open.kind});
      open.t0 = t;
    }
    open.kind = kind;
    begin = group;
    is_open = true;
  };
  const double pieces = std::max(1.0, std::ceil((t1 - t0) * fastest() / longest_piece));
  for (double piece = 0; piece < pieces; ++piece) {
    const double from = t0 + (t1 - t0) * (piece / pieces),
                 to = piece + 1 < pieces ? t0 + (t1 - t0) * ((piece + 1) / pieces) : t1;
    const std::int32_t start = aim(grid.groups(level), origin + speed * from, speed, to - from);
    const std::array<std::size_t, 3> ends = HWY_DYNAMIC_DISPATCH(find_changes)(
        axes_, start, static_cast<float>(to - from), kinds, times_.data(), groups_.data());
    enter(from, static_cast<std::size_t>(start));
    std::array<std::size_t, 3> next = {0, ends[0], ends[1]};
    for (std::size_t k = 0; k < ends[2]; ++k) {
      std::size_t first = 3;  // of the axes, the one whose change comes first
      for (std::size_t a = 0; a < 3; ++a)
        if (next[a] < ends[a] && (first == 3 || times_[next[a]] < times_[next[first]])) first = a;
      const std::size_t i = next[first]++;
      enter(std::min(from + double{times_[i]}, to), static_cast<std::size_t>(groups_[i]));
    }
  }
  if (open.t0 < t1) segments_.push_back(open);
  return segments_;
}

std::int32_t OccupancyWalk::aim(const std::array<std::uint32_t, 3>& groups, const Vec3d& from,
                                const Vec3d& speed, double length) {
  std::int32_t start = 0, stride = 1;
  std::size_t room = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto count = static_cast<std::int32_t>(groups[i]);
    const double place = std::floor(from[i]), rate = std::abs(speed[i]);
    const std::int32_t at = place > 0 ? static_cast<std::int32_t>(std::min(place, count - 1.0)) : 0;
    WalkAxis& axis = axes_[i] = {};
    if (rate > 0) {
      const bool up = speed[i] > 0;
      const double first = ((up ? at + 1 : at) - from[i]) / speed[i];
      // Those that lie in the stay, and one for rounding.
      const double within = std::max((length - first) * rate, 0.0) + 2;
      axis.planes = static_cast<std::int32_t>(std::min<double>(up ? count - 1 - at : at, within));
      axis.first = static_cast<float>(first);
      axis.apart = static_cast<float>(1 / rate);
      axis.per_metre = static_cast<float>(rate);
      axis.stride = up ? stride : -stride;
    }
    room += static_cast<std::size_t>(axis.planes);
    start += at * stride;
    stride *= count;
  }
  if (times_.size() < room) times_.resize(room), groups_.resize(room);
  return start;
}

}  // namespace tyndall::compile
#endif
