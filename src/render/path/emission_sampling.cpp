#include "render/path/emission_sampling.h"

#include "optics/phase.h"
#include "render/march/phase_mixture.h"

namespace tyndall::render {

namespace {

// Where a direction is drawn more often than a ray goes there by itself, emission along it is taken from
// drawn rays alone; elsewhere from those that go on, which are traced in any case. Weights of 1 and 0 (Veach
// 1997, section 9.2.3, the maximum heuristic): a ray that would count little is not traced.
bool is_drawn(double drawn, double by_itself) { return drawn > by_itself; }

}  // namespace

void sample_surface_emission(const EmissionGrids& grids, const SurfacePoint& surface,
                             const LightRequest& request, EmissionBatch& rays) {
  const SobolPoint& u = request.point;
  const Vec3d& x = surface.transmits ? surface.position : surface.offset_position;
  const auto drawn = grids.sample(x, u[0], u[1], u[2], u[3]);
  if (!drawn) return;
  const Rgb scattered = surface.value(drawn->direction);
  if (is_black(scattered)) return;
  const int samples = request.samples;
  if (request.continues && !is_drawn(samples * drawn->pdf, surface.pdf(drawn->direction))) return;
  rays.add({surface.start(drawn->direction), drawn->direction, infinity, surface.time},
           request.weight * scattered * static_cast<float>(1 / (drawn->pdf * samples)), request.shadow_seed,
           request.target);
}

void sample_volume_emission(const compile::CompiledScene& world, const EmissionGrids& grids,
                            const March& march, const Scattering& at, const LightRequest& request,
                            EmissionBatch& rays) {
  const Vec3d x = march.ray.origin + march.ray.direction * at.t;
  if (!(at.pdf > 0)) return;
  const SobolPoint& u = request.point;
  const auto drawn = grids.sample(x, u[0], u[1], u[2], u[3]);
  if (!drawn) return;
  const PhaseMixture phase(world, march, at.segment);
  const float m = optics::one_minus_cos(Vec3f(march.ray.direction), Vec3f(drawn->direction));
  const double continuation = request.continues ? request.volume_probability : 0;
  const int samples = request.samples;
  if (continuation > 0 && !is_drawn(samples * drawn->pdf, continuation * phase.pdf(m))) return;
  const Rgb contribution =
      request.weight * at.weight * phase.eval(m) * static_cast<float>(1 / (drawn->pdf * samples));
  if (!is_black(contribution))
    rays.add({x, drawn->direction, infinity, march.ray.time}, contribution, request.shadow_seed,
             request.target);
}

float mis_weight_of_emission(const EmissionGrids& grids, int light_samples, const PathState& s) {
  switch (s.origin.kind) {
    case PathOrigin::Kind::camera:
    case PathOrigin::Kind::delta:
      return 1;
    case PathOrigin::Kind::volume:
    case PathOrigin::Kind::surface: {
      const int samples = s.depth == 1 ? light_samples : 1;
      const double p = grids.pdf(s.origin.position, s.ray.direction);
      return is_drawn(samples * p, s.origin.direction_pdf) ? 0.0f : 1.0f;
    }
  }
  return 1;
}

}  // namespace tyndall::render
