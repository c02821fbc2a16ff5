// Truths about balls, lamps in fog, known densities, fire and white worlds.
#pragma once

#include "support/law_scenes.h"
#include "support/transmittance_measure.h"
#include "support/verification.h"

namespace tyndall::support {

inline void add_sphere_rows(std::vector<VerificationRow>& rows) {
  for (const WhiteSphere& row : white_sphere_rows)
    for (const Way& way : free_path_methods()) {
      SceneBuilder builder = white_sphere(row);
      builder.image(16, 16, 64);
      rows.push_back(scene_row("Sphere in a white environment",
                               "tau_r " + short_number(row.tau) + " c " + short_number(row.albedo), way,
                               white_sphere_square(row), 5e-6, builder, 0.005));
    }
}

inline void add_airlight_rows(std::vector<VerificationRow>& rows) {
  const auto add = [&rows](auto&&... arguments) { rows.push_back(scene_row(arguments...)); };
  for (const Airlight& row : airlight_rows)
    for (std::size_t i = 0; i < 3; ++i)
      for (const Way& way : ways()) {
        SceneBuilder builder = airlight(row, airlight_g[i]);
        builder.image(16, 16, 64);
        add("Airlight",
            "sigma_t " + short_number(row.sigma_t) + " D " + short_number(row.D) + " g " +
                short_number(static_cast<double>(airlight_g[i])),
            way, row.radiance[i], 1e-8 * row.radiance[i], builder, 0.02);
      }
  // Where fog takes nothing away, equi-angular sampling has no variance. The truth is that of scattering
  // alone; 10 m of fog take away 1e-5 of it at most.
  constexpr double sigma = 1e-6, truth = 2.18583521e-02 * sigma / 0.1;
  add("Airlight without extinction", "D 1", ways_of({"Equiangular"})[0], truth, 2e-5 * truth,
      airlight({sigma, 1, 5, 10, {}}, 0));
}

// With the bias of a march by Hoeffding's bound.
inline void add_transmittance_rows(std::vector<VerificationRow>& rows) {
  for (const KnownDensity& known : known_densities())
    for (const auto& [name, method] : all_transmittances()) {
      const double truth = std::exp(-known.tau), step = 0.1;
      const double bias = render::info(method).unbiased
                              ? 0
                              : std::expm1(std::pow(step * known.total_variation, 2) / 8) * truth;
      rows.push_back({"Transmittance of known densities, step 0.1", known.name, name, truth,
                      bias + 1e-6 * truth, [known, method = method, step] {
                        const auto m = measure_transmittance(known, method, step, 1 << 15);
                        return Estimate{Vec3d(m.mean), Vec3d(m.standard_error)};
                      }});
    }
}

// In proportion to density: 1 - 1/e for any density of τ = 1. In proportion to the distance: 1 - 2/e.
inline void add_emission_rows(std::vector<VerificationRow>& rows) {
  const auto add = [&rows](auto&&... arguments) { rows.push_back(scene_row(arguments...)); };
  for (const Way& way : free_path_methods()) {
    MediumColors fire;
    fire.albedo = Rgb(0);
    fire.emission = Rgb(1);
    const auto seen = [&](const Density& density) {
      SceneBuilder builder;
      builder.image(32, 32, 32).step(0.01).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6);
      const scene::MediumId medium = density ? builder.shader(fire, density) : builder.constant(fire);
      return builder.volume(scene::Box{{0, -1, -1}, {1, 1, 1}}, medium);
    };
    const double truth = 1 - std::exp(-1);
    add("Emission, 1 - 1/e", "constant", way, truth, 1e-6, seen({}));
    add("Emission, 1 - 1/e", "3x²", way, truth, way.unbiased ? 1e-6 : 5e-5,
        seen([](const Point& p) { return p.x * p.x * 3.f; }));
  }
  for (const Way& way : free_path_methods()) {
    MediumColors absorbing, glowing;
    absorbing.albedo = glowing.albedo = Rgb(0);
    glowing.sigma_t = Rgb(0);
    glowing.emission = Rgb(1);
    SceneBuilder builder;
    const scene::Box box{{0, -1, -1}, {1, 1, 1}};
    builder.image(32, 32, 32).step(0.005).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6);
    builder.volume(box, builder.constant(absorbing)).volume(box, builder.shader(glowing, [](const Point& p) {
      return p.x;
    }));
    add("Emission, 1 - 2/e", "along x", way, 1 - 2 * std::exp(-1), way.unbiased ? 1e-6 : 1e-5, builder);
  }
}

