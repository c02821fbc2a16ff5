#include "render/method/free_path_light.h"

#include "optics/phase.h"

namespace tyndall::render {

// Equi-angular aiming competes where it can be had, and is all there is when nothing else is wanted.
bool FreePathLight::prepare(const LitRay& ray, const ChosenLight& light) {
  if (!aims_ || !info(distance_).has(&StrategyTraits::aims_at_light) || !light.pivot) return false;
  lit_.clear();
  lit_intervals(*compile::LightAt(*ray.world, light.light, ray.march->ray.time), *light.pivot, *ray.march,
                nullptr, lit_);
  equiangular_.emplace(ray.march->ray.origin, ray.march->ray.direction, light.pivot->position, lit_);
  return equiangular_->available();
}

FreePathLight::Densities FreePathLight::densities(const LitRay& ray, const ChosenLight& light, double t,
                                                  double collision) {
  if (!prepare(ray, light)) return {0, collision};
  return {equiangular_->pdf(t), info(distance_).includes<DensityStrategy>() ? collision : 0.0};
}

void FreePathLight::aim(const SobolPoint& point, MediumRay& ray) {
  ray.light.free_path = &ray.free_path;
  ray.free_path.aimed_t = {};
  if (!aims_ || !info(distance_).has(&StrategyTraits::aims_at_light) || ray.light.empty()) return;
  if (prepare(ray.light, choose_light(ray.light, point)))
    ray.free_path.aimed_t = equiangular_->sample(point[2]);
}

void FreePathLight::sample_aimed(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) {
  const FreePath& f = *ray.free_path;
  if (!f.aimed_t || is_black(f.aimed_weight)) return;
  const ChosenLight light = choose_light(ray, request.point);
  const Densities all = densities(ray, light, *f.aimed_t, f.aimed_density);
  if (!(all.aimed > 0)) return;
  add(ray, light,
      {*f.aimed_t, request.weight * f.aimed_weight * static_cast<float>(1 / all.aimed), all.aimed, all,
       f.aimed_density},
      request, shadows);
}

void FreePathLight::sample_collision(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) {
  const FreePath& f = *ray.free_path;
  if (!f.collided || ray.empty()) return;
  const ChosenLight light = choose_light(ray, request.point);
  const Densities all = densities(ray, light, f.t, f.density);
  if (!(all.collision > 0)) return;
  add(ray, light, {f.t, request.weight * f.weight, all.collision, all, f.density}, request, shadows);
}

void FreePathLight::add(const LitRay& ray, const ChosenLight& light, const Place& place,
                        const LightRequest& request, ShadowBatch& shadows) const {
  const March& march = *ray.march;
  const Vec3d x = march.ray.origin + march.ray.direction * place.t;
  const auto drawn =
      compile::LightAt(*ray.world, light.light, march.ray.time)
          ->sample(x, light.pivot.value_or(optics::Pivot{}), request.point[0], request.point[1]);
  if (!drawn) return;
  const std::uint32_t segment = march.segment_at(place.t);
  const PhaseMixture phase(*ray.world, march, segment);
  const float m = optics::one_minus_cos(Vec3f(march.ray.direction), Vec3f(drawn->direction));
  // Of all ways to the same points, per metre and steradian; a light of no extent is hit by none but these.
  const double y = drawn->pdf_solid_angle > 0 ? light.probability * drawn->pdf_solid_angle : 1;
  const double of_light = (place.densities.aimed + place.densities.collision) * y;
  double all = of_light;
  if (request.continues && drawn->pdf_solid_angle > 0) all += place.collision * phase.pdf(m);
  add_arrival(ray,
              {*drawn, light.light, x, segment, place.weight * static_cast<float>(1 / light.probability),
               place.own_density * y / all, place.own_density * y / of_light},
              phase, request, request.shadow_seed, shadows);
}

double FreePathLight::pdf_light(const LitRay& ray, const LightHit& hit) {
  if (ray.empty()) return 0;
  const Vec3d x = ray.march->ray.origin + ray.march->ray.direction * hit.t;
  const compile::LightAt light_now(*ray.world, hit.light, ray.march->ray.time);
  const double solid_angle = light_now->pdf(x, hit.direction, hit.y, hit.normal);
  if (solid_angle == 0) return 0;
  const Densities all =
      densities(ray, {hit.light, pivot_to(*light_now, hit), 0}, hit.t, ray.free_path->density);
  return ray.lights->probability(hit.light) * solid_angle * (all.aimed + all.collision);
}

}  // namespace tyndall::render
