#include "render/method/decoupled.h"

#include "optics/phase.h"

namespace tyndall::render {

namespace {

// Where on a ray light is sampled, with the lights that may be: a piece of it, or all.
class PartOfRay {
 public:
  PartOfRay(const LitRay& ray, const RayPiece* piece) : whole_(ray), piece_(piece) {
    if (piece_) lights_.emplace(piece_->lights(*ray.world, ray.march->ray));
  }
  const LightSelection& lights() const { return piece_ ? *lights_ : *whole_.lights; }
  const Intervald* within() const { return piece_ ? &piece_->t : nullptr; }
  double probability() const { return piece_ ? piece_->probability : 1; }

 private:
  const LitRay& whole_;
  const RayPiece* piece_;
  std::optional<LightSelection> lights_;
};

}  // namespace

void DecoupledMarching::prepare_light(const compile::CompiledScene& world, const Rgb& throughput,
                                      std::span<const ScatteringOrder> orders, MediumRay& ray) const {
  begin_light(world, throughput, orders, ray);
  ray.light.density.emplace(ray.march, throughput);
  if (info(distance_).has(&StrategyTraits::uses_typical_phase) && !ray.light.empty())
    ray.light.typical_phase.emplace(world, ray.march, brightest_segment(ray.march));
}

void DecoupledMarching::sample_light(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) {
  const SobolPoint& point = request.point;
  const March& march = *ray.march;
  float u_light = point[3], u_t = point[2];
  const PartOfRay part(ray, ray.pieces.empty() ? nullptr : &ray.pieces.choose(u_t));
  const std::uint32_t index = part.lights().sample(u_light);
  const compile::LightAt light_now(*ray.world, index, march.ray.time);
  const compile::CompiledLight& light = *light_now;
  double share = ray.shares.of(light);
  if (share == 0) return;
  const auto pivot = light.sample_pivot(point[0], point[1]);
  if (!mixture_.prepare(distance_, {light, march, ray.throughput, *ray.density, pivot,
                                    ray.typical_phase ? &*ray.typical_phase : nullptr, part.within()}))
    return;

  const MarchPlace at = mixture_.sample(u_t);
  const double pdf_t = part.probability() * mixture_.pdf(at);
  if (!(pdf_t > 0)) return;

  const Vec3d x = march.ray.origin + march.ray.direction * at.t;
  const auto drawn = light.sample(x, pivot.value_or(optics::Pivot{}), point[0], point[1]);
  if (!drawn) return;
  const PhaseMixture phase(*ray.world, march, at.segment);
  const double choice = part.lights().probability(index);
  if (request.continues && drawn->pdf_solid_angle > 0) {
    const float m = optics::one_minus_cos(Vec3f(march.ray.direction), Vec3f(drawn->direction));
    const double p = choice * pdf_t * drawn->pdf_solid_angle;
    share *= balance(request.samples, p, request.volume_probability * ray.density->pdf(at) * phase.pdf(m));
  }
  const Rgb carried = request.weight * march.sigma_s_at(at.segment) * Rgb(at.transmittance) *
                      static_cast<float>(1 / (choice * pdf_t * request.samples));
  add_arrival(ray, {*drawn, index, x, at.segment, carried, share}, phase, request, request.shadow_seed,
              shadows);
}

double DecoupledMarching::pdf_light(const LitRay& ray, const LightHit& hit) {
  if (ray.empty()) return 0;
  const March& march = *ray.march;
  const Vec3d x = march.ray.origin + march.ray.direction * hit.t;
  const compile::LightAt light_now(*ray.world, hit.light, march.ray.time);
  const double solid_angle = light_now->pdf(x, hit.direction, hit.y, hit.normal);
  if (solid_angle == 0) return 0;
  const auto pivot = pivot_to(*light_now, hit);
  const RayPiece* const piece = ray.pieces.at(hit.t);
  if (!ray.pieces.empty() && !piece) return 0;
  const PartOfRay part(ray, piece);
  if (!mixture_.prepare(distance_, {*light_now, march, ray.throughput, *ray.density, pivot,
                                    ray.typical_phase ? &*ray.typical_phase : nullptr, part.within()}))
    return 0;
  return part.probability() * part.lights().probability(hit.light) * solid_angle *
         mixture_.pdf({hit.t, hit.segment, march.transmittance_at(hit.segment, hit.t)});
}

}  // namespace tyndall::render
