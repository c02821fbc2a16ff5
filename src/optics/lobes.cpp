// Diffuse, sheen and reflection lobes; glass is in glass.cpp.
#include "optics/lobes.h"

#include "base/numerics.h"
#include "base/overloaded.h"
#include "optics/microfacet.h"

namespace tyndall::optics {

namespace {

constexpr double inv_pi = 1 / pi;

// The part of samples that single scattering gets, of those that multiple scattering gets the rest.
double single_share(const AlbedoTables& tables, double cosine, double roughness) {
  return tables.reflection(cosine, roughness).white();
}

}  // namespace

Vec3d sample_cosine_hemisphere(double u0, double u1) {
  const double r = std::sqrt(u0), phi = 2 * pi * u1;
  return {r * std::cos(phi), r * std::sin(phi), safe_sqrt(1 - u0)};
}

// --------------------------------------------------------------------------------------------------- diffuse

double Diffuse::value(const AlbedoTables&, const Vec3d&, const Vec3d& i) const {
  return i.z > 0 ? i.z * inv_pi : 0.0;
}
double Diffuse::pdf(const AlbedoTables&, const Vec3d&, const Vec3d& i) const {
  return i.z > 0 ? i.z * inv_pi : 0.0;
}
std::optional<LobeSample> Diffuse::sample(const AlbedoTables&, const Vec3d&, double u0, double u1,
                                          double) const {
  return LobeSample{sample_cosine_hemisphere(u0, u1), {}};
}
double Diffuse::albedo(const AlbedoTables&, const Vec3d&) const { return 1; }

// ----------------------------------------------------------------------------------------------------- sheen

double Sheen::value(const AlbedoTables&, const Vec3d& o, const Vec3d& i) const {
  return i.z > 0 ? sheen_lobe(normalize(o + i).z, o.z, i.z) * i.z : 0.0;
}
double Sheen::pdf(const AlbedoTables&, const Vec3d&, const Vec3d& i) const {
  return i.z > 0 ? 0.5 * inv_pi : 0.0;
}
std::optional<LobeSample> Sheen::sample(const AlbedoTables&, const Vec3d&, double u0, double u1,
                                        double) const {
  const double r = safe_sqrt(1 - u0 * u0), phi = 2 * pi * u1;
  return LobeSample{{r * std::cos(phi), r * std::sin(phi), u0}, {}};
}
double Sheen::albedo(const AlbedoTables& tables, const Vec3d& o) const { return tables.sheen(o.z); }

// ------------------------------------------------------------------------------------------------ reflection

// D G2 / (4 o.z i.z) · i.z with Smith's height-correlated G2 written so that nothing is divided by o.z.
Rgb Reflection::value(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const {
  if (!(i.z > 0) || is_smooth(roughness)) return {};
  const double alpha = alpha_of(roughness);
  const Vec3d m = normalize(o + i);
  const double shape =
      ggx_density(m, alpha) * i.z / (2 * (o.z * slope_root(i.z, alpha) + i.z * slope_root(o.z, alpha)));
  const auto weight = static_cast<float>(schlick(std::min(1.0, dot(o, m))));
  Rgb value = (f0 + (Rgb(1) - f0) * weight) * static_cast<float>(shape);
  if (compensated) {
    const double average = tables.reflection_average(roughness).white();
    if (average >= 1) return value;
    const double lost = (1 - single_share(tables, o.z, roughness)) *
                        (1 - single_share(tables, i.z, roughness)) / (pi * (1 - average)) * i.z;
    // Light that stays inside bounces with the mean Fresnel reflectance each time (Kulla and Conty 2017).
    for (std::size_t c = 0; c < 3; ++c) {
      const double f = f0[c] + (1 - double{f0[c]}) / 21;
      value[c] += static_cast<float>(f * f * average / (1 - f * (1 - average)) * lost);
    }
  }
  return value;
}

double Reflection::pdf(const AlbedoTables& tables, const Vec3d& o, const Vec3d& i) const {
  if (!(i.z > 0) || is_smooth(roughness)) return 0;
  const double alpha = alpha_of(roughness);
  const double single = ggx_density(normalize(o + i), alpha) / (2 * (o.z + slope_root(o.z, alpha)));
  if (!compensated) return single;
  const double share = single_share(tables, o.z, roughness);
  return share * single + (1 - share) * i.z * inv_pi;
}

std::optional<LobeSample> Reflection::sample(const AlbedoTables& tables, const Vec3d& o, double u0, double u1,
                                             double u2) const {
  if (is_smooth(roughness)) {
    const auto weight = static_cast<float>(schlick(std::min(1.0, o.z)));
    return LobeSample{{-o.x, -o.y, o.z}, f0 + (Rgb(1) - f0) * weight};
  }
  if (compensated && u2 >= single_share(tables, o.z, roughness))
    return LobeSample{sample_cosine_hemisphere(u0, u1), {}};
  const Vec3d i = normalize(mirrored(o, sample_visible_normal(o, alpha_of(roughness), u0, u1)));
  if (!(i.z > 0)) return std::nullopt;
  return LobeSample{i, {}};
}

Rgb Reflection::albedo(const AlbedoTables& tables, const Vec3d& o) const {
  const AlbedoTables::Reflection e = tables.reflection(o.z, is_smooth(roughness) ? 0 : roughness);
  Rgb albedo = f0 * static_cast<float>(e.scale) + Rgb(static_cast<float>(e.bias));
  if (compensated && !is_smooth(roughness)) {
    const double average = tables.reflection_average(roughness).white();
    for (std::size_t c = 0; c < 3; ++c) {
      const double f = f0[c] + (1 - double{f0[c]}) / 21;
      albedo[c] += static_cast<float>(f * f * average / (1 - f * (1 - average)) * (1 - e.white()));
    }
  }
  return albedo;
}

// ---------------------------------------------------------------------------------------------------- family

bool is_delta(const Lobe& lobe) {
  return std::visit(Overloaded{[](const Diffuse&) { return false; }, [](const Sheen&) { return false; },
                               [](const Reflection& l) { return is_smooth(l.roughness); },
                               [](const Glass& l) { return l.delta(); },
                               [](const Pane& l) { return is_smooth(l.roughness); }},
                    lobe);
}

std::string_view name(const Lobe& lobe) {
  return std::visit(Overloaded{[](const Diffuse&) { return "diffuse"; }, [](const Sheen&) { return "sheen"; },
                               [](const Reflection&) { return "reflection"; },
                               [](const Glass&) { return "glass"; }, [](const Pane&) { return "pane"; }},
                    lobe);
}

}  // namespace tyndall::optics
