// Rough interfaces: the GGX distribution of microfacets, its shadowing, and Fresnel's equations.
//
// Directions are in the frame of the surface, whose normal is +z, and point away from it. `alpha` is the
// squared roughness, > 0. Trowbridge and Reitz 1975; Walter et al., "Microfacet Models for Refraction through
// Rough Surfaces" (EGSR 2007); Heitz, "Understanding the Masking-Shadowing Function" (JCGT 2014).
#pragma once

#include "base/numerics.h"
#include "base/vec.h"

namespace tyndall::optics {

inline double alpha_of(double roughness) { return sqr(roughness); }

// Density of microfacet normals, per steradian and unit of surface.
double ggx_density(const Vec3d& m, double alpha);
// √(z² + α²(1 − z²)), in which GGX's shadowing is written: G1(w) = 2 z / (z + slope_root(z)).
double slope_root(double cosine, double alpha);
// The part of the microfacets that are turned to w and not hidden (Smith's G1), for w.z = ±cosine.
double ggx_visible(double cosine, double alpha);
// A microfacet normal as seen from w: density G1(w) max(0, w·m) D(m) / w.z. By the spherical caps of Dupuy
// and Benyoub, "Sampling Visible GGX Normals with Spherical Caps" (HPG 2023), after Heitz 2018.
Vec3d sample_visible_normal(const Vec3d& w, double alpha, double u0, double u1);

// Part of the light that a smooth boundary reflects: unpolarised, cosine >= 0 on this side, `eta` the index
// of the other side over that of this side. 1 where all of it is reflected.
double fresnel(double cosine, double eta);
// Schlick's weight of 1 − F0 (1994): F = F0 + (1 − F0) schlick(cosine).
inline double schlick(double cosine) {
  const double s = 1 - cosine;
  return sqr(sqr(s)) * s;
}
inline Vec3d mirrored(const Vec3d& w, const Vec3d& m) { return m * (2 * dot(w, m)) - w; }
// The direction behind the boundary with normal m, which w (w·m > 0) is refracted to; not for total
// reflection.
Vec3d refracted(const Vec3d& w, const Vec3d& m, double eta);

}  // namespace tyndall::optics
