// Boundaries that let light through: glass with its inside, and panes.
#include "base/numerics.h"
#include "optics/lobes.h"
#include "optics/microfacet.h"

namespace tyndall::optics {

namespace {

// D G2 / (4 o.z i.z) · i.z of reflecting microfacets.
double reflection_shape(const Vec3d& m, const Vec3d& o, double i_z, double alpha) {
  return ggx_density(m, alpha) * i_z / (2 * (o.z * slope_root(i_z, alpha) + i_z * slope_root(o.z, alpha)));
}
// Density of visible normals over w·m: G1 D / w.z.
double visible_density(const Vec3d& m, const Vec3d& o, double alpha) {
  return 2 * ggx_density(m, alpha) / (o.z + slope_root(o.z, alpha));
}

// The microfacet that refracts o to i, turned to o's side; nothing when none does.
std::optional<Vec3d> refracting_normal(const Vec3d& o, const Vec3d& i, double eta) {
  Vec3d m = o + i * eta;
  const double length2 = length_squared(m);
  if (!(length2 > 0)) return std::nullopt;
  m /= std::copysign(std::sqrt(length2), m.z);
  if (!(dot(o, m) > 0 && dot(i, m) < 0)) return std::nullopt;
  return m;
}

// Multiple scattering between the microfacets of a boundary (Kulla and Conty 2017, "Dielectrics"): what
// single scattering loses leaves diffusely, the share `transmitted` through the boundary. The share is that
// of smooth boundaries for diffuse light, lowered on the side that loses less, which keeps the pair of both
// sides reciprocal: t(1/η) (1 − E(1/η)) = t(η) (1 − E(η)) / η².
struct Lost {
  double here = 0, average_here = 1, average_behind = 1, transmitted = 0;
  Lost(const AlbedoTables& tables, const Vec3d& o, double roughness, double eta)
      : here(1 - tables.glass(o.z, roughness, eta)),
        average_here(1 - tables.glass_average(roughness, eta)),
        average_behind(1 - tables.glass_average(roughness, 1 / eta)) {
    here = std::max(here, 0.0);
    if (average_here > 0)
      transmitted = tables.transmitted_average(eta) * std::min(1.0, average_behind / average_here);
  }
};

}  // namespace

// ----------------------------------------------------------------------------------------------------- glass

bool Glass::matched() const { return std::abs(eta - 1) < matched_eta; }

Rgb Glass::value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const {
  if (delta() || i.z == 0) return {};
  const double alpha = alpha_of(roughness);
  const Lost lost(tables, o, roughness, eta);
  if (i.z > 0) {
    const Vec3d m = normalize(o + i);
    double value = reflection_shape(m, o, i.z, alpha) * fresnel(dot(o, m), eta);
    if (lost.average_here > 0)
      value += (1 - lost.transmitted) * lost.here * std::max(0.0, 1 - tables.glass(i.z, roughness, eta)) /
               (pi * lost.average_here) * i.z;
    return Rgb(static_cast<float>(value));
  }
  double value = 0;
  if (const auto m = refracting_normal(o, i, eta)) {
    const double om = dot(o, *m), im = -dot(i, *m);
    value = visible_density(*m, o, alpha) * ggx_visible(-i.z, alpha) * (1 - fresnel(om, eta)) * im * om /
            sqr(om - eta * im);
  }
  if (lost.average_behind > 0)
    value += lost.transmitted * lost.here * std::max(0.0, 1 - tables.glass(-i.z, roughness, 1 / eta)) /
             (pi * lost.average_behind) * -i.z / sqr(eta);
  return tint * static_cast<float>(value);
}

double Glass::pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const {
  if (delta() || i.z == 0) return 0;
  const double alpha = alpha_of(roughness);
  const Lost lost(tables, o, roughness, eta);
  double single = 0;
  if (i.z > 0) {
    const Vec3d m = normalize(o + i);
    single = 0.25 * visible_density(m, o, alpha) * fresnel(dot(o, m), eta);
  } else if (const auto m = refracting_normal(o, i, eta)) {
    const double om = dot(o, *m), im = -dot(i, *m);
    single = visible_density(*m, o, alpha) * om * (1 - fresnel(om, eta)) * im / sqr(im - om / eta);
  }
  const double side = i.z > 0 ? 1 - lost.transmitted : lost.transmitted;
  return (1 - lost.here) * single + lost.here * side * std::abs(i.z) / pi;
}

std::optional<LobeSample> Glass::sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                        double u2) const {
  if (matched()) return LobeSample{-o, tint};
  if (is_smooth(roughness)) {
    const double F = fresnel(o.z, eta);
    if (u2 < F) return LobeSample{{-o.x, -o.y, o.z}, Rgb(1)};
    return LobeSample{refracted(o, {0, 0, 1}, eta), tint * static_cast<float>(1 / sqr(eta))};
  }
  const Lost lost(tables, o, roughness, eta);
  if (u2 < lost.here) {
    Vec3d i = sample_cosine_hemisphere(u0, u1);
    if (u2 < lost.here * lost.transmitted) i.z = -i.z;
    return LobeSample{i, {}};
  }
  u2 = (u2 - lost.here) / (1 - lost.here);
  const Vec3d m = sample_visible_normal(o, alpha_of(roughness), u0, u1);
  const bool reflects = u2 < fresnel(dot(o, m), eta);
  const Vec3d i = reflects ? normalize(mirrored(o, m)) : refracted(o, m, eta);
  if (reflects != (i.z > 0)) return std::nullopt;
  return LobeSample{i, {}};
}

