#include "render/emission_light.h"

#include "optics/phase.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

// Where a direction is drawn more often than a ray goes there by itself, emission along it is taken from
// drawn rays alone; elsewhere from those that go on, which are traced in any case. Weights of 1 and 0 (Veach
// 1997, section 9.2.3, the maximum heuristic): a ray that would count little is not traced.
bool is_drawn(double drawn, double met) { return drawn > met; }

}  // namespace

void sample_surface_emission(const EmissionField& field, const SurfacePoint& surface, const SobolPoint& point,
                             std::uint32_t seed, const Rgb& weight, bool continues, int samples,
                             Worker& worker) {
  const Vec3d& x = surface.transmits ? surface.position : surface.offset_position;
  const auto drawn = field.sample(x, point[0], point[1], point[2], point[3]);
  if (!drawn) return;
  const Rgb scattered = surface.value(drawn->direction);
  if (is_black(scattered)) return;
  if (continues && !is_drawn(samples * drawn->pdf, surface.pdf(drawn->direction))) return;
  worker.emission_rays.add({surface.start(drawn->direction), drawn->direction, infinity, surface.time},
                           weight * scattered * static_cast<float>(1 / (drawn->pdf * samples)), seed);
}

void sample_volume_emission(const compile::CompiledScene& world, const EmissionField& field,
                            const March& march, const Scattering& at, const SobolPoint& point,
                            std::uint32_t seed, const Rgb& weight, double continuation, int samples,
                            Worker& worker) {
  const Vec3d x = march.ray.origin + march.ray.direction * at.t;
  if (!(at.pdf > 0)) return;
  const auto drawn = field.sample(x, point[0], point[1], point[2], point[3]);
  if (!drawn) return;
  worker.phase.set(world, march, at.segment);
  const float m = optics::one_minus_cos(Vec3f(march.ray.direction), Vec3f(drawn->direction));
  if (continuation > 0 && !is_drawn(samples * drawn->pdf, continuation * worker.phase.pdf(m))) return;
  const Rgb contribution =
      weight * at.weight * worker.phase.eval(m) * static_cast<float>(1 / (drawn->pdf * samples));
  if (!is_black(contribution))
    worker.emission_rays.add({x, drawn->direction, infinity, march.ray.time}, contribution, seed);
}

float weight_of_met_emission(const EmissionField& field, int light_samples, const PathState& s) {
  switch (s.origin.kind) {
    case PathOrigin::Kind::camera:
    case PathOrigin::Kind::delta:
      return 1;
    case PathOrigin::Kind::volume:
    case PathOrigin::Kind::surface: {
      const int samples = s.depth == 1 ? light_samples : 1;
      const double p = field.pdf(s.origin.position, s.ray.direction);
      return is_drawn(samples * p, s.origin.direction_pdf) ? 0.0f : 1.0f;
    }
  }
  return 1;
}

}  // namespace tyndall::render
