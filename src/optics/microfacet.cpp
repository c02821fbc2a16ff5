#include "optics/microfacet.h"

namespace tyndall::optics {

double ggx_density(const Vec3d& m, double alpha) {
  const double stretched = (m.x * m.x + m.y * m.y) / sqr(alpha) + m.z * m.z;
  return 1 / (pi * sqr(alpha) * sqr(stretched));
}

double slope_root(double cosine, double alpha) {
  return std::sqrt(sqr(cosine) + sqr(alpha) * std::max(0.0, 1 - sqr(cosine)));
}

double ggx_visible(double cosine, double alpha) { return 2 * cosine / (cosine + slope_root(cosine, alpha)); }

Vec3d sample_visible_normal(const Vec3d& w, double alpha, double u0, double u1) {
  const Vec3d stretched = normalize(Vec3d{alpha * w.x, alpha * w.y, w.z});
  const double phi = 2 * pi * u0, z = (1 - u1) * (1 + stretched.z) - stretched.z, r = safe_sqrt(1 - z * z);
  const Vec3d h = Vec3d{r * std::cos(phi), r * std::sin(phi), z} + stretched;
  // The sum vanishes only for the cap's own rim seen from straight above: the rim's facets stand upright.
  const Vec3d m{alpha * h.x, alpha * h.y, std::max(0.0, h.z)};
  const double length2 = length_squared(m);
  return length2 > 0 ? m / std::sqrt(length2) : Vec3d{0, 0, 1};
}

double fresnel(double cosine, double eta) {
  const double c = std::min(cosine, 1.0), sin2 = (1 - c * c) / sqr(eta);
  if (sin2 >= 1) return 1;
  const double t = std::sqrt(1 - sin2);
  const double parallel = (eta * c - t) / (eta * c + t), across = (c - eta * t) / (c + eta * t);
  return 0.5 * (sqr(parallel) + sqr(across));
}

Vec3d refracted(const Vec3d& w, const Vec3d& m, double eta) {
  const double c = dot(w, m), t = safe_sqrt(1 - (1 - c * c) / sqr(eta));
  return normalize(m * (c / eta - t) - w / eta);
}

}  // namespace tyndall::optics
