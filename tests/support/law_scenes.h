// The scenes of the published truths, shared by the tests of the renderer and of the reference.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "support/scene_builder.h"
#include "support/text.h"

namespace tyndall::support {

// A camera at the origin that looks along +z through one pixel too small to matter.
inline void look_along_z(SceneBuilder& builder) { builder.orthographic({0, 0, 0}, {0, 0, 1}, 1e-6); }

// Point light of 1 W/sr at (D, 0, z_l), a black wall at z = T, albedo 1, light scattered once.
struct Airlight {
  double sigma_t, D, zl, T;
  std::array<double, 3> radiance;  // for g = 0, 0.5, -0.3
};
inline constexpr std::array<float, 3> airlight_g{0, 0.5f, -0.3f};
inline constexpr Airlight airlight_rows[] = {
    {0.1, 1, 5, 10, {1.13752231e-02, 1.48936532e-02, 1.10143104e-02}},
    {0.5, 1, 2, 4, {1.85724913e-02, 2.15025780e-02, 1.47612631e-02}},
    {0.2, 0.1, 3, 8, {2.56231489e-01, 3.66437676e-01, 2.74084506e-01}},
};
inline SceneBuilder airlight(const Airlight& row, float g) {
  SceneBuilder builder;
  look_along_z(builder);
  MediumColors fog;
  fog.sigma_t = Rgb(static_cast<float>(row.sigma_t));
  fog.phase = g == 0 ? isotropic() : hg(g);
  builder.bounces(0)
      .volume(scene::Box{{-40, -40, -40}, {40, 40, 40}}, builder.constant(fog))
      .surface(scene::Plane{{0, 0, row.T}, {0, 0, -1}}, Rgb(0))
      .point_light({row.D, 0, row.zl}, Rgb(1));
  return builder;
}

// A ball in a white environment, framed by its square.
struct WhiteSphere {
  double tau, albedo, radiance;  // mean over the disc
};
inline constexpr WhiteSphere white_sphere_rows[] = {
    {0.5, 0, .52848}, {0.5, 0.5, .72417}, {0.5, 0.9, .93602}, {1, 0, .29700},
    {1, 0.5, .54226}, {1, 0.9, .87801},   {2, 0, .11355},     {2, 0.5, .34892},
    {2, 0.9, .78162}, {5, 0, .01999},     {5, 0.5, .20519},   {5, 0.9, .62348},
};
inline SceneBuilder white_sphere(const WhiteSphere& row) {
  SceneBuilder builder;
  builder.image(16, 16, 64).orthographic({0, 0, 5}, {0, 0, 0}, 2).environment(1);
  MediumColors ball;
  ball.sigma_t = Rgb(static_cast<float>(row.tau));
  ball.albedo = Rgb(static_cast<float>(row.albedo));
  builder.volume(scene::Sphere{{}, 1}, builder.constant(ball));
  return builder;
}
// The mean over the square, whose corners see the environment.
inline double white_sphere_square(const WhiteSphere& row) { return row.radiance * pi / 4 + (1 - pi / 4); }

// A wide slab of thickness 1 and optical thickness tau, lit by a white upper hemisphere; light that leaves
// downwards meets a black plane. Seen straight from above (R) or from below (T).
struct Slab {
  float g, albedo, tau;
  double R, T;            // of light from straight above
  double Rd = 0, Td = 0;  // of light from everywhere above
};
inline constexpr Slab slab_rows[] = {
    {0.0f, 0.5f, 0.5f, 0.07295, 0.67423, 0.10768, 0.53499},
    {0.0f, 0.5f, 2, 0.11283, 0.18932, 0.14509, 0.10706},
    {0.0f, 0.9f, 1, 0.26741, 0.59163, 0.35271, 0.47475},
    {0.0f, 0.9f, 5, 0.41254, 0.07665, 0.47634, 0.05342},
    {0.0f, 0.99f, 2, 0.49749, 0.46570, 0.58800, 0.37335},
    {0.0f, 1.0f, 2, 0.51751, 0.48249, 0.60994, 0.39006},
    {0.0f, 1.0f, 10, 0.85300, 0.14700, 0.88325, 0.11675},
    {0.75f, 0.9f, 1, 0.05595, 0.82792, 0.13836, 0.68855},
    {0.75f, 0.9f, 2, 0.09739, 0.66096, 0.19109, 0.50182},
    {0.75f, 0.99f, 10, 0.47257, 0.34001, 0.56788, 0.26270},
    {0.75f, 1.0f, 5, 0.37188, 0.62812, 0.50168, 0.49832},
};
// Half the width [m]. Light through the sides comes within 1/width of level, from depths where little is
// scattered or through many free paths: below 1e-4 of the picture.
constexpr double slab_half_width(bool marched) { return marched ? 30 : 100; }
enum class SlabView { reflection, transmission };
inline std::string describe(const Slab& row, SlabView view) {
  return "g " + short_number(row.g) + " c " + short_number(row.albedo) + " tau " + short_number(row.tau) +
         (view == SlabView::reflection ? " R" : " T");
}
// `profile`: a density whose integral over y in [0, 1] is 1; none for a constant.
inline SceneBuilder slab(const Slab& row, SlabView view, const Density& profile = {}) {
  SceneBuilder builder;
  if (view == SlabView::reflection)
    builder.orthographic({0, 2, 0}, {0, 1, 0}, 1e-3, {0, 0, 1});
  else
    builder.orthographic({0, -0.25, 0}, {0, 1, 0}, 1e-3, {0, 0, 1});
  MediumColors layer;
  layer.sigma_t = Rgb(row.tau);
  layer.albedo = Rgb(row.albedo);
  layer.phase = row.g == 0 ? isotropic() : hg(row.g);
  const scene::MediumId medium = profile ? builder.shader(layer, profile) : builder.constant(layer);
  const double width = slab_half_width(static_cast<bool>(profile));
  builder.volume(scene::Box{{-width, 0, -width}, {width, 1, width}}, medium)
      .surface(scene::Plane{{0, -0.5, 0}, {0, 1, 0}}, Rgb(0))
      .environment(1);
  return builder;
}

// Optical depths of known densities along one ray through the middle of its volume.
struct KnownDensity {
  std::string name;
  Density density;
  scene::Shape shape;
  Vec3d from, to;  // the camera, and a point that it looks at
  double tau;
  double total_variation;  // of the density along the ray [1/m]
};
inline std::vector<KnownDensity> known_densities() {
  std::vector<KnownDensity> list;
  const auto falloff = [](const Point& p) { return max(1.f - length(p), 0) * 3.f; };
  for (const auto& [b, tau] : {std::pair{0.0, 3.0}, {.25, 2.51784306}, {.5, 1.61035779}, {.75, 0.64213427}})
    list.push_back({"falloff, b " + short_number(b),
                    falloff,
                    scene::Sphere{{}, 1},
                    {b, 0, 3},
                    {b, 0, 0},
                    tau,
                    6 * (1 - b)});
  const auto gaussian = [](const Point& p) {
    const Expression r = length(p);
    return exp(r * r * -8.f) * 4.f;
  };
  for (const auto& [b, tau] : {std::pair{0.0, 2.50646950}, {.25, 1.52018345}, {.5, 0.33905477}})
    list.push_back({"gaussian, b " + short_number(b),
                    gaussian,
                    scene::Sphere{{}, 1},
                    {b, 0, 3},
                    {b, 0, 0},
                    tau,
                    8 * std::exp(-8 * b * b)});
  const auto fog = [](const Point& p) { return exp(p.y * -2.f); };
  const scene::Box layer{{-50, 0, -50}, {50, 2, 50}};
  list.push_back({"height fog, straight up", fog, layer, {0, -1, 0}, {0, 1, 1e-9}, 0.49084218, 1});
  list.push_back(
      {"height fog, at 60 degrees", fog, layer, {0, -1, 0}, {0, 0, std::sqrt(3.0)}, 0.98168436, 1});
  list.push_back({"3x²",
                  [](const Point& p) { return p.x * p.x * 3.f; },
                  scene::Box{{0, -1, -1}, {1, 1, 1}},
                  {-1, 0, 0},
                  {0, 0, 0},
                  1,
                  3});
  return list;
}
// Seen against a white environment through an absorbing volume.
inline SceneBuilder known_density(const KnownDensity& known) {
  SceneBuilder builder;
  MediumColors absorbing;
  absorbing.albedo = Rgb(0);
  const Vec3d along = normalize(known.to - known.from);
  builder.orthographic(known.from, known.to, 1e-6, std::abs(along.z) > 0.9 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1))
      .volume(known.shape, builder.shader(absorbing, known.density))
      .environment(1);
  return builder;
}

}  // namespace tyndall::support
