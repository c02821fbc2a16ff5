// How much of the light from one direction rough surfaces return, tabulated: what layers take from those
// below, and what single scattering between microfacets loses, which multiple scattering gives back
// (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017).
//
// Averages are those of the interpolants themselves (2 ∫ E(μ) μ dμ), so that a lobe normalised by one
// conserves energy whatever the tables' own error.
#pragma once

#include <span>
#include <vector>

namespace tyndall::optics {

// Of a sheet of fibres, whose roughness is fixed: there is no output for it.
inline constexpr double sheen_roughness = 0.3;

// Density times visibility of the fibres: the sheen lobe without its colour, per steradian. Estevez and
// Kulla, "Production Friendly Microfacet Sheen BRDF" (Imageworks 2017), with the visibility of Neubelt and
// Pettineo 2013.
double sheen_lobe(double cosine_m, double cosine_o, double cosine_i);

class AlbedoTables {
 public:
  // `glass_etas`: the relative indices of rough glass that will be asked for (of either side: 1/η comes with
  // η). Takes some tens of milliseconds, and as long again for each of them.
  explicit AlbedoTables(std::span<const double> glass_etas);

  // Directional albedo E(μ) of reflecting microfacets whose Fresnel reflectance is Schlick's:
  // scale · F0 + bias. White ones: scale + bias.
  struct Reflection {
    double scale = 0, bias = 0;
    double white() const { return scale + bias; }
  };
  Reflection reflection(double cosine, double roughness) const;
  Reflection reflection_average(double roughness) const;

  double sheen(double cosine) const;

  // Of a boundary to glass: reflected and refracted light after one scattering between microfacets.
  double glass(double cosine, double roughness, double eta) const;
  double glass_average(double roughness, double eta) const;
  // 1 − 2 ∫ F(μ) μ dμ of a smooth boundary: what it lets through of diffuse light. For 1/η it is 1/η² of that
  // for η, exactly.
  double transmitted_average(double eta) const;

 private:
  struct GlassTable {
    double eta = 1;
    std::vector<double> albedo, average;
    double transmitted_average = 1;
  };
  const GlassTable& glass_of(double eta) const;

  std::vector<double> scale_, bias_, scale_average_, bias_average_, sheen_;
  std::vector<GlassTable> glass_;  // by eta, rising
};

}  // namespace tyndall::optics
