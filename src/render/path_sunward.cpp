#include "render/path_sunward.h"

#include "base/numerics.h"
#include "optics/light_sampling.h"
#include "render/decisions.h"
#include "render/worker.h"

namespace tyndall::render {

SunwardShare share_with_sunward(const PathContext& context, const PathSlot& path, const PathState& s,
                                const LightStrategies& strategies, const Vec3d& x, const Vec3f& w, float pdf,
                                float u) {
  SunwardShare out;
  const auto& [world, settings, worker] = context;
  if (!settings.sunward || s.depth + 1 > static_cast<std::uint32_t>(settings.bounces) ||
      s.media_scatterings > settings.real_scatterings)
    return out;
  SunwardDirections& sunward = worker.sunward;
  sunward.set(world, strategies.lights(), worker.phase, s.ray.time);
  const float chance = sunward.chance();
  if (chance == 0) return out;
  out.left = pdf / (pdf + chance * sunward.pdf(w));
  if (u >= chance) return out;
  const SobolPoint v = path.sampler->point(decision(Decision::sunward, s.depth, s.branch));
  const Vec3f toward = sunward.sample(v[2], v[3], v[0], v[4], v[1]);
  const float turn = optics::one_minus_cos(Vec3f(s.ray.direction), toward);
  const float density = worker.phase.pdf(turn) + chance * sunward.pdf(toward);
  PathState& ray = out.sent.emplace(s);
  ray.throughput *= worker.phase.eval(turn) * (1 / density);
  ray.ray = {x, normalize(Vec3d(toward)), infinity, s.ray.time};
  ray.branch |= sunward_branch;
  ray.share_of_distant = 1;
  ray.origin.kind = PathOrigin::Kind::volume;
  ++ray.depth;
  return out;
}

void light_sunward(const PathContext& context, PathSlot& path, const PathState& s) {
  const March& m = path.march();
  LightStrategies& strategies = path.light();
  strategies.set(context.world, m, s.throughput, context.settings.method, context.settings.distance, {});
  strategies.set_distant(1, true);
  if (m.scatters()) light_volume(context, path, s, strategies, false, 1);
}

}  // namespace tyndall::render
