#include "render/lights/light_places.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/numerics.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "optics/phase.h"
#include "render/context/thread_context.h"
#include "render/distance/density_sampling.h"
#include "render/film/camera.h"
#include "render/march/phase_mixture.h"
#include "render/march/ray_march.h"
#include "render/surface/transparent_hits.h"

namespace tyndall::render {

namespace {

// One path in so many pixels, within limits: the pilot is to cost a small part of a picture.
constexpr std::size_t pixels_a_path = 4, least_paths = 256, most_paths = 4096;
constexpr std::uint32_t most_scatterings = 3, places_on_camera_rays = 2;
constexpr std::size_t paths_together = 128;

// A path on its way.
struct Walker {
  std::uint32_t number = 0;
  compile::Ray ray;
  Rgb throughput{1};
  std::optional<compile::SurfaceHit> hit;
  std::vector<Crossing> crossings;
  March march;
};

// The walkers of one thread, and what they share.
class Walk {
 public:
  explicit Walk(const compile::CompiledScene& world) : world_(world), camera_(world) {}

  // The paths numbered [first, end).
  std::vector<LightPlace> run(std::uint32_t first, std::uint32_t end) {
    places_.clear();
    start(first, end);
    const auto bounces = static_cast<std::uint32_t>(world_.scene.settings.bounces);
    for (std::uint32_t depth = 0; depth <= std::min(bounces, most_scatterings) && !walkers_.empty();
         ++depth) {
      trace(depth);
      std::erase_if(walkers_, [&](Walker& walker) { return !advance(walker, depth); });
    }
    return places_;
  }

 private:
  SobolPoint numbers(const Walker& walker, std::uint32_t depth, std::uint32_t decision) const {
    return sobol_point(walker.number, hash_bits(world_.scene.settings.seed, depth * 16 + decision));
  }

  void start(std::uint32_t first, std::uint32_t end) {
    walkers_.assign(end - first, {});
    const auto [width, height] = world_.scene.settings.resolution;
    for (std::uint32_t i = first; i < end; ++i) {
      Walker& walker = walkers_[i - first];
      walker.number = i;
      const SobolPoint u = numbers(walker, 0, 0), v = numbers(walker, 0, 1);
      const float x = u[0] * static_cast<float>(width), y = u[1] * static_cast<float>(height);
      const int column = std::min(static_cast<int>(x), width - 1),
                row = std::min(static_cast<int>(y), height - 1);
      const double time = world_.features.motion ? world_.scene.animation.shutter_curve.moment(v[0]) : 0;
      walker.ray = camera_.ray(column, row, x - std::floor(x), y - std::floor(y), v[1], v[2], time);
    }
  }

  void trace(std::uint32_t depth) {
    const compile::RayKind kind = depth == 0 ? compile::RayKind::camera : compile::RayKind::scattered;
    requests_.clear();
    for (Walker& walker : walkers_) {
      walker.hit = world_.features.walks_surfaces()
                       ? trace_through(world_, walker.ray, kind, thread_, walker.crossings)
                       : world_.closest_hit(walker.ray, kind);
      walker.march.crossings.clear();
      for (const Crossing& c : walker.crossings)
        walker.march.crossings.push_back({c.t, 1 - c.surface.opacity});
      walker.ray.t_max = walker.hit ? walker.hit->t : infinity;
      requests_.push_back({walker.ray, kind, static_cast<std::uint32_t>(hash_bits(walker.number, depth)),
                           &walker.march, false});
    }
    marcher_.march(world_, requests_, thread_);
  }

  // Notes where the ray is lit, and draws the next one; false when there is none.
  bool advance(Walker& walker, std::uint32_t depth) {
    const SobolPoint u = numbers(walker, depth, 2), v = numbers(walker, depth, 3);
    const March& march = walker.march;
    const DensityDistribution density(march, walker.throughput);
    double in_media = 0, on_surface = 0;
    if (march.scatters() && density.available()) {
      in_media = luminance(march.total_scattered());
      const std::uint32_t count = depth == 0 ? places_on_camera_rays : 1;
      for (std::uint32_t k = 0; k < count; ++k) {
        const MarchPlace at = density.sample((static_cast<float>(k) + v[4]) / static_cast<float>(count));
        places_.push_back({march.ray.origin + march.ray.direction * at.t, {}, {}, false, walker.ray.time});
      }
    }
    std::optional<SurfacePoint> surface;
    if (walker.hit && walker.hit->light == compile::no_index) {
      surface = evaluate_surface(world_, *walker.hit, walker.ray.direction, thread_);
      on_surface = luminance(march.end_transmittance() * surface->reflectance) * surface->opacity;
      if (!surface->only_deltas)
        places_.push_back({surface->offset_position, surface->normal, surface->behind_position,
                           surface->transmits, walker.ray.time});
    }
    const double both = in_media + on_surface;
    if (!(u[6] < std::min(both, 1.0))) return false;
    if (v[5] * both < in_media) return scatter(walker, density.sample(u[2]), u);
    const auto next = surface->sample(u[2], u[0], u[1], u[3]);
    if (!next) return false;
    walker.ray = {surface->start(next->direction), next->direction, infinity, walker.ray.time};
    return true;
  }

  bool scatter(Walker& walker, const MarchPlace& at, const SobolPoint& u) {
    const PhaseMixture phase(world_, walker.march, at.segment);
    const Vec3f w = optics::rotate_from(Vec3f(walker.ray.direction), phase.sample(u[4], u[0], u[5]),
                                        static_cast<float>(2 * pi) * u[1]);
    walker.ray = {walker.ray.origin + walker.ray.direction * at.t, normalize(Vec3d(w)), infinity,
                  walker.ray.time};
    return true;
  }

  const compile::CompiledScene& world_;
  CameraRays camera_;
  ThreadContext thread_;
  RayMarcher marcher_;
  std::vector<Walker> walkers_;
  std::vector<MarchRequest> requests_;
  std::vector<LightPlace> places_;
};

}  // namespace

std::vector<LightPlace> light_places(const compile::CompiledScene& world, int threads) {
  const auto [width, height] = world.scene.settings.resolution;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t paths = std::clamp(pixels / pixels_a_path, least_paths, most_paths);
  std::vector<std::vector<LightPlace>> parts((paths + paths_together - 1) / paths_together);
  parallel_for(parts.size(), threads, [&](std::size_t i, int) {
    const std::size_t end = std::min((i + 1) * paths_together, paths);
    parts[i] =
        Walk(world).run(static_cast<std::uint32_t>(i * paths_together), static_cast<std::uint32_t>(end));
  });
  std::vector<LightPlace> all;
  for (const std::vector<LightPlace>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace tyndall::render
