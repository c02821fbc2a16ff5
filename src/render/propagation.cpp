#include "render/propagation.h"

#include "render/decisions.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

std::uint64_t id(Decision d, const PathState& s) { return decision(d, s.depth, s.branch); }

}  // namespace

void request_propagation(const compile::CompiledScene& world, const PathSettings& settings, PathSlot& path,
                         compile::RayKind kind, Worker& worker) {
  const PathState& s = path.state;
  if (settings.method != Method::tracking) {
    const std::uint32_t seed = settings.jitters ? path.sampler->bits(id(Decision::jitter, s), 0) : 0;
    worker.march_requests.push_back(
        {s.ray, kind, seed, &path.march(),
         settings.method == Method::decoupled && (s.depth > 0 || !settings.whole_camera_marches)});
    return;
  }
  // The light is chosen first, so that the flight knows a point to be aimed at.
  find_volumes(world, s.ray, kind, path.march());
  path.light().set(world, path.march(), s.throughput, settings.method, settings.distance,
                   settings.orders_after(s.media_scatterings));
  path.light().aim(path.sampler->point(id(Decision::aimed, s)), path.flight(), worker);
  worker.flight_requests.push_back(
      {path.sampler->bits(id(Decision::flight, s), 0), s.throughput, &path.march(), &path.flight()});
}

void propagate(const compile::CompiledScene& world, const PathSettings& settings,
               std::span<const std::unique_ptr<PathSlot>> paths, Worker& worker) {
  if (settings.method == Method::tracking) {
    track(world, worker.flight_requests, worker);
    worker.flight_requests.clear();
    return;
  }
  march(world, worker.march_requests, worker);
  if (settings.method != Method::stochastic) return;
  for (const auto& path : paths) {
    const PathState& s = path->state;
    const SobolPoint u = path->sampler->point(id(Decision::distance, s));
    path->light().set(world, path->march(), s.throughput, settings.method, settings.distance,
                      settings.orders_after(s.media_scatterings));
    path->light().aim({}, path->flight(), worker);
    fly_to_depth(path->march(), s.throughput, u[0], u[1], path->flight());
  }
}

Scattering draw_scattering(const PathSettings& settings, PathSlot& path, float u_channel, float u,
                           double volume_probability) {
  const March& m = path.march();
  if (flies(settings.method)) {
    const Flight& flight = path.flight();
    return {flight.t, m.segment_at(flight.t), flight.density, flight.weight};
  }
  const DensityDistribution& density = path.light().density();
  const MarchPlace at = density.sample(u_channel, u);
  Scattering out{at.t, at.segment, density.pdf(at) * volume_probability, {}};
  out.weight = m.sigma_s_at(at.segment) * Rgb(at.transmittance) * static_cast<float>(1 / out.pdf);
  return out;
}

}  // namespace tyndall::render
