// Direct light of the methods that follow a ray to one point: where its free path collides, and where it was
// aimed, weighted over all strategies that share the ray's null collisions (Miller, Georgiev and Jarosz 2019;
// transport §4).
#pragma once

#include <optional>

#include "render/distance/distance_mixture.h"
#include "render/method/medium_ray.h"

namespace tyndall::render {

class FreePathLight {
 public:
  // `aims`: free paths are aimed at points that are chosen for a light.
  FreePathLight(Distance distance, bool aims) : distance_(distance), aims_(aims) {}

  // Chooses a light and a point of the ray for it, before the free path is sampled.
  void aim(const SobolPoint& point, MediumRay& ray);
  // Afterwards: light at that point, and where the free path collided.
  void sample_aimed(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows);
  void sample_collision(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows);
  double pdf_light(const LitRay& ray, const LightHit& hit);

 private:
  // Density of aiming at t for a light, and that of taking it at a collision.
  struct Densities {
    double aimed = 0, collision = 0;
  };
  // Where a light is taken at: its share of the path's weight, and the densities of all ways to get there.
  struct Place {
    double t = 0;
    Rgb weight;
    double own_density = 0;
    Densities densities;
    double collision = 0;  // density of the collision there
  };
  bool prepare(const LitRay& ray, const ChosenLight& light);
  Densities densities(const LitRay& ray, const ChosenLight& light, double t, double collision);
  void add(const LitRay& ray, const ChosenLight& light, const Place& place, const LightRequest& request,
           ShadowBatch& shadows) const;

  Distance distance_;
  bool aims_;
  std::vector<Intervald> lit_;
  std::optional<Equiangular> equiangular_;
};

// What the methods have in common that sample free paths: light is readied before the free path, and taken at
// its ends.
class FreePathMethod {
 public:
  void prepare_light(const compile::CompiledScene&, const Rgb&, std::span<const ScatteringOrder>,
                     MediumRay&) const {}
  void sample_light(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) {
    light_.sample_collision(ray, request, shadows);
  }
  void sample_aimed_light(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) {
    light_.sample_aimed(ray, request, shadows);
  }
  double pdf_light(const LitRay& ray, const LightHit& hit) { return light_.pdf_light(ray, hit); }
  Scattering scatter(const MediumRay& ray, float, double) const {
    const FreePath& f = ray.free_path;
    return {f.t, ray.march.segment_at(f.t), f.density, f.weight};
  }

 protected:
  FreePathMethod(Distance distance, bool aims) : light_(distance, aims) {}
  FreePathLight light_;
};

}  // namespace tyndall::render
