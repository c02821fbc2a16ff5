#include "compile/geometry/curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "compile/geometry/hit_error.h"
#include "shapes/mesh_at.h"

namespace tyndall::compile {

namespace {

// The roots of a s² + 2 b s + c, which has this discriminant (a quarter of it), without cancellation;
// infinite where there are none.
std::array<double, 2> roots_of(double a, double b, double c, double discriminant) {
  std::array<double, 2> roots{infinity, infinity};
  if (!(discriminant >= 0)) return roots;
  const double root = std::sqrt(discriminant), q = -(b + std::copysign(root, b));
  if (a != 0) roots[0] = q / a;
  if (q != 0) roots[1] = c / q;
  return roots;
}

constexpr std::size_t few_pieces = 4;  // up to this many a plain loop is faster than a tree

// A piece lies no further from its spline than this share of the radius there, or of its span's length.
constexpr double share_of_radius = 0.05, share_of_span = 1e-3;
constexpr int most_pieces = 32;  // of one span

// Catmull and Rom's spline between p[1] and p[2].
struct Span {
  std::array<Vec3d, 4> p;

  Vec3d at(double u) const {
    const Vec3d a = p[1] * 2.0, b = p[2] - p[0], c = p[0] * 2.0 - p[1] * 5.0 + p[2] * 4.0 - p[3],
                d = (p[1] - p[2]) * 3.0 + p[3] - p[0];
    return (a + (b + (c + d * u) * u) * u) * 0.5;
  }
  // The largest second derivative, across the chord: at one of its ends.
  double bend() const {
    const Vec3d begin = p[0] * 2.0 - p[1] * 5.0 + p[2] * 4.0 - p[3],
                end = begin + ((p[1] - p[2]) * 3.0 + p[3] - p[0]) * 3.0, chord = p[2] - p[1];
    const auto across = [&](const Vec3d& v) {
      const double square = length_squared(chord);
      return square > 0 ? length(v - chord * (dot(v, chord) / square)) : length(v);
    };
    return std::max(across(begin), across(end));
  }
};

// The strand's points and radii in one pose.
struct Strand {
  std::span<const Vec3d> points;
  std::span<const double> radii;

  // Beyond its ends a strand goes on straight.
  Vec3d point(std::ptrdiff_t i) const {
    const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
    const auto at = [&](std::ptrdiff_t k) { return points[static_cast<std::size_t>(k)]; };
    return i < 0 ? at(0) * 2.0 - at(1) : i > last ? at(last) * 2.0 - at(last - 1) : at(i);
  }
  // From point i to the next.
  Span span(std::size_t i) const {
    const auto k = static_cast<std::ptrdiff_t>(i);
    return {{point(k - 1), point(k), point(k + 1), point(k + 2)}};
  }
  int pieces(std::size_t i) const {
    const Span along = span(i);
    const double allowed = std::max(share_of_radius * 0.5 * (radii[i] + radii[i + 1]),
                                    share_of_span * length(along.p[2] - along.p[1]));
    // A chord of 1/n of a span lies within bend/(8 n²) of it.
    const double wanted = allowed > 0 ? std::sqrt(along.bend() / (8 * allowed)) : 1;
    // Points too far apart for numbers have no wanted: one piece.
    return wanted >= most_pieces ? most_pieces : wanted > 1 ? static_cast<int>(std::ceil(wanted)) : 1;
  }
};

// The strand in each pose of its set.
std::vector<Strand> in_poses(const scene::StrandSet& set, std::size_t strand) {
  const std::size_t begin = set.begin[strand], count = set.begin[strand + 1] - begin;
  const auto part = [&](const auto& of) {
    return Strand{std::span(of.points).subspan(begin, count), std::span(of.radii).subspan(begin, count)};
  };
  std::vector<Strand> out{part(set)};
  for (const scene::StrandPose& pose : set.later) out.push_back(part(pose));
  return out;
}

Vec3d direction_to(const Vec3d& v) { return length_squared(v) > 0 ? normalize(v) : Vec3d(); }

}  // namespace

CompiledCurves::CompiledCurves(std::span<const scene::StrandSet* const> sets)
    : bounds_{Vec3d(infinity), Vec3d(-infinity)} {
  for (const scene::StrandSet* set : sets) {
    CHECK(set->later.empty() || sets.size() == 1);
    later_.resize(set->later.size());
    for (std::uint32_t s = 0; s < set->strands(); ++s) {
      add_strand(*set, s);
      place_in_set_.push_back((s + 0.5) / static_cast<double>(set->strands()));
    }
  }
  for (std::uint32_t i = 0; i + 1 < nodes_.size(); ++i)
    if (!ends(i)) pieces_.push_back(i);
  bounds_ = bounds_within({0, 1});
  const auto moments = static_cast<std::uint32_t>(later_.size() + 1);
  if (pieces_.size() > few_pieces)
    tree_.emplace(static_cast<std::uint32_t>(pieces_.size()), moments,
                  [&](std::uint32_t i, std::uint32_t moment) { return box(pieces_[i], moment); });
}

Bounds CompiledCurves::box(std::uint32_t node, std::size_t pose) const {
  const Place &a = in_pose(node, pose), &b = in_pose(node + 1, pose);
  // A slanted cut reaches further from its middle than the radius; beyond half a right angle it is met by
  // chance only. Between two poses it may slant more than in either.
  constexpr double most_slanted = 0.7;
  double slant = most_slanted;
  if (later_.empty()) {
    const Vec3d along = normalize(b.position - a.position);
    slant = std::max(std::min(dot(joint(node, {}), along), dot(joint(node + 1, {}), along)), most_slanted);
  }
  const double room_a = a.radius / slant, room_b = b.radius / slant,
               room = later_.empty() ? std::max(room_a, room_b) : 0;
  Bounds out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.lo[axis] =
        std::min(a.position[axis] - std::max(room, room_a), b.position[axis] - std::max(room, room_b));
    out.hi[axis] =
        std::max(a.position[axis] + std::max(room, room_a), b.position[axis] + std::max(room, room_b));
  }
  return out;
}

