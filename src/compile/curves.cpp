#include "compile/curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numerics.h"
#include "compile/hit_error.h"

namespace tyndall::compile {

namespace {

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

Bounds around(const Vec3d& a, double radius_a, const Vec3d& b, double radius_b) {
  Bounds box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::min(a[axis] - radius_a, b[axis] - radius_b);
    box.hi[axis] = std::max(a[axis] + radius_a, b[axis] + radius_b);
  }
  return box;
}

}  // namespace

CompiledCurves::CompiledCurves(std::span<const scene::StrandSet* const> sets)
    : bounds_{Vec3d(infinity), Vec3d(-infinity)} {
  for (const scene::StrandSet* set : sets)
    for (std::uint32_t s = 0; s < set->strands(); ++s) {
      add_strand(*set, s);
      place_in_set_.push_back((s + 0.5) / static_cast<double>(set->strands()));
    }
  std::vector<Bounds> boxes;
  for (std::uint32_t i = 0; i + 1 < nodes_.size(); ++i) {
    if (ends(i)) continue;
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    pieces_.push_back(i);
    // A slanted cut reaches further from its middle than the radius; beyond half a right angle it is met by
    // chance only.
    const Vec3d along = normalize(b.position - a.position);
    const double slant = std::max(std::min(dot(joint(i), along), dot(joint(i + 1), along)), 0.7);
    const double larger = std::max(a.radius, b.radius) / slant;
    boxes.push_back(around(a.position, larger, b.position, larger));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds_.lo[axis] = std::min(bounds_.lo[axis], boxes.back().lo[axis]);
      bounds_.hi[axis] = std::max(bounds_.hi[axis], boxes.back().hi[axis]);
    }
  }
  if (boxes.size() > few_pieces) tree_.emplace(boxes);
}

void CompiledCurves::add_strand(const scene::StrandSet& strands, std::uint32_t strand_of_set) {
  const std::size_t begin = strands.begin[strand_of_set], count = strands.begin[strand_of_set + 1] - begin;
  const auto strand = static_cast<std::uint32_t>(place_in_set_.size());
  // Beyond its ends a strand goes on straight.
  const auto point = [&](std::ptrdiff_t i) {
    const auto last = static_cast<std::ptrdiff_t>(count) - 1;
    const auto at = [&](std::ptrdiff_t k) { return strands.points[begin + static_cast<std::size_t>(k)]; };
    return i < 0 ? at(0) * 2.0 - at(1) : i > last ? at(last) * 2.0 - at(last - 1) : at(i);
  };
  const auto add = [&](const Vec3d& position, double radius, double along) {
    // Points at one place are one.
    if (!nodes_.empty() && nodes_.back().strand == strand && nodes_.back().position == position) return;
    nodes_.push_back({position, radius, static_cast<float>(along), strand});
  };
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const auto k = static_cast<std::ptrdiff_t>(i);
    const Span span{{point(k - 1), point(k), point(k + 1), point(k + 2)}};
    const double r0 = strands.radii[begin + i], r1 = strands.radii[begin + i + 1];
    const double allowed =
        std::max(share_of_radius * 0.5 * (r0 + r1), share_of_span * length(span.p[2] - span.p[1]));
    // A chord of 1/n of a span lies within bend/(8 n²) of it.
    const double wanted = allowed > 0 ? std::sqrt(span.bend() / (8 * allowed)) : 1;
    // Points too far apart for numbers have no wanted: one piece.
    const int pieces = wanted >= most_pieces ? most_pieces
                       : wanted > 1          ? static_cast<int>(std::ceil(wanted))
                                             : 1;
    for (int n = i == 0 ? 0 : 1; n <= pieces; ++n) {
      const double u = static_cast<double>(n) / pieces;
      // The given points themselves, to the last bit.
      const Vec3d position = n == 0 ? span.p[1] : n == pieces ? span.p[2] : span.at(u);
      add(position, r0 + u * (r1 - r0), (static_cast<double>(i) + u) / static_cast<double>(count - 1));
    }
  }
}

