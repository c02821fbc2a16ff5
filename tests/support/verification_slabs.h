// Truths about slabs and half spaces.
#pragma once

#include "support/law_scenes.h"
#include "support/verification.h"

namespace tyndall::support {

// In closed form and with 3x² in depth. The bias of the march is that stated in tests/laws/slab_test.cpp.
inline void add_slab_rows(std::vector<VerificationRow>& rows) {
  const auto add = [&rows](auto&&... arguments) { rows.push_back(scene_row(arguments...)); };
  const Density squared = [](const Point& p) { return p.y * p.y * 3.f; };
  for (const Slab& slab_row : slab_rows)
    for (const SlabView view : {SlabView::reflection, SlabView::transmission})
      for (const Way& way : free_path_methods()) {
        const double truth = view == SlabView::reflection ? slab_row.R : slab_row.T;
        SceneBuilder even = slab(slab_row, view);
        even.image(16, 16, 16);
        add("Slab, van de Hulst", describe(slab_row, view), way, truth, 5e-6, even);
        const bool tested = slab_row.tau <= 2 && slab_row.albedo < 1;
        if (!tested) continue;
        SceneBuilder heterogeneous = slab(slab_row, view, squared);
        heterogeneous.image(16, 16, 16).step(1.0 / 128);
        const double bias = way.unbiased ? 0 : 0.5 * std::pow(slab_row.tau * 3 / 128, 2) * truth;
        add("Slab of 3x² in depth", describe(slab_row, view), way, truth, 5e-6 + bias, heterogeneous);
      }
}

// A place and a weight of Gauss and Legendre's rule on [0, 1].
struct QuadraturePoint {
  double place, weight;
};
inline std::vector<QuadraturePoint> gauss_legendre(int count) {
  std::vector<QuadraturePoint> points;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(pi * (i + 0.75) / (count + 0.5)), slope = 1;  // a root of the polynomial, by Newton
    for (int round = 0; round < 50; ++round) {
      double before = 1, value = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    points.push_back({0.5 * (1 - x), 1 / ((1 - x * x) * slope * slope)});
  }
  return points;
}

// A slab seen at an angle of this cosine to its normal.
inline SceneBuilder slab_at(const Slab& row, SlabView view, double cosine) {
  SceneBuilder builder = slab(row, view);
  const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
  if (view == SlabView::reflection)
    builder.orthographic({2 * tangent, 3, 0}, {0, 1, 0}, 1e-3, {0, 0, 1});
  else
    builder.orthographic({0.25 * tangent, -0.25, 0}, {0, 0, 0}, 1e-3, {0, 0, 1});
  return builder;
}

// What a slab gives of light that comes evenly from a hemisphere, by reciprocity the mean of what it shows
// over the cosine-weighted directions of view: ∫ 2 mu L(mu) dmu. The rule's error is far below the truths'
// digits.
inline Estimate diffuse_estimate(const Slab& row, SlabView view, const Way& way) {
  std::vector<double> sums(16, 0.0);
  for (const QuadraturePoint& mu : gauss_legendre(16)) {
    SceneBuilder builder = slab_at(row, view, mu.place);
    builder.image(8, 8, way.unbiased ? 128 : 32);  // tracking is four times as noisy
    for (std::size_t seed = 0; seed < sums.size(); ++seed) {
      builder.scene.settings.seed = seed + 1;
      const render::Film film = render::render(compile::compile(builder.scene), way.options()).film;
      for (int pixel = 0; pixel < 64; ++pixel)
        sums[seed] += 2 * mu.place * mu.weight * static_cast<double>(film.mean(pixel % 8, pixel / 8).y) / 64;
    }
  }
  return estimate_of(sums);
}
inline void add_diffuse_rows(std::vector<VerificationRow>& rows) {
  const auto add = [&rows](std::string table, std::string name, const Slab& row, SlabView view, double truth,
                           double digits) {
    for (const Way& way : ways_of({"Product", "Tracking"}))
      rows.push_back(
          {table, name, way.name, truth, digits, [=] { return diffuse_estimate(row, view, way); }});
  };
  for (const Slab& row : slab_rows)
    for (const SlabView view : {SlabView::reflection, SlabView::transmission})
      add("Slab under diffuse light", describe(row, view) + "d", row, view,
          view == SlabView::reflection ? row.Rd : row.Td, 5e-6);
  for (const auto& [albedo, truth] : {std::pair{0.5f, .146544}, {0.9f, .478024}, {0.99f, .794564}})
    add("Half space, white sky", "c " + short_number(albedo), {0, albedo, 100, 0, 0}, SlabView::reflection,
        truth, 1e-6 + 2e-5 * truth);
}

// Nothing comes through 60 mean free paths at these albedos, so a thick slab is a half space.
inline void add_half_space_rows(std::vector<VerificationRow>& rows) {
  struct HalfSpace {
    float albedo;
    double mu, R;
  };
  for (const HalfSpace& h : {HalfSpace{0.5f, 1, .115226},
                             {0.5f, .5, .160144},
                             {0.9f, 1, .414947},
                             {0.9f, .5, .507939},
                             {0.99f, 1, .752721},
                             {0.99f, .5, .815140}})
    for (const Way& way : free_path_methods()) {
      SceneBuilder builder = slab_at({0, h.albedo, 100, h.R, 0}, SlabView::reflection, h.mu);
      builder.image(16, 16, 16);
      rows.push_back(scene_row("Half space, Chandrasekhar",
                               "c " + short_number(h.albedo) + " mu " + short_number(h.mu), way, h.R,
                               1e-6 + 2e-5 * h.R, builder));
    }
}

// Light at every step is a sum at jittered places of each step: no bias.
inline void add_distant_light_rows(std::vector<VerificationRow>& rows) {
  const Slab row{0, 0.9f, 1, 0.03096352, 0.02634742};
  for (const SlabView view : {SlabView::reflection, SlabView::transmission})
    for (const Way& way : ways_of({"Product", "BruteForce", "Stochastic", "Tracking"})) {
      SceneBuilder builder = slab(row, view);
      builder.scene.lights.clear();
      builder.image(16, 16, 16).step(0.05).bounces(0).distant_light({0, -1, 0}, Rgb(1));
      const double truth = view == SlabView::reflection ? row.R : row.T;
      rows.push_back(scene_row("Distant light on a slab, once scattered",
                               view == SlabView::reflection ? "reflected" : "transmitted", way, truth, 1e-8,
                               builder));
    }
}

}  // namespace tyndall::support
