// Product sampling of the distance to a light (transport §3, "Product"): a table of all that a march knows of
// the light scattered along it, exact at the ends of its cells and smooth between them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/interval.h"
#include "render/distance/distance_query.h"
#include "render/distance/distance_table.h"
#include "render/distance/equiangular.h"
#include "render/march/march.h"
#include "render/march/phase_mixture.h"

namespace tyndall::render {

// One ray and one pivot; reused, with its memory, for the next.
class ProductSampling {
 public:
  // `lit`: the parts of the march that scatter and that the light reaches, in order, each within one region.
  // `phase` is that of a typical segment, the transmittance towards the light a guess: the density stated is
  // exact all the same.
  void set(const March& march, const Rgb& throughput, const optics::Pivot& pivot,
           const std::vector<Intervald>& lit, const PhaseMixture& phase);

  const DistanceTable& table() const { return table_; }

 private:
  // A place on the ray, and what does not depend on the medium there: how much of the light that arrives is
  // scattered towards the ray's start, and how much of it arrives, but for the inverse square.
  struct Node {
    double t = 0, r = 0, arrives = 0;
  };
  // A part of a segment between two nodes, with sigma_s T there, in luminance of what the path carries.
  struct Part {
    Node a, b;
    double carried_a = 0, carried_b = 0;
    std::uint32_t segment = 0;

    double lo() const { return carried_a * a.arrives; }
    double hi() const { return carried_b * b.arrives; }
    // Per unit of s from a product per unit of the angle over D.
    double weight() const { return (b.t - a.t) / (a.r * b.r); }
    double mass() const { return 0.5 * (lo() + hi()) * weight(); }
  };
  Node node(double t) const;
  double carried(std::uint32_t segment, double t) const;
  double carried_at_start(std::uint32_t segment) const;
  double carried_at_end(std::uint32_t segment) const;
  // Cosine of the angle in which the pivot sees a part.
  double cosine(const Part& part) const;
  // In two where the pivot sees the same angle; false when it cannot be cut.
  bool halved(const Part& part, Part& first, Part& second) const;

  void lay(const Intervald& lit);
  void cut_wide(const Part& part, int level);
  void refine(const Part& part, int level);
  void fill_table();

  const March* march_ = nullptr;
  const PhaseMixture* phase_ = nullptr;
  Vec3d shares_;  // luminance of the throughput, by channel
  EquiangularLine line_;
  double faces_at_zero_ = 0, faces_per_metre_ = 0;  // r times the cosine at a flat light
  bool flat_ = false;
  double sigma_t_ = 0;  // towards the light, a mean [1/m]
  double mass_ = 0;     // of the parts, as far as is known
  std::vector<Part> coarse_, parts_;
  DistanceTable table_;
};

// As a strategy for direct light.
class ProductStrategy {
 public:
  static constexpr StrategyTraits traits{.aims_at_light = true, .uses_typical_phase = true};
  bool prepare(const DistanceQuery& query) {
    if (!query.typical_phase) return false;  // nothing scatters
    product_.set(query.march, query.throughput, *query.pivot, query.lit, *query.typical_phase);
    return product_.table().available();
  }
  MarchPlace sample(const March& march, float u) const {
    const DistanceTable::Drawn at = product_.table().sample(u);
    return {at.t, at.segment, march.transmittance_at(at.segment, at.t)};
  }
  double pdf(const MarchPlace& at) const { return product_.table().pdf(at.t); }
  double cdf(const MarchPlace& at) const { return product_.table().cdf(at.t); }

 private:
  ProductSampling product_;
};

}  // namespace tyndall::render