Bounds CompiledCurves::bounds_within(const Intervald& time) const {
  Bounds out{Vec3d(infinity), Vec3d(-infinity)};
  const auto [first, last] = shapes::poses_within(time, later_.size());
  for (const std::uint32_t i : pieces_)
    for (std::size_t pose = first; pose <= last; ++pose) {
      const Bounds own = box(i, pose);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        out.lo[axis] = std::min(out.lo[axis], own.lo[axis]);
        out.hi[axis] = std::max(out.hi[axis], own.hi[axis]);
      }
    }
  return out;
}

void CompiledCurves::add_strand(const scene::StrandSet& strands, std::uint32_t strand_of_set) {
  const std::vector<Strand> poses = in_poses(strands, strand_of_set);
  const std::size_t count = poses[0].points.size();
  const auto strand = static_cast<std::uint32_t>(place_in_set_.size());
  for (std::size_t i = 0; i + 1 < count; ++i) {
    int pieces = 1;
    for (const Strand& pose : poses) pieces = std::max(pieces, pose.pieces(i));
    for (int n = i == 0 ? 0 : 1; n <= pieces; ++n) {
      const double u = static_cast<double>(n) / pieces;
      const auto place = [&](const Strand& pose) {
        const Span span = pose.span(i);
        // The given points themselves, to the last bit.
        return Place{n == 0        ? span.p[1]
                     : n == pieces ? span.p[2]
                                   : span.at(u),
                     pose.radii[i] + u * (pose.radii[i + 1] - pose.radii[i])};
      };
      const Place first = place(poses[0]);
      // Points at one place are one, where they do not part later.
      if (later_.empty() && !nodes_.empty() && nodes_.back().strand == strand &&
          nodes_.back().position == first.position)
        continue;
      nodes_.push_back(
          {first, static_cast<float>((static_cast<double>(i) + u) / static_cast<double>(count - 1)), strand});
      for (std::size_t k = 0; k < later_.size(); ++k) later_[k].push_back(place(poses[k + 1]));
    }
  }
}

CompiledCurves::Moment CompiledCurves::moment(double time) const {
  if (later_.empty()) return {};
  // In float, as Embree finds the boxes for a time.
  const float scaled = static_cast<float>(time) * static_cast<float>(later_.size());
  const auto last = static_cast<std::int64_t>(later_.size()) - 1;
  const std::int64_t before = std::clamp(static_cast<std::int64_t>(scaled), std::int64_t{0}, last);
  return {static_cast<std::size_t>(before),
          std::clamp(static_cast<double>(scaled - static_cast<float>(before)), 0.0, 1.0)};
}

Vec3d CompiledCurves::joint(std::size_t node, const Moment& now) const {
  const Vec3d here = place(node, now).position;
  const Vec3d before = begins(node) ? Vec3d() : direction_to(here - place(node - 1, now).position);
  const Vec3d after = ends(node) ? Vec3d() : direction_to(place(node + 1, now).position - here);
  const Vec3d mean = before + after;
  // A strand that turns straight back has no plane that halves the bend: its piece ends squarely.
  return length_squared(mean) > 1e-12 ? normalize(mean) : before;
}

