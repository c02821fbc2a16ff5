#include "optics/albedo_tables.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "optics/microfacet.h"

namespace tyndall::optics {

namespace {

// Nodes are even in cosine^¼ and √roughness: what microfacets hide changes over cosines like roughness², at
// every scale of it. Row 0 of either is smooth and has a closed form.
constexpr std::size_t cosines = 48, roughnesses = 32;
constexpr std::size_t glass_cosines = 48, glass_roughnesses = 24;
constexpr double smallest_cosine = 1e-6;  // stands for 0 in the first node: G1 has a limit there

// Relative indices that differ by less than this part are one.
constexpr double same_eta = 1e-9;

double node(std::size_t i, std::size_t count) { return static_cast<double>(i) / (double(count) - 1); }

// Where a value in [0, 1] lies among `count` even nodes: between `index` and the next, by `part`.
struct Place {
  std::size_t index;
  double part;
};
Place place(double value, std::size_t count) {
  const double at = std::clamp(value, 0.0, 1.0) * (double(count) - 1);
  const std::size_t index = std::min(static_cast<std::size_t>(at), count - 2);
  return {index, at - static_cast<double>(index)};
}
double between(const double* nodes, const Place& p) {
  return lerp(nodes[p.index], nodes[p.index + 1], p.part);
}

double cosine_at(std::size_t i, std::size_t count) {
  return std::max(smallest_cosine, sqr(sqr(node(i, count))));
}
double alpha_at(std::size_t i, std::size_t count) { return sqr(sqr(node(i, count))); }
Place cosine_place(double cosine, std::size_t count) {
  return place(std::sqrt(std::sqrt(std::max(0.0, cosine))), count);
}
Place roughness_place(double roughness, std::size_t count) { return place(std::sqrt(roughness), count); }

// 2 ∫ E μ dμ of what is linear in s = μ^¼ between nodes: 8 ∫ E s⁷ ds.
double average(const double* nodes, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double a = node(i, count), b = node(i + 1, count), slope = (nodes[i + 1] - nodes[i]) / (b - a);
    sum += (nodes[i] - slope * a) * (std::pow(b, 8) - std::pow(a, 8)) +
           slope * 8 / 9 * (std::pow(b, 9) - std::pow(a, 9));
  }
  return sum;
}

Vec3d direction(double cosine) { return {safe_sqrt(1 - sqr(cosine)), 0, cosine}; }

// Calls add(u0, u1, weight) over the unit square by the midpoint rule; weights sum to 1. Everything here is
// even about the azimuth, so half of u0 is enough; u1 is graded towards both its ends (5th-order smoothstep),
// where the steep facets are.
template <class F>
void for_square(F&& add) {
  constexpr int azimuths = 9, heights = 48;
  for (int j = 0; j < heights; ++j) {
    const double s = (j + 0.5) / heights, u1 = s * s * s * (10 + s * (6 * s - 15)),
                 weight = 30 * sqr(s * (1 - s)) / (azimuths * heights);
    for (int i = 0; i < azimuths; ++i) add(0.5 * (i + 0.5) / azimuths, u1, weight);
  }
}

// G2/G1 of the reflection off a microfacet: Smith's height-correlated shadowing over what o sees.
double unshadowed(double i, double alpha, double o, double root) {
  return i > 0 ? i * (o + root) / (o * slope_root(i, alpha) + i * root) : 0.0;
}

// The albedo of a node's direction by sampling visible normals, whose weight is G2/G1.
AlbedoTables::Reflection reflected(double cosine, double alpha) {
  const Vec3d o = direction(cosine);
  const double root = slope_root(o.z, alpha);
  AlbedoTables::Reflection sum;
  for_square([&](double u0, double u1, double weight) {
    const Vec3d m = sample_visible_normal(o, alpha, u0, u1);
    const double c = std::min(1.0, dot(o, m)), bias = schlick(c);
    const double part = weight * unshadowed(2 * c * m.z - o.z, alpha, o.z, root);
    sum.bias += bias * part;
    sum.scale += (1 - bias) * part;
  });
  const double excess = std::max(1.0, sum.white());  // of the rule: no facet returns more than it gets
  return {sum.scale / excess, sum.bias / excess};
}

double through_glass(double cosine, double alpha, double eta) {
  const Vec3d o = direction(cosine);
  const double root = slope_root(o.z, alpha);
  double sum = 0;
  for_square([&](double u0, double u1, double weight) {
    const Vec3d m = sample_visible_normal(o, alpha, u0, u1);
    const double c = dot(o, m), F = fresnel(c, eta);
    sum += weight * F * unshadowed(2 * c * m.z - o.z, alpha, o.z, root);
    if (F == 1) return;
    const double t = -refracted(o, m, eta).z;
    if (t > 0) sum += weight * (1 - F) * ggx_visible(t, alpha);
  });
  return std::min(sum, 1.0);
}

double sheen_albedo(double cosine) {
  const Vec3d o = direction(cosine);
  constexpr int n = 48;
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < n; ++k) {
      const double z = (j + 0.5) / n, phi = pi * (k + 0.5) / n, r = safe_sqrt(1 - z * z);
      const Vec3d i{r * std::cos(phi), r * std::sin(phi), z};
      sum += sheen_lobe(normalize(o + i).z, o.z, z) * z;
    }
  return sum * 2 * pi / (n * n);
}

}  // namespace

