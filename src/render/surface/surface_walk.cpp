#include "render/surface/surface_walk.h"

#include <algorithm>
#include <cmath>

#include "compile/geometry/nested_dielectrics.h"

namespace tyndall::render {

namespace {

using compile::Ray;
using compile::RayKind;
using compile::Solids;
using compile::SurfaceHit;

// What else is in the place of a hit is looked for as far as this many times the hit's own error: that of a
// large thing beside a small one may be so much greater.
constexpr double largest_ratio_of_errors = 0x1p24;

double cosine(const SurfaceHit& hit, const Ray& ray) { return std::abs(dot(hit.normal, ray.direction)); }

}  // namespace

bool SurfaceWalk::is_boundary(const SurfaceHit& hit) const {
  return hit.light == compile::no_index && !hit.sheet && world_.materials[hit.material].transmits;
}

bool SurfaceWalk::is_pane(const SurfaceHit& hit) const {
  return hit.light == compile::no_index && hit.sheet && world_.materials[hit.material].transmits;
}

bool SurfaceWalk::stops(const SurfaceHit& hit) const {
  return hit.light != compile::no_index || (world_.materials[hit.material].opaque && !is_boundary(hit));
}

std::optional<SurfaceHit> SurfaceWalk::next() {
  for (;;) {
    if (told_ < together_.size()) return together_[told_++];
    auto hit = world_.closest_hit(ray_, kind_, after_);
    if (!hit) return std::nullopt;
    after_ = {hit->t, hit->surface, hit->part};
    const bool alone = !world_.features.nested_glass || hit->light != compile::no_index ||
                       !(is_boundary(*hit) || is_pane(*hit) || stops(*hit));
    if (alone) return hit;
    gather(*hit);
    cross_together();
  }
}

// All that is in the place of `first`, as far as errors let places be told apart. What stops the ray stops it
// before the glass that it touches. A thin pane in a face of glass is part of the body.
void SurfaceWalk::gather(const SurfaceHit& first) {
  together_.assign(1, first);
  told_ = 0;
  // Along the normal, from `first`: the place ends where all of it is certainly behind.
  double before = first.offset_before, behind = first.offset_behind;
  const auto ends = [&](const SurfaceHit& hit) { return stops(hit) && !is_pane(hit); };
  bool stopped = ends(first);
  Ray near = ray_;
  near.t_max = std::min(near.t_max, first.t + largest_ratio_of_errors * first.offset_behind /
                                                  std::max(cosine(first, ray_), 1e-6));
  compile::HitOrder after = after_;
  while (const auto hit = world_.closest_hit(near, kind_, after)) {
    const double depth = (hit->t - first.t) * cosine(*hit, ray_);
    if (depth - hit->offset_before > behind) break;
    after = {hit->t, hit->surface, hit->part};
    before = std::max(before, hit->offset_before - depth);
    behind = std::max(behind, hit->offset_behind + depth);
    if (stopped) continue;  // what is behind it tells how far before it rays must start
    together_.push_back(*hit);
    stopped = ends(*hit);
  }
  const auto pane =
      std::find_if(together_.begin(), together_.end(), [&](const SurfaceHit& hit) { return is_pane(hit); });
  const bool in_a_face = !stopped && std::any_of(together_.begin(), together_.end(),
                                                 [&](const SurfaceHit& hit) { return is_boundary(hit); });
  if (in_a_face)
    std::erase_if(together_, [&](const SurfaceHit& hit) { return is_pane(hit); });
  else if (pane != together_.end())
    together_.erase(pane + 1, together_.end());
  if (!stops(together_.back())) after_ = after;
  for (SurfaceHit& hit : together_) {
    const double depth = (hit.t - first.t) * cosine(hit, ray_);
    hit.offset_before = before + depth;
    hit.offset_behind = behind - depth;
  }
}

// Leaves of the boundaries in one place the one that is there, at the end of what is in it: that of the
// higher of the two bodies before and behind them.
void SurfaceWalk::cross_together() {
  std::optional<SurfaceHit> boundary;
  if (!stops(together_.back())) {
    const SurfaceHit& first = together_.front();
    const Vec3d normal = dot(first.normal, ray_.direction) > 0 ? -first.normal : first.normal;
    const auto before = world_.solids->at(first.position + normal * first.offset_before, ray_.time, kind_);
    const auto behind = world_.solids->at(first.position - normal * first.offset_behind, ray_.time, kind_);
    // Bodies of one material are one body.
    if ((before || behind) && !(before && behind && before->material == behind->material)) {
      const bool enters = behind && (!before || before->rank < behind->rank);
      const Solids::Holder& higher = enters ? *behind : *before;
      const auto& lower = enters ? before : behind;
      for (const SurfaceHit& hit : together_) {
        const bool same = is_boundary(hit) && static_cast<std::int64_t>(hit.surface) == higher.rank.order;
        const bool fits = (dot(hit.normal, ray_.direction) < 0) == enters;  // not where meshes turn inwards
        if (same && (fits || !boundary)) boundary = hit;
      }
      if (boundary) boundary->outside_ior = lower ? lower->ior : 1;
    }
  }
  std::erase_if(together_, [&](const SurfaceHit& hit) { return is_boundary(hit); });
  if (!boundary) return;
  for (SurfaceHit& hit : together_) hit.t = std::min(hit.t, boundary->t);
  together_.push_back(*boundary);
}

}  // namespace tyndall::render
