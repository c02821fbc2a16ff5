#include "render/lights/ray_pieces.h"

#include <algorithm>

#include "base/numerics.h"

namespace tyndall::render {

namespace {

// Pieces are lit with at least this share of what all of them are lit with in the mean, so that no rough
// guess makes a sample too heavy.
constexpr double least_lit = 0.1;

}  // namespace

void RayPieces::divide(const compile::CompiledScene& world, const LearnedLights& learned, const March& march,
                       const DensityDistribution& density) {
  pieces_.clear();
  if (!march.scatters() || !density.available()) return;
  const Intervald all{march.scattering_intervals.front().lo, march.scattering_intervals.back().hi};
  double mass_before = 0, lit = 0;
  // `before` holds the mass, `probability` what lights it, until both are known of all.
  learned.walk(march.ray, all, [&](const LightRegion* region, const Intervald& t) {
    const double mass_after = t.hi < all.hi ? density.cdf(march.place_at(t.hi)) : 1;
    const double mass = mass_after - mass_before;
    mass_before = std::max(mass_before, mass_after);
    if (!(mass > 0)) return;
    const double light = LightSelection(world, march.ray, t.lo, t.hi, region).total();
    pieces_.push_back({t, region, mass, light});
    lit += mass * light;
  });
  double sum = 0;
  for (RayPiece& piece : pieces_) {
    piece.probability = piece.probability > 0 ? piece.before * (piece.probability + least_lit * lit) : 0;
    piece.before = sum;
    sum += piece.probability;
  }
  std::erase_if(pieces_, [](const RayPiece& piece) { return !(piece.probability > 0); });
  for (RayPiece& piece : pieces_) piece.before /= sum, piece.probability /= sum;
}

const RayPiece& RayPieces::choose(float& u) const {
  auto piece = std::upper_bound(pieces_.begin(), pieces_.end(), double{u},
                                [](double x, const RayPiece& p) { return x < p.before; });
  --piece;
  u = std::min(static_cast<float>((u - piece->before) / piece->probability), one_minus_ulp_f);
  return *piece;
}

const RayPiece* RayPieces::at(double t) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                      [](double x, const RayPiece& p) { return x < p.t.lo; });
  if (after == pieces_.begin() || t > (after - 1)->t.hi) return nullptr;
  return &*(after - 1);
}

}  // namespace tyndall::render
