#include "render/path/path_distant_guiding.h"

#include "base/numerics.h"
#include "optics/phase.h"
#include "render/lights/distant_light_guiding.h"

namespace tyndall::render {

GuidedShare share_with_guided(const PathContext& context, const PathSlot& path, const PathState& s,
                              const GuidedScattering& scattering, float u) {
  GuidedShare out;
  const PathSettings& settings = context.settings;
  const std::optional<LightSelection>& lights = path.ray().light.lights;
  if (!settings.distant_guiding || s.depth + 1 > static_cast<std::uint32_t>(settings.bounces) ||
      s.media_scatterings > settings.real_scatterings || !lights)
    return out;
  const PhaseMixture& phase = scattering.phase;
  const DistantLightGuide guide(context.world, *lights, phase, s.ray.time);
  const float chance = guide.chance();
  if (chance == 0) return out;
  out.left = scattering.pdf / (scattering.pdf + chance * guide.pdf(scattering.w));
  if (u >= chance) return out;
  const SobolPoint v = path.numbers(s).point(Decision::distant_guiding);
  const Vec3f toward = guide.sample(v[2], v[3], v[0], v[4], v[1]);
  const float turn = optics::one_minus_cos(Vec3f(s.ray.direction), toward);
  const float density = phase.pdf(turn) + chance * guide.pdf(toward);
  PathState& ray = out.sent.emplace(s);
  ray.throughput *= phase.eval(turn) * (1 / density);
  ray.ray = {scattering.x, normalize(Vec3d(toward)), infinity, s.ray.time};
  ray.branch |= guided_branch;
  ray.shares = {};
  ray.origin.kind = PathOrigin::Kind::volume;
  ++ray.depth;
  return out;
}

void light_guided(const PathContext& context, PathSlot& path, const PathState& s) {
  prepare_light(context, path, s, {}, LightShares::distant_alone());
  if (path.march().scatters()) light_volume(context, path, s, false, 1);
}

}  // namespace tyndall::render