Rgb Glass::albedo(const AlbedoTables&, const Vec3d& o) const {
  if (matched()) return tint;
  const auto F = static_cast<float>(fresnel(o.z, eta));
  return Rgb(F) + tint * (1 - F);
}

// ------------------------------------------------------------------------------------------------------ pane

namespace {

// Reflectance of both faces with all the light between them: R + T²R + T²R³ + …
double pane_reflectance(double cosine, double eta) {
  const double F = fresnel(std::min(cosine, 1.0), eta);
  return 2 * F / (1 + F);
}

// The mean over diffuse light by 8 midpoints: the share that multiple scattering sends back. Any share
// conserves energy.
double average_pane_reflectance(double eta) {
  double sum = 0;
  for (int k = 0; k < 8; ++k) sum += pane_reflectance((k + 0.5) / 8, eta) * (k + 0.5) / 8;
  return 2 * sum / 8;
}

}  // namespace

Rgb Pane::value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const {
  if (is_smooth(roughness) || i.z == 0) return {};
  const double alpha = alpha_of(roughness);
  const Vec3d reflected{i.x, i.y, std::abs(i.z)};
  const Vec3d m = normalize(o + reflected);
  const double R = pane_reflectance(dot(o, m), eta), R_lost = average_pane_reflectance(eta);
  const double average = 1 - tables.reflection_average(roughness).white();
  double lost = 0;
  if (average > 0)
    lost = (1 - tables.reflection(o.z, roughness).white()) *
           (1 - tables.reflection(reflected.z, roughness).white()) / (pi * average) * reflected.z;
  const double shape = reflection_shape(m, o, reflected.z, alpha);
  if (i.z > 0) return Rgb(static_cast<float>(shape * R + lost * R_lost));
  return tint * static_cast<float>(shape * (1 - R) + lost * (1 - R_lost));
}

double Pane::pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const {
  if (is_smooth(roughness) || i.z == 0) return 0;
  const Vec3d reflected{i.x, i.y, std::abs(i.z)};
  const Vec3d m = normalize(o + reflected);
  const double R = pane_reflectance(dot(o, m), eta), R_lost = average_pane_reflectance(eta);
  const double single = 0.25 * visible_density(m, o, alpha_of(roughness));
  const double share = tables.reflection(o.z, roughness).white(), lost = (1 - share) * reflected.z / pi;
  return i.z > 0 ? share * single * R + lost * R_lost : share * single * (1 - R) + lost * (1 - R_lost);
}

std::optional<LobeSample> Pane::sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                       double u2) const {
  if (is_smooth(roughness)) {
    if (u2 < pane_reflectance(o.z, eta)) return LobeSample{{-o.x, -o.y, o.z}, Rgb(1)};
    return LobeSample{-o, tint};
  }
  const double share = tables.reflection(o.z, roughness).white();
  Vec3d i;
  double R = 0;
  if (u2 < share) {
    const Vec3d m = sample_visible_normal(o, alpha_of(roughness), u0, u1);
    i = normalize(mirrored(o, m));
    R = pane_reflectance(dot(o, m), eta);
    u2 /= share;
  } else {
    i = sample_cosine_hemisphere(u0, u1);
    R = average_pane_reflectance(eta);
    u2 = (u2 - share) / (1 - share);
  }
  if (!(i.z > 0)) return std::nullopt;
  if (u2 >= R) i.z = -i.z;
  return LobeSample{i, {}};
}

Rgb Pane::albedo(const AlbedoTables&, const Vec3d& o) const {
  const auto R = static_cast<float>(pane_reflectance(o.z, eta));
  return Rgb(R) + tint * (1 - R);
}

}  // namespace tyndall::optics
