#include "render/path/cut_light_meter.h"

#include <cmath>

namespace tyndall::render {

CutLightMeter::CutLightMeter(const PathSettings& settings, std::span<const Rgb> radiance)
    : settings_(settings),
      radiance_(radiance),
      late_(first_late_bounce(settings.bounces)),
      rays_after_bounces_(settings.gathers_after_last ? 1 : 0) {}

void CutLightMeter::note_ray(const PathSlot& path) {
  if (path.state.depth != late_) return;
  if (early_.empty()) early_.resize(radiance_.size());
  early_[path.sample] = radiance_[path.sample];
}

void CutLightMeter::note_gathered(const PathSlot& path, const Rgb& radiance_before) {
  if (path.state.depth == late_) *early_[path.sample] += radiance_[path.sample] - radiance_before;
}

void CutLightMeter::note_carried(const PathSlot& path, const HitSurfaces& surfaces, Statistics& statistics) {
  const PathState& s = path.state;
  const std::uint32_t bounce = s.depth + 1 - rays_after_bounces_;
  const bool starts = bounce == late_, ends = bounce == static_cast<std::uint32_t>(settings_.bounces) + 1;
  if (!starts && !ends) return;
  Rgb carried = surfaces.scattered();
  if (s.media_scatterings < settings_.real_scatterings)
    carried += s.throughput * path.march().total_scattered();
  if (starts) sums_.from += Vec3d(carried);
  if (!ends) return;
  sums_.cut += Vec3d(carried);
  statistics.cut_paths += !is_black(carried);
  statistics.cut_throughput += max_component(carried);
}

void CutLightMeter::finish(Statistics& statistics) {
  for (std::size_t i = 0; i < early_.size(); ++i) {
    if (!early_[i]) continue;
    const Vec3d late = Vec3d(radiance_[i]) - Vec3d(*early_[i]);
    if (std::isfinite(late.x + late.y + late.z)) sums_.found += late;
  }
  statistics.cut_light.add_all(sums_);
}

}  // namespace tyndall::render