std::optional<CompiledCurves::Entry> CompiledCurves::enter(std::uint32_t i, const Vec3d& origin,
                                                           const Vec3d& direction, double t_min, double t_max,
                                                           const Moment& now) const {
  const Place a = place(i, now), b = place(i + 1, now);
  if (!later_.empty() && a.position == b.position) return std::nullopt;
  const Vec3d axis = b.position - a.position;
  const double length_of_axis = length(axis), speed = length(direction);
  const Vec3d along = axis / length_of_axis, w = direction / speed;
  // From the ray's point nearest the piece's middle: small numbers whatever the distance.
  const Vec3d middle = (a.position + b.position) * 0.5;
  const double shift = dot(middle - origin, w);
  const Vec3d o = origin + w * shift - a.position;
  const double least = t_min * speed - shift, most = t_max * speed - shift;
  const float root = nodes_[i].along, tip = nodes_[i + 1].along;
  std::optional<Entry> best;
  const auto offer = [&](double s, const Vec3d& q, const Vec3d& normal, const Vec3d& smooth, double part) {
    if (!(s > least && s < most) || (best && s >= best->t) || !(dot(normal, w) < 0)) return;
    best = Entry{s, a.position + q, normal, smooth, root + static_cast<float>(part) * (tip - root)};
  };

  // The cone |q - h along| = a.radius + taper h, with h = dot(q, along).
  const double taper = (b.radius - a.radius) / length_of_axis;
  const double wh = dot(w, along), oh = dot(o, along);
  const Vec3d w_across = w - along * wh, o_across = o - along * oh;
  const double radius_at_o = a.radius + taper * oh;
  const double qa = length_squared(w_across) - sqr(taper * wh),
               qb = dot(w_across, o_across) - radius_at_o * taper * wh,
               qc = length_squared(o_across) - sqr(radius_at_o);
  const double discriminant = qb * qb - qa * qc;
  if (!(discriminant >= 0) && !begins(i) && !ends(i + 1))
    return std::nullopt;  // most pieces whose boxes are met
  const Vec3d joint_a = joint(i, now), joint_b = joint(i + 1, now);
  for (const double s : roots_of(qa, qb, qc, discriminant)) {
    if (!std::isfinite(s)) continue;
    const Vec3d q = o + w * s;
    const double h = dot(q, along), radius = a.radius + taper * h;
    if (!(radius > 0)) continue;  // the cone beyond its tip
    // Of two pieces that meet at a plane the later one has it.
    if (!(dot(q, joint_a) >= 0) || !(dot(q - axis, joint_b) < 0)) continue;
    const double part = std::clamp(h / length_of_axis, 0.0, 1.0);
    const Vec3d across = q - along * h;
    const Vec3d tangent = normalize(joint_a * (1 - part) + joint_b * part);
    offer(s, q, across - along * (taper * radius), across - tangent * dot(across, tangent), part);
  }
  // Round ends.
  const auto end = [&](const Vec3d& center, double radius, double outward, double part) {
    const Vec3d from = o - center;
    const double b_half = dot(from, w), c = length_squared(from) - sqr(radius), d = b_half * b_half - c;
    if (!(d >= 0) || radius == 0) return;
    const double s = -b_half - std::sqrt(d);
    const Vec3d q = o + w * s, normal = q - center;
    if (dot(normal, along) * outward >= 0) offer(s, q, normal, normal, part);
  };
  if (begins(i)) end({}, a.radius, -1, 0);
  if (ends(i + 1)) end(axis, b.radius, 1, 1);
  if (best) best->t = (best->t + shift) / speed;
  return best;
}

std::optional<ShapeHit> CompiledCurves::intersect(const Vec3d& origin, const Vec3d& direction, double t_max,
                                                  const After& after, double time) const {
  const Moment now = moment(time);
  std::optional<Entry> best;
  std::uint32_t best_piece = 0;
  const auto test = [&](std::uint32_t piece) {
    const double limit = best ? std::nextafter(t_max, infinity) : t_max;
    // What is met at `after` itself is looked at too: it may be of a later piece.
    const auto entry =
        enter(pieces_[piece], origin, direction, std::nextafter(after.t, -infinity), limit, now);
    if (entry && after.before(entry->t, piece) &&
        (entry->t < t_max || (best && entry->t == t_max && piece < best_piece))) {
      best = entry;
      best_piece = piece;
      t_max = entry->t;
    }
    // Equal ones must still be met, so that the first piece wins.
    return best ? std::nextafter(t_max, infinity) : t_max;
  };
  if (tree_) {
    tree_->visit(origin, direction, after.t, t_max, test, time);
  } else {
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) test(i);
  }
  if (!best) return std::nullopt;
  const std::uint32_t node = pieces_[best_piece];
  const Place from = place(node, now), to = place(node + 1, now);
  return ShapeHit{best->t,
                  best->position,
                  best->normal,
                  {place_in_set_[nodes_[node].strand], static_cast<double>(best->along)},
                  shapes::rod_reach(from.position, to.position, std::max(from.radius, to.radius)),
                  best->shading_normal,
                  best_piece};
}

}  // namespace tyndall::compile
