#include "render/lights/next_event.h"

#include <algorithm>

#include "base/inline_vector.h"
#include "optics/phase.h"

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
  const std::optional<double> margin = world.lights[index].shadow_margin();
  if (!margin) return {{from, light.direction, end, time}, index, contribution, seed};
  return {{from, light.direction, std::max(end - *margin, 0.0), time}, compile::no_index, contribution, seed};
}

void add_arrival(const LitRay& ray, const Arrival& a, const PhaseMixture& phase, const LightRequest& request,
                 std::uint32_t shadow_seed, ShadowBatch& shadows) {
  const March& march = *ray.march;
  const float m = optics::one_minus_cos(Vec3f(march.ray.direction), Vec3f(a.drawn.direction));
  const Rgb arriving = a.carried * a.drawn.radiance_over_pdf;
  const Rgb contribution = arriving * phase.eval(m) * static_cast<float>(a.share);
  InlineVector<Rgb, 8> higher;  // contributions of higher orders
  if (!ray.orders.empty() && !is_black(arriving)) {
    const Rgb albedo = march.albedo_at(a.segment);
    Rgb carried = arriving * static_cast<float>(a.share_of_higher);
    for (const ScatteringOrder& order : ray.orders) {
      carried *= albedo;
      higher.push_back(carried * order.contribution * phase.eval_softened(m, order.anisotropy));
    }
  }
  if (is_black(contribution) && higher.empty()) return;
  shadows.add(shadow_ray(*ray.world, a.x, march.ray.time, a.drawn, a.light, contribution, shadow_seed),
              request.target, {higher.begin(), higher.end()});
}

void sample_surface_light(const compile::CompiledScene& world, const SurfacePoint& surface,
                          const LightSelection& lights, const LightRequest& request, ShadowBatch& shadows) {
  const SobolPoint& point = request.point;
  float u_light = point[3];
  const std::uint32_t index = lights.sample(u_light);
  const compile::LightAt light_now(world, index, surface.time);
  const compile::CompiledLight& light = *light_now;
  const float counts = request.shares.of(light);
  if (counts == 0) return;
  const Vec3d& x = surface.transmits ? surface.position : surface.offset_position;
  const optics::Pivot pivot = light.sample_pivot(point[0], point[1]).value_or(optics::Pivot{});
  const auto drawn = light.sample(x, pivot, point[0], point[1]);
  if (!drawn) return;
  const Rgb scattered = surface.value(drawn->direction);
  if (is_black(scattered)) return;
  const double choice = lights.probability(index);
  double share = counts;
  if (request.continues && drawn->pdf_solid_angle > 0)
    share *= balance(request.samples, choice * drawn->pdf_solid_angle, surface.pdf(drawn->direction));
  const Rgb contribution = request.weight * scattered * drawn->radiance_over_pdf *
                           static_cast<float>(share / (choice * request.samples));
  if (!is_black(contribution))
    shadows.add(shadow_ray(world, surface.start(drawn->direction), surface.time, *drawn, index, contribution,
                           request.shadow_seed),
                request.target);
}

}  // namespace tyndall::render