// What does not absorb cannot be seen in a white world.
inline void add_white_rows(std::vector<VerificationRow>& rows) {
  const auto add = [&rows](auto&&... arguments) { rows.push_back(scene_row(arguments...)); };
  const Density lumps = [](const Point& p) {
    return max(cos(p.x * 5.f) * cos(p.y * 4.f) * cos(p.z * 6.f) + 0.3f, 0);
  };
  for (const Way& way : ways_of({"Product", "Mis", "Density", "Equiangular", "BruteForce", "Stochastic",
                                 "Tracking", "TrackingDensity", "TrackingEquiangular"}))
    for (const bool heterogeneous : {false, true}) {
      SceneBuilder builder;
      builder.image(16, 16, 32).step(0.2).perspective({0, 0, 4}, {0, 0, 0}, 30).environment(1);
      MediumColors white{Rgb(heterogeneous ? 8.f : 3.f), Rgb(1), {}, hg(0.5f)};
      builder.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}},
                     heterogeneous ? builder.shader(white, lumps) : builder.constant(white));
      add("White furnace", heterogeneous ? "lumps, step 0.2" : "constant", way, 1, 1e-6, builder);
    }
  // A closed box whose walls reflect rho and emit 1 - rho.
  for (const Way& way : free_path_methods())
    for (const float rho : {0.5f, 0.8f}) {
      SceneBuilder builder;
      builder.image(24, 24, 32).step(0.2).perspective({0.2, -0.3, 0.4}, {1, 0.5, -1}, 60);
      builder.surface(scene::Box{{-1, -1, -1}, {1, 1, 1}}, Rgb(rho), Rgb(1 - rho));
      const MediumColors white{Rgb(4), Rgb(1), {}, hg(0.4f)};
      builder.volume(scene::Box{{-2, -2, -2}, {2, 2, 2}}, builder.shader(white, lumps));
      add("Lambertian box", "rho " + short_number(rho), way, 1, 1e-6, builder);
    }
}

// In a body that only scatters, the mean length of the paths that enter evenly through its surface is 4V/S,
// whatever scatters: 4/3 for a ball of radius 1. An absorption everywhere takes that much from a white world;
// of two absorptions what is linear is kept. A ball is seen alike from everywhere but for what it holds: each
// seed looks from another side.
inline void add_mean_path_rows(std::vector<VerificationRow>& rows) {
  constexpr double sigma_a = 0.015;
  const Density lumps = [](const Point& p) {
    return max(cos(p.x * 5.f) * cos(p.y * 4.f) * cos(p.z * 6.f) + 0.3f, 0);
  };
  for (const float g : {0.f, 0.6f})
    for (const Way& way : free_path_methods())
      rows.push_back(
          {"Mean path 4V/S in a ball", "lumps, g " + short_number(g), way.name, 4.0 / 3, 0.005 * 4 / 3, [=] {
             std::vector<double> paths;
             for (int seed = 1; seed <= 16; ++seed) {
               const double y = (seed - 0.5) / 8 - 1, turn = 2.399963 * seed;  // Fibonacci's sphere
               const double r = std::sqrt(1 - y * y);
               const auto seen = [&](double absorption) {
                 SceneBuilder b;
                 b.image(24, 24, 64).step(0.1).environment(1);
                 b.scene.settings.seed = static_cast<std::uint64_t>(seed);
                 b.orthographic({5 * r * std::cos(turn), 5 * y, 5 * r * std::sin(turn)}, {0, 0, 0}, 2);
                 b.volume(scene::Sphere{{}, 1}, b.shader({Rgb(8), Rgb(1), {}, hg(g)}, lumps));
                 b.volume(scene::Sphere{{}, 1},
                          b.constant({Rgb(static_cast<float>(absorption)), Rgb(0), {}, {}}));
                 const auto film = render::render(compile::compile(b.scene), way.options()).film;
                 return region_estimate({film}, 0, 0, 24, 24).mean.y;
               };
               const double none = seen(0), one = none - seen(sigma_a), two = none - seen(2 * sigma_a);
               // Over the disc in its square.
               paths.push_back((4 * one - two) / 2 / sigma_a * 4 / pi);
             }
             return estimate_of(paths);
           }});
}

}  // namespace tyndall::support
