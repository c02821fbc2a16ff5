#include "render/direct_light.h"

#include <algorithm>

#include "optics/light_sampling.h"
#include "optics/phase.h"
#include "render/distance.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

// Shadow rays end this fraction short of what they aim at; surfaces of the light itself are skipped by name,
// so nothing hangs on the margin but other surfaces that touch the light.
constexpr double shadow_end = 1 - 0x1p-40;

}  // namespace

// What a mesh light or a glowing shape hides of itself is dark, so its surface is not skipped: the ray ends
// before the point it aims at.
ShadowRay shadow_ray(const compile::CompiledScene& world, const Vec3d& from, double time,
                     const optics::LightSample& light, std::uint32_t index, const Rgb& contribution,
                     std::uint32_t seed) {
  const double end = light.distance * shadow_end;
  if (!std::holds_alternative<optics::MeshLight>(world.lights[index]))
    return {{from, light.direction, end, time}, index, contribution, seed};
  const double margin = 2 * world.light_errors[index];
  return {{from, light.direction, std::max(end - margin, 0.0), time}, compile::no_index, contribution, seed};
}

void LightStrategies::set(const compile::CompiledScene& world, const March& march, const Rgb& throughput,
                          Method method, Distance distance, std::span<const ScatteringOrder> orders) {
  world_ = &world;
  march_ = &march;
  throughput_ = throughput;
  method_ = method;
  distance_ = distance;
  orders_ = orders;
  flight_ = nullptr;
  density_.reset();
  if (!flies(method)) density_.emplace(march, throughput);
  if (march.scatters())
    lights_.set(world, march.ray.origin, march.ray.direction, march.scattering_stretches.front().lo,
                march.scattering_stretches.back().hi, march.ray.time);
  if (method == Method::decoupled && distance == Distance::product && !empty())
    typical_phase_.set(world, march, brightest_segment(march));
}

void LightStrategies::sample(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight,
                             bool continues, double volume_probability, int samples, Worker& worker) {
  if (flies(method_)) return sample_collision(point, shadow_seed, weight, continues, worker);
  if (method_ == Method::brute_force)
    return sample_steps(point, shadow_seed, weight, continues, volume_probability, worker);
  float u_light = point[0];
  const std::uint32_t index = lights_.sample(u_light);
  const compile::LightAt light_now(*world_, index, march_->ray.time);
  const optics::Light& light = *light_now;
  const bool distant = std::holds_alternative<optics::DistantLight>(light);
  if (distant_alone_ && !distant) return;
  const auto pivot = optics::sample_pivot(light, point[3], point[4]);

  const DistanceMixture distances(light, *march_, *density_, throughput_, distance_, pivot, typical_phase_,
                                  worker);
  if (!distances.available()) return;

  // The strategy is chosen with the light's rescaled number, which leaves dimensions 1 and 2 for t.
  const MarchPlace at = distances.sample(u_light, point[1], point[2]);
  const double pdf_t = distances.pdf(at);
  if (!(pdf_t > 0)) return;

  const Vec3d x = march_->ray.origin + march_->ray.direction * at.t;
  const auto drawn = optics::sample_light(light, x, pivot.value_or(optics::Pivot{}), point[3], point[4]);
  if (!drawn) return;
  worker.phase.set(*world_, *march_, at.segment);
  const float m = optics::one_minus_cos(Vec3f(march_->ray.direction), Vec3f(drawn->direction));
  const double choice = lights_.probability(index);
  double share = distant ? share_of_distant_ : 1;
  if (continues && drawn->pdf_solid_angle > 0) {
    const double p = choice * pdf_t * drawn->pdf_solid_angle;
    share *= balance(samples, p, volume_probability * density_->pdf(at) * worker.phase.pdf(m));
  }
  const Rgb carried = weight * march_->sigma_s_at(at.segment) * Rgb(at.transmittance) *
                      static_cast<float>(1 / (choice * pdf_t * samples));
  add_ray({*drawn, index, x, at.segment, carried, share}, shadow_seed, worker);
}

