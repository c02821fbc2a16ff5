// Rays against tubes along splines, in double and in the curves' space. A strand is cut into straight pieces
// of cones, as many as its bends ask for; each piece ends at the planes that halve its bends, so that a line
// through a strand meets one surface where it enters and none twice. Ends are round. Only what is met from
// outside is met: light that is let through a hair meets it once.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/geometry/bounds_tree.h"
#include "compile/geometry/shape_hit.h"

namespace tyndall::compile {

class CompiledCurves {
 public:
  // All strands of these sets, in their order; none: what is never met.
  // What deforms is alone.
  explicit CompiledCurves(std::span<const scene::StrandSet* const> sets);

  // The nearest entry in (after, t_max). uv: the strand's place in its set, and the part of its points from
  // root to tip, each in [0, 1].
  std::optional<ShapeHit> intersect(const Vec3d& origin, const Vec3d& direction, double t_max,
                                    const After& after = {}, double time = 0) const;
  // Over all the time that the shutter is open, or within fractions of it.
  const Bounds& bounds() const { return bounds_; }
  Bounds bounds_within(const Intervald& time) const;
  bool deforms() const { return !later_.empty(); }
  std::size_t pieces() const { return pieces_.size(); }

 private:
  struct Place {
    Vec3d position;
    double radius = 0;
  };
  struct Node : Place {
    float along = 0;  // part of its strand's points, 0 at the root
    std::uint32_t strand = 0;
  };
  // Between which poses a moment is.
  struct Moment {
    std::size_t before = 0;
    double part = 0;
  };
  Moment moment(double time) const;
  // A node at a moment; of what stands still, at any.
  Place place(std::size_t node, const Moment& now) const {
    if (later_.empty()) return nodes_[node];
    const Place &a = in_pose(node, now.before), &b = in_pose(node, now.before + 1);
    return {a.position * (1 - now.part) + b.position * now.part,
            a.radius * (1 - now.part) + b.radius * now.part};
  }
  const Place& in_pose(std::size_t node, std::size_t pose) const {
    return pose == 0 ? nodes_[node] : later_[pose - 1][node];
  }
  // Of the piece that begins at a node; between two poses each side goes evenly.
  Bounds box(std::uint32_t node, std::size_t pose) const;
  struct Entry {
    double t = 0;
    Vec3d position, normal, shading_normal;  // normals of any length but zero
    float along = 0;
  };
  void add_strand(const scene::StrandSet& strands, std::uint32_t strand_of_set);
  // Which way the plane between two pieces faces at a node: the mean of their directions.
  Vec3d joint(std::size_t node, const Moment& now) const;
  bool begins(std::size_t node) const { return node == 0 || nodes_[node - 1].strand != nodes_[node].strand; }
  bool ends(std::size_t node) const {
    return node + 1 == nodes_.size() || nodes_[node + 1].strand != nodes_[node].strand;
  }
  // The first entry of a piece, nodes i and i + 1, in (t_min, t_max).
  std::optional<Entry> enter(std::uint32_t i, const Vec3d& origin, const Vec3d& direction, double t_min,
                             double t_max, const Moment& now) const;

  std::vector<Node> nodes_;
  std::vector<std::vector<Place>> later_;  // the nodes in each pose after the first; none: they stand still
  std::vector<std::uint32_t> pieces_;      // the first node of each
  std::vector<double> place_in_set_;       // of each strand
  Bounds bounds_;
  std::optional<BoundsTree> tree_;
};

}  // namespace tyndall::compile
