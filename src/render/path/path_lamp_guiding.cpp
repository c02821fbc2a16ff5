#include "render/path/path_lamp_guiding.h"

#include <array>

#include "optics/phase.h"
#include "render/lights/lamp_guiding.h"

namespace tyndall::render {

namespace {

// Rays are sent from every first place of a path, and from this share of later ones.
constexpr float later_rays = 0.25f;
// What lies farther than so many times the mean distance of two scatterings is left to paths: little light of
// it gets there, and deep in milk nothing is saved.
constexpr double most_scatterings = 6;

// What may be sent from x, and the random numbers.
struct LampRays {
  SobolPoint u;
  float chance;
  LampGuide guide;

  LampRays(const PathContext& context, const PathSlot& path, const PathState& s, const compile::Ray& from,
           Decision decision, const LightRegion* region)
      : u(path.numbers(s).point(decision)),
        chance(s.depth == 0 ? 1.0f : later_rays),
        guide(context.world, context.settings.lit_spots.get(), from, std::span(u).subspan<4>(), region) {}

  // What is left for a path that draws w with this density.
  float left(const Vec3d& w, double pdf) const {
    return static_cast<float>(pdf / (pdf + chance * guide.pdf(w)));
  }
  // The ray, by chance. `scattered(w)`: what is scattered from w, and the density of w when the path draws
  // it.
  template <class Scattered>
  std::optional<PathState> sent(const PathState& s, Scattered&& scattered) const {
    if (u[3] >= chance) return std::nullopt;
    const Vec3d toward = guide.sample(u[2], u[0], u[1]);
    const auto [value, density] = scattered(toward);
    const auto weight = static_cast<float>(1 / (density + chance * guide.pdf(toward)));
    if (!(weight > 0) || is_black(value)) return std::nullopt;
    PathState ray = s;
    ray.throughput *= value * weight;
    ray.ray.direction = toward;
    ray.ray.t_max = infinity;
    ray.branch |= lamp_branch;
    ray.shares = LightShares::lamps_alone();
    ++ray.depth;
    return ray;
  }
};

bool sends_to_lamps(const PathContext& context, const PathState& s) {
  const PathSettings& settings = context.settings;
  return settings.lamp_guiding && s.depth + 1 <= static_cast<std::uint32_t>(settings.bounces) &&
         s.media_scatterings <= settings.real_scatterings;
}

}  // namespace

LampShare share_with_lamp_ray(const PathContext& context, const PathSlot& path, const PathState& s,
                              const GuidedScattering& scattering, std::uint32_t segment) {
  if (!sends_to_lamps(context, s)) return {};
  const double reach = most_scatterings / luminance(path.march().sigma_s_at(segment));
  const LearnedLights* const learned = context.settings.learned_lights.get();
  const LampRays rays(context, path, s, {scattering.x, s.ray.direction, reach, s.ray.time},
                      Decision::lamp_guiding, learned ? learned->in_medium(scattering.x) : nullptr);
  if (rays.guide.empty()) return {};
  LampShare out{rays.left(normalize(Vec3d(scattering.w)), scattering.pdf), {}};
  out.sent = rays.sent(s, [&](const Vec3d& toward) {
    const float turn = optics::one_minus_cos(Vec3f(s.ray.direction), Vec3f(toward));
    return std::pair{scattering.phase.eval(turn), double{scattering.phase.pdf(turn)}};
  });
  if (out.sent) {
    out.sent->ray.origin = scattering.x;
    out.sent->origin.kind = PathOrigin::Kind::volume;
  }
  return out;
}

LampShare share_with_lamp_ray(const PathContext& context, const PathSlot& path, const PathState& s,
                              const SurfacePoint& surface, const std::optional<optics::SurfaceSample>& next) {
  if (surface.only_deltas || !sends_to_lamps(context, s)) return {};
  const LampRays rays(context, path, s, {surface.position, surface.normal, infinity, s.ray.time},
                      Decision::lamp_guiding_surface, light_region(context, surface));
  if (rays.guide.empty()) return {};
  LampShare out;
  if (next && !next->delta) out.left = rays.left(next->direction, next->pdf);
  out.sent = rays.sent(s, [&](const Vec3d& toward) {
    return std::pair{surface.value(toward), surface.pdf(toward)};
  });
  if (out.sent) {
    out.sent->ray.origin = surface.start(out.sent->ray.direction);
    out.sent->origin.kind = PathOrigin::Kind::surface;
    if (s.depth == 0) out.sent->branch |= behind_branch;
  }
  return out;
}

void light_lamp_ray(const PathContext& context, PathSlot& path, const PathState& s,
                    const HitSurfaces& surfaces, bool continues) {
  if (path.march().scatters()) {
    prepare_light(context, path, s, {}, s.shares);
    light_volume(context, path, s, false, 1);
  }
  if (!(surfaces.mass() > 0)) return;
  const double u = surfaces.several() ? path.numbers(s).point(Decision::continuation)[3] : 0;
  const HitSurface& surface = surfaces.choose(u);
  PathState at = s;
  at.throughput = surface.throughput * static_cast<float>(surfaces.mass() / surface.mass);
  // A surface that shines back in few directions is better met by the path, which keeps its own part of that
  // light.
  light_surface(context, path, at, *surface.point, continues && surface.point->model);
}

}  // namespace tyndall::render
