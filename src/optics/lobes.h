// The lobes of surfaces: each a way in which light leaves a surface, as a plain struct in one variant.
//
// All directions are in the frame of the surface, unit, and point away from it; +z is the normal on the side
// of `o`, from which the ray came. `value` is the BSDF times |i.z|, for radiance that arrives from i and
// leaves to o: through a boundary to glass of relative index η it holds the factor 1/η² of basic radiance.
#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "base/vec.h"
#include "optics/albedo_tables.h"

namespace tyndall::optics {

// Roughness below this is 0: a mirror, whose lobes are deltas. (Its highlights are 1e-6 wide.)
inline constexpr double smooth_roughness = 1e-3;
inline bool is_smooth(double roughness) { return roughness < smooth_roughness; }
// An index closer to 1 than this bends nothing: the boundary is not there.
inline constexpr double matched_eta = 1e-4;

// Nothing was sampled where a microfacet sends light into its neighbours.
struct LobeSample {
  Vec3d direction;
  // Set for a delta: what the direction carries, over the probability with which it was chosen.
  std::optional<Rgb> delta_weight;
};

// Lambert's: white, the colour is the layer's weight.
struct Diffuse {
  double value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  double pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  std::optional<LobeSample> sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                   double u2) const;
  double albedo(const AlbedoTables& tables, const Vec3d& o) const;
};

// Fibres that stand off the surface, seen at grazing angles.
struct Sheen {
  double value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  double pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  std::optional<LobeSample> sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                   double u2) const;
  double albedo(const AlbedoTables& tables, const Vec3d& o) const;
};

// A mirror, polished or of GGX microfacets, with Schlick's Fresnel reflectance: metal, lacquer, plastic.
struct Reflection {
  Rgb f0{0.04f};
  double roughness = 0;
  // Gives back what single scattering between microfacets loses. Off where a layer below takes the rest.
  bool compensated = false;

  Rgb value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  double pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  std::optional<LobeSample> sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                   double u2) const;
  Rgb albedo(const AlbedoTables& tables, const Vec3d& o) const;
};

// A boundary between two clear media, smooth or of GGX microfacets: reflects and refracts (Walter et al.
// 2007). `eta` is the index of the other side over that of o's. `tint` colours what goes through.
struct Glass {
  double eta = 1.5, roughness = 0;
  Rgb tint{1};

  Rgb value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  double pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  std::optional<LobeSample> sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                   double u2) const;
  Rgb albedo(const AlbedoTables& tables, const Vec3d& o) const;

  bool matched() const;
  bool delta() const { return is_smooth(roughness) || matched(); }
};

// A sheet of glass without thickness: both faces in one, light goes straight on (through rough ones,
// scattered about that).
struct Pane {
  double eta = 1.5, roughness = 0;
  Rgb tint{1};

  Rgb value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  double pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const;
  std::optional<LobeSample> sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                   double u2) const;
  Rgb albedo(const AlbedoTables& tables, const Vec3d& o) const;
};

using Lobe = std::variant<Diffuse, Sheen, Reflection, Glass, Pane>;

// Whether the lobe is a delta: of value and pdf 0 in every direction that was not sampled from it.
bool is_delta(const Lobe& lobe);
std::string_view name(const Lobe& lobe);

// Directions by cosine: the density is cosine / π.
Vec3d sample_cosine_hemisphere(double u0, double u1);

}  // namespace tyndall::optics