Vec3d CompiledCurves::joint(std::size_t node) const {
  const Vec3d before = begins(node) ? Vec3d() : normalize(nodes_[node].position - nodes_[node - 1].position);
  const Vec3d after = ends(node) ? Vec3d() : normalize(nodes_[node + 1].position - nodes_[node].position);
  const Vec3d mean = before + after;
  // A strand that turns straight back has no plane that halves the bend: its piece ends squarely.
  return length_squared(mean) > 1e-12 ? normalize(mean) : before;
}

std::optional<CompiledCurves::Entry> CompiledCurves::enter(std::uint32_t i, const Vec3d& origin,
                                                           const Vec3d& direction, double t_min,
                                                           double t_max) const {
  const Node &a = nodes_[i], &b = nodes_[i + 1];
  const Vec3d axis = b.position - a.position;
  const double length_of_axis = length(axis), speed = length(direction);
  const Vec3d along = axis / length_of_axis, w = direction / speed;
  // From the ray's point nearest the piece's middle: small numbers whatever the distance.
  const Vec3d middle = (a.position + b.position) * 0.5;
  const double shift = dot(middle - origin, w);
  const Vec3d o = origin + w * shift - a.position;
  const double least = t_min * speed - shift, most = t_max * speed - shift;
  std::optional<Entry> best;
  const auto offer = [&](double s, const Vec3d& q, const Vec3d& normal, const Vec3d& smooth, double part) {
    if (!(s > least && s < most) || (best && s >= best->t) || !(dot(normal, w) < 0)) return;
    best = Entry{s, a.position + q, normal, smooth, a.along + static_cast<float>(part) * (b.along - a.along)};
  };

  // The cone |q - h along| = a.radius + taper h, with h = dot(q, along).
  const double taper = (b.radius - a.radius) / length_of_axis;
  const double wh = dot(w, along), oh = dot(o, along);
  const Vec3d w_across = w - along * wh, o_across = o - along * oh;
  const double radius_at_o = a.radius + taper * oh;
  const double qa = length_squared(w_across) - sqr(taper * wh),
               qb = dot(w_across, o_across) - radius_at_o * taper * wh,
               qc = length_squared(o_across) - sqr(radius_at_o);
  std::array<double, 2> roots{infinity, infinity};
  const double discriminant = qb * qb - qa * qc;
  if (discriminant >= 0) {
    const double root = std::sqrt(discriminant), q = -(qb + std::copysign(root, qb));
    if (qa != 0) roots[0] = q / qa;
    if (q != 0) roots[1] = qc / q;
  } else if (!begins(i) && !ends(i + 1)) {
    return std::nullopt;  // most pieces whose boxes are met
  }
  const Vec3d joint_a = joint(i), joint_b = joint(i + 1);
  for (const double s : roots) {
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
                                                  const After& after) const {
  std::optional<Entry> best;
  std::uint32_t best_piece = 0;
  const auto test = [&](std::uint32_t piece) {
    const double limit = best ? std::nextafter(t_max, infinity) : t_max;
    // What is met at `after` itself is looked at too: it may be of a later piece.
    const auto entry = enter(pieces_[piece], origin, direction, std::nextafter(after.t, -infinity), limit);
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
    tree_->visit(origin, direction, after.t, t_max, test);
  } else {
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) test(i);
  }
  if (!best) return std::nullopt;
  const Node &node = nodes_[pieces_[best_piece]], &next = nodes_[pieces_[best_piece] + 1];
  return ShapeHit{best->t,
                  best->position,
                  best->normal,
                  {place_in_set_[node.strand], static_cast<double>(best->along)},
                  rod_reach(node.position, next.position, std::max(node.radius, next.radius)),
                  best->shading_normal,
                  best_piece};
}

}  // namespace tyndall::compile
