// A surface at a point: the layers that a material's outputs ask for, seen from one direction.
//
// From the top: sheen over coat over a blend of metal (by `metallic`) and of the rest; the rest blends glass
// (by `transmission`) and a matte ground under a clear gloss (`specular`). What a layer reflects is missing
// below it: the matte ground gets exactly what is left (Kelemen and Szirmay-Kalos 2001, so white stays
// white), other layers the smaller part of the two directions (Estevez and Kulla 2017), which keeps light
// paths reversible.
#pragma once

#include <array>
#include <optional>

#include "optics/lobes.h"

namespace tyndall::optics {

// The lacquer of `coat`: of index 1.5, and this rough unless it is told otherwise.
inline constexpr float nearly_polished = 0.03f;
inline constexpr double coat_f0 = 0.04;

// A material's outputs. `ior` is not among them: a surface knows the ratio of both its sides.
struct SurfaceParameters {
  Rgb base_color{0.8f};
  float metallic = 0, roughness = 0, specular = 0, transmission = 0, coat = 0;
  Rgb sheen{0};
  Rgb specular_color{1};  // times the gloss's reflectance at normal incidence, which stays below 1
  float coat_roughness = nearly_polished;

  // Nothing but the matte ground.
  bool diffuse() const {
    return metallic == 0 && specular == 0 && transmission == 0 && coat == 0 && is_black(sheen);
  }
};

struct SurfaceSample {
  Vec3d direction;
  Rgb weight;      // value / pdf
  double pdf = 0;  // per steradian; of no meaning for a delta
  bool delta = false;
};

// Directions as for lobes: in the surface's frame, +z on the side of `o`.
class SurfaceModel {
 public:
  // `eta`: index behind the surface over that before it. `sheet`: there is no inside, glass is a pane.
  // `tables` must stay; they hold glass if any roughness and transmission do.
  SurfaceModel(const AlbedoTables& tables, const SurfaceParameters& parameters, double eta, bool sheet,
               const Vec3d& o);

  // The BSDF times |i.z| without deltas, and the density of `sample` without deltas.
  Rgb value(const Vec3d& i) const;
  double pdf(const Vec3d& i) const;
  std::optional<SurfaceSample> sample(double u_layer, double u0, double u1, double u2) const;

  // All deltas: light cannot be sampled for it.
  bool only_deltas() const;
  bool transmits() const { return transmits_; }
  // About what part of the light from `o` is scattered on.
  const Rgb& albedo() const { return albedo_; }

 private:
  // What lies over a layer.
  enum class Under : std::uint8_t { nothing, sheen, coat, gloss };
  struct Layer {
    Lobe lobe;
    Rgb color{0};
    Under under = Under::nothing;
    double probability = 0;
  };
  // The parts of light at a cosine that come below sheen, coat and gloss, indexed by Under.
  std::array<double, 4> passed(double cosine) const;
  double share(const Layer& layer, const std::array<double, 4>& passed_i) const;
  void add(const Lobe& lobe, const Rgb& color, Under under);

  const AlbedoTables* tables_;
  SurfaceParameters parameters_;
  Rgb gloss_f0_;
  Vec3d o_;
  std::array<double, 4> passed_o_{};
  double gloss_passed_average_ = 1;
  std::array<Layer, 6> layers_;
  std::size_t count_ = 0;
  bool transmits_ = false;
  Rgb albedo_;
};

}  // namespace tyndall::optics
