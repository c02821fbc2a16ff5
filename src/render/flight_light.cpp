// Direct light of the methods beside decoupled marching: where a flight collides and where it was aimed,
// mixed as in Miller, Georgiev and Jarosz 2019 (transport §4); and at every step (Perlin and Hoffert 1989).
#include <algorithm>
#include <cmath>

#include "optics/phase.h"
#include "render/direct_light.h"
#include "render/distance.h"
#include "render/equiangular.h"
#include "render/worker.h"

namespace tyndall::render {

LightStrategies::Aim LightStrategies::choose(const SobolPoint& point, float& u_rest) const {
  u_rest = point[0];
  Aim aim;
  aim.light = lights_.sample(u_rest);
  aim.choice = lights_.probability(aim.light);
  aim.pivot =
      optics::sample_pivot(*compile::LightAt(*world_, aim.light, march_->ray.time), point[3], point[4]);
  return aim;
}

// Equi-angular aiming competes where it can be had, and is all there is when nothing else is wanted.
LightStrategies::FlightDensities LightStrategies::flight_densities(const Aim& aim, double t, double collision,
                                                                   Worker& worker) const {
  if (!aims() || !aim.pivot) return {0, collision};
  worker.stretches.clear();
  reached_stretches(*compile::LightAt(*world_, aim.light, march_->ray.time), *aim.pivot, *march_,
                    worker.stretches);
  const Equiangular equiangular(march_->ray.origin, march_->ray.direction, aim.pivot->position,
                                worker.stretches);
  if (!equiangular.available()) return {0, collision};
  return {equiangular.pdf(t), distance_ == Distance::equiangular ? 0.0 : collision};
}

void LightStrategies::aim(const SobolPoint& point, Flight& flight, Worker& worker) {
  flight_ = &flight;
  flight.aimed_t = {};
  if (!aims() || empty()) return;
  float u = 0;
  const Aim aim = choose(point, u);
  if (!aim.pivot) return;
  worker.stretches.clear();
  reached_stretches(*compile::LightAt(*world_, aim.light, march_->ray.time), *aim.pivot, *march_,
                    worker.stretches);
  const Equiangular equiangular(march_->ray.origin, march_->ray.direction, aim.pivot->position,
                                worker.stretches);
  if (equiangular.available()) flight.aimed_t = equiangular.sample(point[2]);
}

void LightStrategies::sample_aimed(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight,
                                   bool continues, Worker& worker) {
  if (!flight_->aimed_t || is_black(flight_->aimed_weight)) return;
  float u = 0;
  const Aim aim = choose(point, u);
  const FlightDensities densities = flight_densities(aim, *flight_->aimed_t, flight_->aimed_density, worker);
  if (!(densities.aimed > 0)) return;
  add_flight_ray(aim, point, *flight_->aimed_t,
                 weight * flight_->aimed_weight * static_cast<float>(1 / densities.aimed), densities.aimed,
                 densities, flight_->aimed_density, continues, shadow_seed, worker);
}

void LightStrategies::sample_collision(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight,
                                       bool continues, Worker& worker) {
  if (!flight_->collided || empty()) return;
  float u = 0;
  const Aim aim = choose(point, u);
  const FlightDensities densities = flight_densities(aim, flight_->t, flight_->density, worker);
  if (!(densities.collision > 0)) return;
  add_flight_ray(aim, point, flight_->t, weight * flight_->weight, densities.collision, densities,
                 flight_->density, continues, shadow_seed, worker);
}

void LightStrategies::add_flight_ray(const Aim& aim, const SobolPoint& point, double t, const Rgb& weight,
                                     double own_density, const FlightDensities& densities, double collision,
                                     bool continues, std::uint32_t shadow_seed, Worker& worker) {
  const Vec3d x = march_->ray.origin + march_->ray.direction * t;
  const auto drawn = optics::sample_light(*compile::LightAt(*world_, aim.light, march_->ray.time), x,
                                          aim.pivot.value_or(optics::Pivot{}), point[3], point[4]);
  if (!drawn) return;
  const std::uint32_t segment = march_->segment_at(t);
  worker.phase.set(*world_, *march_, segment);
  const float m = optics::one_minus_cos(Vec3f(march_->ray.direction), Vec3f(drawn->direction));
  // Of all ways to the same points, per metre and steradian; a light of no extent is met by none but these.
  const double y = drawn->pdf_solid_angle > 0 ? aim.choice * drawn->pdf_solid_angle : 1;
  const double of_light = (densities.aimed + densities.collision) * y;
  double all = of_light;
  if (continues && drawn->pdf_solid_angle > 0) all += collision * worker.phase.pdf(m);
  add_ray({*drawn, aim.light, x, segment, weight * static_cast<float>(1 / aim.choice), own_density * y / all,
           own_density * y / of_light},
          shadow_seed, worker);
}

// The part of a segment that gets one light sample: the volumes' step, also in media without variation.
double LightStrategies::step_at(std::uint32_t segment) const {
  double step = infinity;
  for (const Block& b : march_->blocks)
    if (b.holds(segment)) {
      const compile::CompiledVolume& volume = world_->volumes[b.volume];
      step = std::min(step, volume.step.automatic() ? volume.widest_step : volume.step.metres);
    }
  const double dt = march_->dt[segment];
  return dt / std::clamp(std::ceil(dt / step), 1.0, double{max_segments});
}

void LightStrategies::sample_steps(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight,
                                   bool continues, double volume_probability, Worker& worker) {
  float u_rest = 0;
  std::uint32_t counter = 0;
  for (std::uint32_t i = 0; i < march_->count; ++i) {
    const double dt = step_at(i);
    const int steps = static_cast<int>(std::lround(march_->dt[i] / dt));
    const Rgb sigma_s = march_->sigma_s_at(i);
    if (is_black(sigma_s)) continue;
    for (int k = 0; k < steps; ++k, ++counter) {
      const double t = march_->t0[i] + (k + jitter(shadow_seed, counter)) * dt;
      SobolPoint moved =
          point;  // each step has points of its own: a rotation of the sample's (Cranley-Patterson)
      for (std::size_t d = 0; d < moved.size(); ++d) {
        moved[d] += unit_float(static_cast<std::uint32_t>(hash_bits(shadow_seed + d, counter) >> 32));
        moved[d] = std::min(moved[d] - std::floor(moved[d]), one_minus_ulp_f);
      }
      const Aim aim = choose(moved, u_rest);
      const Vec3d x = march_->ray.origin + march_->ray.direction * t;
      const auto drawn = optics::sample_light(*compile::LightAt(*world_, aim.light, march_->ray.time), x,
                                              aim.pivot.value_or(optics::Pivot{}), moved[3], moved[4]);
      if (!drawn) continue;
      worker.phase.set(*world_, *march_, i);
      const float m = optics::one_minus_cos(Vec3f(march_->ray.direction), Vec3f(drawn->direction));
      double share = 1;
      if (continues && drawn->pdf_solid_angle > 0)
        share = balance(
            1, aim.choice * drawn->pdf_solid_angle / dt,
            volume_probability * density_->pdf({t, i, march_->transmittance_at(i, t)}) * worker.phase.pdf(m));
      const Rgb carried =
          weight * sigma_s * Rgb(march_->transmittance_at(i, t)) * static_cast<float>(dt / aim.choice);
      add_ray({*drawn, aim.light, x, i, carried, share}, shadow_seed + counter, worker);
    }
  }
}

}  // namespace tyndall::render
