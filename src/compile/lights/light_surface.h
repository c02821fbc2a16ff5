// The surfaces of area lights, by shape: how points of them, or directions to them, are drawn.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <variant>

#include "compile/lights/light_roles.h"
#include "optics/emitter.h"

namespace tyndall::compile {

// A direction from a point x to a surface.
struct SurfaceSample {
  Vec3d direction;  // unit
  double distance = 0;
  double weight = 0;  // 1 / pdf_solid_angle
  double pdf_solid_angle = 0;
};

// Each surface has, in render space: area() [m²], sample_pivot, sample, pdf, reached_parts and shadow_margin
// as lights have them (light_roles.h); center() and radius() of a ball for importance; brightest(L), the
// greatest mean intensity in any direction of a mean radiance L [W/sr]; bounds(intensity).

// Seen from outside; drawn from uniformly over the solid angle that it fills.
class SphereSurface {
 public:
  static constexpr bool pivot_on_surface = false;
  explicit SphereSurface(const scene::Sphere& s) : center_(s.center), radius_(s.radius) {}

  double area() const { return 4 * pi * sqr(radius_); }
  std::optional<optics::Pivot> sample_pivot(float, float) const { return optics::Pivot{center_}; }
  std::optional<SurfaceSample> sample(const Vec3d& x, const optics::Pivot&, float u0, float u1) const;
  double pdf(const Vec3d& x, const Vec3d& direction, const Vec3d& y, const Vec3d& normal) const;
  optics::ReachedParts reached_parts(const optics::Pivot&, const Vec3d& origin, const Vec3d& direction,
                                     double t_max) const;
  std::optional<double> shadow_margin() const { return std::nullopt; }
  const Vec3d& center() const { return center_; }
  double radius() const { return radius_; }
  double brightest(double mean_radiance) const { return mean_radiance * pi * sqr(radius_); }
  optics::LightBounds bounds(double intensity) const {
    return optics::bounds_around(center_, Vec3d(radius_), intensity);
  }

 private:
  Vec3d center_;
  double radius_;
};

// Flat, and drawn from uniformly over its area.
class FlatSurface {
 public:
  static constexpr bool pivot_on_surface = true;

  double area() const { return area_; }
  std::optional<SurfaceSample> sample(const Vec3d& x, const optics::Pivot& y, float, float) const;
  double pdf(const Vec3d& x, const Vec3d& direction, const Vec3d& y, const Vec3d& normal) const;
  optics::ReachedParts reached_parts(const optics::Pivot&, const Vec3d& origin, const Vec3d& direction,
                                     double t_max) const {
    return optics::reached_in_front(center_, normal_, origin, direction, t_max);
  }
  std::optional<double> shadow_margin() const { return std::nullopt; }
  const Vec3d& center() const { return center_; }

 protected:
  FlatSurface(const Vec3d& center, const Vec3d& normal, double area, const Vec3d& area_vector)
      : center_(center), normal_(normal), area_vector_(area_vector), area_(area) {}

  Vec3d center_, normal_;  // of any length
  Vec3d area_vector_;      // along it, as long as the area
  double area_;
};

class QuadSurface : public FlatSurface {
 public:
  explicit QuadSurface(const scene::Quad& quad);
  std::optional<optics::Pivot> sample_pivot(float u0, float u1) const {
    return optics::Pivot{center_ + u_ * (2.0 * u0 - 1) + v_ * (2.0 * u1 - 1)};
  }
  double radius() const { return std::sqrt(length_squared(u_) + length_squared(v_)); }
  double brightest(double mean_radiance) const { return mean_radiance * area_; }
  optics::LightBounds bounds(double intensity) const;

 private:
  Vec3d u_, v_;  // half edges
};

class DiskSurface : public FlatSurface {
 public:
  explicit DiskSurface(const scene::Disk& disk);
  std::optional<optics::Pivot> sample_pivot(float u0, float u1) const;
  double radius() const { return radius_; }
  double brightest(double mean_radiance) const { return mean_radiance * pi * sqr(radius_); }
  optics::LightBounds bounds(double intensity) const {
    return optics::bounds_facing(center_, Vec3d(radius_), intensity, normal_, pi / 2);
  }

 private:
  double radius_;
  Frame<double> frame_;  // around the normal
};

// Any shape with an end: drawn from over its area (optics::Emitter).
class AnySurface {
 public:
  static constexpr bool pivot_on_surface = true;
  // `error`: how far off it a hit may be [m].
  AnySurface(std::shared_ptr<const optics::Emitter> emitter, double error, bool both_sides)
      : emitter_(std::move(emitter)), error_(error), both_sides_(both_sides) {}

  double area() const { return emitter_ ? emitter_->area() : 0; }
  std::optional<optics::Pivot> sample_pivot(float u0, float u1) const;
  std::optional<SurfaceSample> sample(const Vec3d& x, const optics::Pivot& y, float, float) const;
  double pdf(const Vec3d& x, const Vec3d& direction, const Vec3d& y, const Vec3d& normal) const;
  // The front side at the pivot.
  optics::ReachedParts reached_parts(const optics::Pivot& pivot, const Vec3d& origin, const Vec3d& direction,
                                     double t_max) const {
    return both_sides_ ? optics::whole_ray(t_max)
                       : optics::reached_in_front(pivot.position, pivot.normal, origin, direction, t_max);
  }
  std::optional<double> shadow_margin() const { return 2 * error_; }
  bool both_sides() const { return both_sides_; }
  const Vec3d& center() const { return emitter_->center(); }
  double radius() const { return emitter_->radius(); }
  // A convex shape shows about a quarter of its area to any side.
  double brightest(double mean_radiance) const { return mean_radiance * area() / 2; }
  optics::LightBounds bounds(double intensity) const {
    return optics::bounds_around(center(), Vec3d(radius()), intensity);
  }

 private:
  std::shared_ptr<const optics::Emitter> emitter_;  // null: nothing of it can be drawn
  double error_;
  bool both_sides_;
};

// The surface of a shape where it stands in render space, whose zero is at `origin` of the world.
AnySurface any_surface(const scene::Scene& scene, const scene::Shape& shape,
                       const Transform& render_from_shape, const Vec3d& origin, bool both_sides = false);

using LightSurface = std::variant<SphereSurface, QuadSurface, DiskSurface, AnySurface>;

// Of a light in render space: uniform over solid angles where there is a closed form, over the area
// otherwise.
LightSurface surface_of(const scene::Scene& scene, const scene::AreaLight& light, const Vec3d& origin);

}  // namespace tyndall::compile