double sheen_lobe(double cosine_m, double cosine_o, double cosine_i) {
  constexpr double exponent = 1 / sheen_roughness;
  const double density =
      (2 + exponent) * std::pow(std::max(0.0, 1 - sqr(cosine_m)), 0.5 * exponent) / (2 * pi);
  return density / (4 * (cosine_o + cosine_i - cosine_o * cosine_i));
}

AlbedoTables::AlbedoTables(std::span<const double> glass_etas) {
  scale_.resize(cosines * roughnesses);
  bias_.resize(cosines * roughnesses);
  sheen_.resize(cosines);
  parallel_for(roughnesses, 0, [&](std::size_t r, int) {
    for (std::size_t c = 0; c < cosines; ++c) {
      const double cosine = cosine_at(c, cosines);
      if (r == 0) {
        bias_[c] = schlick(cosine);
        scale_[c] = 1 - bias_[c];
      } else {
        const Reflection e = reflected(cosine, alpha_at(r, roughnesses));
        scale_[r * cosines + c] = e.scale;
        bias_[r * cosines + c] = e.bias;
      }
    }
  });
  parallel_for(cosines, 0, [&](std::size_t c, int) { sheen_[c] = sheen_albedo(cosine_at(c, cosines)); });
  for (std::size_t r = 0; r < roughnesses; ++r) {
    scale_average_.push_back(average(&scale_[r * cosines], cosines));
    bias_average_.push_back(average(&bias_[r * cosines], cosines));
  }
  // Schlick's own: 2 ∫ (1 − μ)⁵ μ dμ.
  bias_average_[0] = 1.0 / 21;
  scale_average_[0] = 20.0 / 21;

  std::vector<double> etas;
  for (const double eta : glass_etas) etas.insert(etas.end(), {eta, 1 / eta});
  std::sort(etas.begin(), etas.end());
  for (const double eta : etas)
    if (glass_.empty() || eta > glass_.back().eta * (1 + same_eta))
      glass_.push_back({eta, std::vector<double>(glass_cosines * glass_roughnesses), {}, 1});
  parallel_for(glass_.size() * glass_roughnesses, 0, [&](std::size_t index, int) {
    GlassTable& table = glass_[index / glass_roughnesses];
    const std::size_t r = index % glass_roughnesses;
    for (std::size_t c = 0; c < glass_cosines; ++c) {
      const double cosine = cosine_at(c, glass_cosines);
      table.albedo[r * glass_cosines + c] =
          r == 0 ? 1 : through_glass(cosine, alpha_at(r, glass_roughnesses), table.eta);
    }
  });
  for (GlassTable& table : glass_) {
    for (std::size_t r = 0; r < glass_roughnesses; ++r)
      table.average.push_back(average(&table.albedo[r * glass_cosines], glass_cosines));
    constexpr int n = 1024;
    const double eta = std::max(table.eta, 1 / table.eta);
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += fresnel((k + 0.5) / n, eta) * (k + 0.5) / n;
    table.transmitted_average = (1 - 2 * sum / n) * (table.eta < 1 ? sqr(table.eta) : 1.0);
  }
}

// Between the closed form of smooth microfacets and the first rough row, and between rough rows.
AlbedoTables::Reflection AlbedoTables::reflection(double cosine, double roughness) const {
  const Place r = roughness_place(roughness, roughnesses), c = cosine_place(cosine, cosines);
  const auto row = [&](std::size_t k) -> Reflection {
    if (k == 0) return {1 - schlick(std::min(cosine, 1.0)), schlick(std::min(cosine, 1.0))};
    return {between(&scale_[k * cosines], c), between(&bias_[k * cosines], c)};
  };
  const Reflection low = row(r.index), high = row(r.index + 1);
  return {lerp(low.scale, high.scale, r.part), lerp(low.bias, high.bias, r.part)};
}

AlbedoTables::Reflection AlbedoTables::reflection_average(double roughness) const {
  const Place r = roughness_place(roughness, roughnesses);
  return {between(scale_average_.data(), r), between(bias_average_.data(), r)};
}

double AlbedoTables::sheen(double cosine) const {
  return between(sheen_.data(), cosine_place(cosine, cosines));
}

const AlbedoTables::GlassTable& AlbedoTables::glass_of(double eta) const {
  const auto found = std::lower_bound(glass_.begin(), glass_.end(), eta * (1 - same_eta),
                                      [](const GlassTable& t, double e) { return t.eta < e; });
  CHECK(found != glass_.end() && found->eta < eta * (1 + same_eta));
  return *found;
}

double AlbedoTables::glass(double cosine, double roughness, double eta) const {
  const GlassTable& table = glass_of(eta);
  const Place r = roughness_place(roughness, glass_roughnesses), c = cosine_place(cosine, glass_cosines);
  return lerp(between(&table.albedo[r.index * glass_cosines], c),
              between(&table.albedo[(r.index + 1) * glass_cosines], c), r.part);
}

double AlbedoTables::glass_average(double roughness, double eta) const {
  return between(glass_of(eta).average.data(), roughness_place(roughness, glass_roughnesses));
}

double AlbedoTables::transmitted_average(double eta) const { return glass_of(eta).transmitted_average; }

}  // namespace tyndall::optics