void LightStrategies::add_ray(const Arrival& a, std::uint32_t shadow_seed, Worker& worker) const {
  const float m = optics::one_minus_cos(Vec3f(march_->ray.direction), Vec3f(a.drawn.direction));
  const Rgb arriving = a.carried * a.drawn.radiance_over_pdf;
  const Rgb contribution = arriving * worker.phase.eval(m) * static_cast<float>(a.share);
  worker.higher_contributions.clear();
  if (!orders_.empty() && !is_black(arriving)) {
    const Rgb albedo = march_->albedo_at(a.segment);
    Rgb carried = arriving * static_cast<float>(a.share_of_higher);
    for (const ScatteringOrder& order : orders_) {
      carried *= albedo;
      worker.higher_contributions.push_back(carried * order.contribution *
                                            worker.phase.eval_softened(m, order.anisotropy));
    }
  }
  if (is_black(contribution) && worker.higher_contributions.empty()) return;
  worker.shadows.add(shadow_ray(*world_, a.x, march_->ray.time, a.drawn, a.light, contribution, shadow_seed),
                     worker.higher_contributions);
}

double LightStrategies::pdf(std::uint32_t light, std::uint32_t segment, double t, const Vec3d& direction,
                            const Vec3d& y, const Vec3d& normal, Worker& worker) const {
  if (empty()) return 0;
  const Vec3d x = march_->ray.origin + march_->ray.direction * t;
  const compile::LightAt light_now(*world_, light, march_->ray.time);
  const double solid_angle = optics::pdf_light(*light_now, x, direction, y, normal);
  if (solid_angle == 0) return 0;
  // The pivot that would lead to y: y itself on a flat light, the centre of a sphere.
  auto pivot = optics::sample_pivot(*light_now, 0.5f, 0.5f);
  if (pivot && optics::pivot_on_surface(*light_now)) pivot = optics::Pivot{y, normal};
  if (method_ == Method::brute_force) return lights_.probability(light) * solid_angle / step_at(segment);
  if (flies(method_)) {
    const FlightDensities densities = flight_densities({light, pivot, 0}, t, flight_->density, worker);
    return lights_.probability(light) * solid_angle * (densities.aimed + densities.collision);
  }
  const DistanceMixture distances(*light_now, *march_, *density_, throughput_, distance_, pivot,
                                  typical_phase_, worker);
  return lights_.probability(light) * solid_angle *
         distances.pdf({t, segment, march_->transmittance_at(segment, t)});
}

void sample_surface_light(const compile::CompiledScene& world, const SurfacePoint& surface,
                          const LightChoice& lights, const SobolPoint& point, std::uint32_t shadow_seed,
                          const Rgb& weight, bool continues, int samples, Worker& worker) {
  float u_light = point[0];
  const std::uint32_t index = lights.sample(u_light);
  const compile::LightAt light_now(world, index, surface.time);
  const optics::Light& light = *light_now;
  const Vec3d& x = surface.transmits ? surface.position : surface.offset_position;
  const optics::Pivot pivot = optics::sample_pivot(light, point[3], point[4]).value_or(optics::Pivot{});
  const auto drawn = optics::sample_light(light, x, pivot, point[3], point[4]);
  if (!drawn) return;
  const Rgb scattered = surface.value(drawn->direction);
  if (is_black(scattered)) return;
  const double choice = lights.probability(index);
  double share = 1;
  if (continues && drawn->pdf_solid_angle > 0)
    share = balance(samples, choice * drawn->pdf_solid_angle, surface.pdf(drawn->direction));
  const Rgb contribution =
      weight * scattered * drawn->radiance_over_pdf * static_cast<float>(share / (choice * samples));
  if (!is_black(contribution))
    worker.shadows.add(shadow_ray(world, surface.start(drawn->direction), surface.time, *drawn, index,
                                  contribution, shadow_seed));
}

}  // namespace tyndall::render
