// What the reference renderer asks of a scene: plain loops over analytic shapes, in world space and double.
#pragma once

#include <optional>
#include <vector>

#include "base/interval.h"
#include "base/vec.h"
#include "scene/scene.h"

namespace tyndall::reference {

struct Ray {
  Vec3d origin, direction;  // world space; unit direction
  bool camera = false;      // invisible things are not there for camera rays
};

struct Surface {
  double t = 0;
  Vec3d position, normal;  // unit, outward
  Rgb reflectance, emission;
};

// One volume's medium at a point. Coefficients per metre of world space.
struct MediumPoint {
  Vec3d sigma_s, sigma_t, emission;
  struct Lobe {
    optics::Phase phase;
    double weight = 1;
  };
  std::vector<Lobe> lobes;
};

// What an area light emits; of spheres, quads and disks only.
Vec3d radiance_of(const scene::AreaLight& light);

class World {
 public:
  explicit World(const scene::Scene& scene);

  const scene::Scene& scene() const { return scene_; }

  // The nearest shape in (t_min, t_max).
  std::optional<Surface> nearest_surface(const Ray& ray, double t_min, double t_max) const;
  bool occluded(const Ray& ray, double t_min, double t_max) const;
  // The part of [0, t_max) outside which there is no volume: a hull, maybe with holes.
  Intervald volume_hull(const Ray& ray, double t_max) const;
  // Every medium at a point, one entry for each volume that holds it.
  void media_at(const Vec3d& position, bool camera, std::vector<MediumPoint>& out) const;

  // The nearest point in (t_min, t_max) of an area light; black on the side that does not shine.
  struct LightHit {
    double t = 0;
    Vec3d radiance;
  };
  std::optional<LightHit> nearest_light(const Ray& ray, double t_min, double t_max) const;

 private:
  struct Placed {
    Transform world_from_object, object_from_world;
  };
  const scene::Scene scene_;              // with the instances written out
  std::vector<Placed> shapes_, volumes_;  // of the shape
  std::vector<Transform> media_;          // medium_from_world
};

}  // namespace tyndall::reference
