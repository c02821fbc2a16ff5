// Rays against tubes along splines, in double and in the curves' space. A strand is cut into straight pieces
// of cones, as many as its bends ask for; each piece ends at the planes that halve its bends, so that a line
// through a strand meets one surface where it enters and none twice. Ends are round. Only what is met from
// outside is met: light that is let through a hair meets it once.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/bounds_tree.h"
#include "compile/shape_queries.h"

namespace tyndall::compile {

class CompiledCurves {
 public:
  // All strands of these sets, in their order; none: what is never met.
  explicit CompiledCurves(std::span<const scene::StrandSet* const> sets);

  // The nearest entry in (after, t_max). uv: the strand's place in its set, and the part of its points from
  // root to tip, each in [0, 1].
  std::optional<ShapeHit> intersect(const Vec3d& origin, const Vec3d& direction, double t_max,
                                    const After& after = {}) const;
  const Bounds& bounds() const { return bounds_; }
  std::size_t pieces() const { return pieces_.size(); }

 private:
  struct Node {
    Vec3d position;
    double radius = 0;
    float along = 0;  // part of its strand's points, 0 at the root
    std::uint32_t strand = 0;
  };
  struct Entry {
    double t = 0;
    Vec3d position, normal, shading_normal;  // normals of any length but zero
    float along = 0;
  };
  void add_strand(const scene::StrandSet& strands, std::uint32_t strand_of_set);
  // Which way the plane between two pieces faces at a node: the mean of their directions.
  Vec3d joint(std::size_t node) const;
  bool begins(std::size_t node) const { return node == 0 || nodes_[node - 1].strand != nodes_[node].strand; }
  bool ends(std::size_t node) const {
    return node + 1 == nodes_.size() || nodes_[node + 1].strand != nodes_[node].strand;
  }
  // The first entry of a piece, nodes i and i + 1, in (t_min, t_max).
  std::optional<Entry> enter(std::uint32_t i, const Vec3d& origin, const Vec3d& direction, double t_min,
                             double t_max) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> pieces_;  // the first node of each
  std::vector<double> place_in_set_;   // of each strand
  Bounds bounds_;
  std::optional<BoundsTree> tree_;
};

}  // namespace tyndall::compile
