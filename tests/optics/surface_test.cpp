// Laws of the surfaces, over a table of materials: light paths can be reversed, nothing shines more than it
// gets and what is white returns all, samples follow their density, and grazing angles stay finite.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "optics/microfacet.h"
#include "optics/surface_model.h"

namespace tyndall::optics {
namespace UNNAMED {

const AlbedoTables& tables() {
  static const AlbedoTables made(std::vector<double>{1.1, 1.33, 1.5, 2.4});
  return made;
}

struct Case {
  std::string name;
  SurfaceParameters parameters;
  double eta = 1.5;
  bool sheet = false;
  // What a white surface may lose in a white room: 0 for none but the tables' error.
  double loss = 0;
};

SurfaceParameters white() {
  SurfaceParameters p;
  p.base_color = Rgb(1);
  return p;
}

// White surfaces: in a white room each is as bright as the room.
std::vector<Case> white_cases() {
  std::vector<Case> list;
  list.push_back({"matte", white()});
  for (const float roughness : {0.f, 0.01f, 0.1f, 0.3f, 0.6f, 1.f}) {
    const auto add = [&](std::string name, double eta, bool sheet, double loss, auto set) {
      SurfaceParameters p = white();
      p.roughness = roughness;
      set(p);
      list.push_back({fmt::format("{} roughness {} eta {:.3g}", name, roughness, eta), p, eta, sheet, loss});
    };
    add("gloss", 1.5, false, 0, [](auto& p) { p.specular = 1; });
    add("metal", 1.5, false, 0, [](auto& p) { p.metallic = 1; });
    for (const double eta : {1.1, 1.33, 1.5, 2.4, 1 / 1.33, 1 / 1.5, 1 / 2.4})
      add("glass", eta, false, 0, [](auto& p) { p.transmission = 1; });
    add("pane", 1.5, true, 0, [](auto& p) { p.transmission = 1; });
    add("half glass", 1.5, false, 0, [](auto& p) { p.transmission = 0.5f, p.specular = 1; });
    add("half metal", 1.5, false, 0, [](auto& p) { p.metallic = 0.5f, p.specular = 1; });
    add("lacquer of that roughness", 1.5, false, 0,
        [](auto& p) { p.coat = 1, p.coat_roughness = p.roughness; });
    // Lost are reflections out of layers whose two directions pass the layer above unequally.
    add("lacquered gloss", 1.5, false, 0.05, [](auto& p) { p.specular = 1, p.coat = 1; });
    add("lacquered metal", 1.5, false, 0.1, [](auto& p) { p.metallic = 1, p.coat = 1; });
    add("velvet", 1.5, false, 0.25, [](auto& p) { p.specular = 1, p.sheen = Rgb(1); });
  }
  return list;
}

// Coloured ones, every lobe among them, rough enough for densities to be integrated.
std::vector<Case> coloured_cases() {
  std::vector<Case> list;
  for (const float roughness : {0.25f, 0.5f, 1.f}) {
    const auto add = [&](std::string name, double eta, bool sheet, auto set) {
      SurfaceParameters p;
      p.base_color = Rgb(0.9f, 0.5f, 0.2f);
      p.roughness = roughness;
      set(p);
      list.push_back({fmt::format("{} roughness {} eta {:.3g}", name, roughness, eta), p, eta, sheet});
    };
    add("gloss", 1.5, false, [](auto& p) { p.specular = 1; });
    add("coloured gloss", 1.5, false, [](auto& p) { p.specular = 1, p.specular_color = Rgb(9, 2, 0.5f); });
    add("rough lacquer", 1.5, false, [](auto& p) { p.coat = 1, p.coat_roughness = p.roughness; });
    add("metal", 1.5, false, [](auto& p) { p.metallic = 1; });
    add("glass", 1.5, false, [](auto& p) { p.transmission = 1; });
    add("glass", 1 / 1.5, false, [](auto& p) { p.transmission = 1; });
    add("glass", 2.4, false, [](auto& p) { p.transmission = 1; });
    add("pane", 1.5, true, [](auto& p) { p.transmission = 1; });
    add("all", 1.5, false, [](auto& p) {
      p.metallic = 0.3f, p.specular = 0.7f, p.transmission = 0.4f, p.sheen = Rgb(0.5f, 0.2f, 0.1f);
    });
  }
  return list;
}

Vec3d direction(double cosine, double phi) {
  const double sine = safe_sqrt(1 - sqr(cosine));
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// What a surface returns in a white room, by its own sampling: radiance inside glass is η² of that outside.
// Points of a lattice (Roberts 2018), whose error for these integrands is below 1e-3 at 16,384.
Vec3d furnace(const Case& c, const Vec3d& o) {
  const SurfaceModel model(tables(), c.parameters, c.eta, c.sheet, o);
  Vec3d sum;
  constexpr int count = 16384;
  constexpr double steps[] = {0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};
  for (int k = 0; k < count; ++k) {
    double u[4];
    for (int d = 0; d < 4; ++d) u[d] = std::fmod(0.5 + steps[d] * k, 1.0);
    const auto s = model.sample(u[0], u[1], u[2], u[3]);
    if (!s) continue;
    const bool behind = s->direction.z < 0 && !c.sheet;
    sum += Vec3d(s->weight) * (behind ? sqr(c.eta) : 1.0);
  }
  return sum / double(count);
}

// Bounds on either side of white for what loses nothing: the tables' interpolation is within 0.005 at cosines
// from 0.2 on, and within 0.0125 at grazing ones, where shadowing sets in over cosines of roughness².
TEST(Surface, WhiteStaysWhiteInAWhiteRoom) {
  for (const Case& c : white_cases())
    for (const double cosine : {0.01, 0.05, 0.2, 0.5, 0.8, 1.0}) {
      const double bound = cosine < 0.2 ? 0.0125 : 0.005;
      const double returned = furnace(c, direction(cosine, 0.3)).y;
      EXPECT_LT(returned, 1 + bound) << c.name << " at cosine " << cosine;
      EXPECT_GT(returned, 1 - bound - c.loss) << c.name << " at cosine " << cosine;
    }
}

// A coloured gloss takes the colour at normal incidence alone, where glTF has f0 = min(0.04 c, 1), and
// returns no more than it gets.
TEST(Surface, ColoursItsGlossAtNormalIncidence) {
  SurfaceParameters p = white();
  p.base_color = Rgb(0);
  p.specular = 1;
  p.specular_color = Rgb(2, 1, 40);
  const auto mirrored = [&](double cosine) {
    return furnace({"gloss", p, 1.5, false}, direction(cosine, 0.3));
  };
  const Vec3d ahead = mirrored(1);
  EXPECT_NEAR(ahead.x, 0.08, 1e-6);
  EXPECT_NEAR(ahead.y, 0.04, 1e-6);
  EXPECT_NEAR(ahead.z, 1, 1e-6);
  const double schlick = std::pow(1 - 0.1, 5);
  EXPECT_NEAR(mirrored(0.1).y, 0.04 + 0.96 * schlick, 1e-6);
  EXPECT_NEAR(mirrored(0.1).x, 0.08 + 0.92 * schlick, 1e-6);
  p.base_color = Rgb(1);
  for (const double cosine : {0.2, 0.6, 1.0}) EXPECT_LE(max_component(mirrored(cosine)), 1.005);
}

// The same light the other way round: f(o → i) / η² of its side. Relative error of rounding only.
TEST(Surface, LightPathsCanBeReversed) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Case& c : coloured_cases())
    for (int k = 0; k < 200; ++k) {
      const Vec3d o = direction(uniform(random), 2 * pi * uniform(random));
      Vec3d i = direction(uniform(random), 2 * pi * uniform(random));
      const bool behind = c.parameters.transmission > 0 && k % 2 == 1;
      if (behind) i.z = -i.z;
      const auto flipped = [&](const Vec3d& w) { return behind ? -w : w; };
      const bool through = behind && !c.sheet;
      const Rgb there = SurfaceModel(tables(), c.parameters, c.eta, c.sheet, o).value(i);
      const Rgb back = SurfaceModel(tables(), c.parameters, through ? 1 / c.eta : c.eta, c.sheet, flipped(i))
                           .value(flipped(o));
      for (std::size_t ch = 0; ch < 3; ++ch) {
        const double a = there[ch] / std::abs(i.z) * (through ? sqr(c.eta) : 1.0),
                     b = back[ch] / std::abs(o.z);
        EXPECT_NEAR(a, b, 2e-5 * (a + b) + 1e-12) << c.name << " k " << k;
      }
    }
}

// χ² of samples against the density integrated over cells of (z, φ), with what is lost below the surface as
// one more cell. Seed 2; significance 0.01 over all cases (Šidák), by the Wilson-Hilferty approximation.
TEST(Surface, SamplesFollowTheirDensity) {
  constexpr int rows = 16, columns = 12, draws = 60000, fine = 64;
  const std::vector<Case> cases = coloured_cases();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Case& c : cases)
    for (const double cosine : {0.15, 0.6, 0.95}) {
      const Vec3d o = direction(cosine, 0.7);
      const SurfaceModel model(tables(), c.parameters, c.eta, c.sheet, o);
      std::vector<double> expected(rows * columns + 1, 0);
      double total = 0;
      for (int r = 0; r < rows; ++r)
        for (int f = 0; f < columns; ++f) {
          double sum = 0;
          for (int a = 0; a < fine; ++a)
            for (int b = 0; b < fine; ++b)
              sum += model.pdf(direction(-1 + 2 * (r + (a + 0.5) / fine) / rows,
                                         -pi + 2 * pi * (f + (b + 0.5) / fine) / columns));
          expected[r * columns + f] = sum / (fine * fine) * 4 * pi / (rows * columns);
          total += expected[r * columns + f];
        }
      EXPECT_LT(total, 1 + 2e-3) << c.name << " " << cosine;
      expected.back() = std::max(0.0, 1 - total);
      std::vector<int> counts(expected.size(), 0);
      for (int k = 0; k < draws; ++k) {
        const auto s = model.sample(uniform(random), uniform(random), uniform(random), uniform(random));
        if (!s) {
          ++counts.back();
          continue;
        }
        const int r = std::clamp(int((s->direction.z + 1) / 2 * rows), 0, rows - 1);
        const int f = std::clamp(int((std::atan2(s->direction.y, s->direction.x) + pi) / (2 * pi) * columns),
                                 0, columns - 1);
        ++counts[r * columns + f];
      }
      // Cells that expect fewer than 8 are joined.
      double chi2 = 0, joined = 0, joined_count = 0;
      int cells = 0;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const double e = expected[k] * draws;
        if (e < 8) {
          joined += e, joined_count += counts[k];
          continue;
        }
        chi2 += sqr(counts[k] - e) / e, ++cells;
      }
      if (joined >= 8) chi2 += sqr(joined_count - joined) / joined, ++cells;
      const double k = cells - 1, z = 3.66;  // normal quantile of 1 - 0.01/81
      ASSERT_LE(cases.size() * 3, 81u);
      EXPECT_LT(chi2, k * std::pow(1 - 2 / (9 * k) + z * std::sqrt(2 / (9 * k)), 3))
          << c.name << " " << cosine;
    }
}

// Sample's weight is value / pdf, and everything is finite and not negative down to cosines of 1e-9.
TEST(Surface, GrazingAnglesStayFinite) {
  std::vector<Case> cases = white_cases();
  for (const Case& c : coloured_cases()) cases.push_back(c);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto good = [](const Rgb& v) { return all_finite(v) && min_component(v) >= 0; };
  for (const Case& c : cases)
    for (const double cosine : {1e-9, 1e-5, 1e-3, 1.0}) {
      const Vec3d o = direction(cosine, 1);
      const SurfaceModel model(tables(), c.parameters, c.eta, c.sheet, o);
      EXPECT_TRUE(good(model.albedo())) << c.name;
      for (int k = 0; k < 300; ++k) {
        const double u[] = {uniform(random), k % 3 ? uniform(random) : 0.0,
                            k % 5 ? uniform(random) : one_minus_ulp_f, uniform(random)};
        if (const auto s = model.sample(u[0], u[1], u[2], u[3])) {
          EXPECT_TRUE(good(s->weight) && std::isfinite(s->pdf) && all_finite(s->direction))
              << c.name << " " << cosine;
          EXPECT_NEAR(length(s->direction), 1, 1e-9);
        }
        const Vec3d i =
            direction((k % 2 ? 1 : -1) * std::pow(10.0, -9 * uniform(random)), 6 * uniform(random));
        EXPECT_TRUE(good(model.value(i)) && model.pdf(i) >= 0 && std::isfinite(model.pdf(i)))
            << c.name << " " << cosine;
      }
    }
}

TEST(Surface, MatteAloneIsLambert) {
  SurfaceParameters p;
  p.base_color = Rgb(0.5f, 0.25f, 0.125f);
  EXPECT_TRUE(p.diffuse());
  const SurfaceModel model(tables(), p, 1.5, false, direction(0.4, 0));
  const Vec3d i = direction(0.7, 2);
  EXPECT_NEAR(model.value(i).x, 0.5 * 0.7 / pi, 1e-7);
  EXPECT_NEAR(model.pdf(i), 0.7 / pi, 1e-12);
}

// Fresnel against published values: normal incidence of glass 0.04, Brewster's angle, total reflection.
TEST(Surface, FresnelsEquations) {
  EXPECT_NEAR(fresnel(1, 1.5), 0.04, 1e-12);
  EXPECT_NEAR(fresnel(1, 1 / 1.5), 0.04, 1e-12);
  const double brewster = std::atan(1.5);  // only the polarisation across is reflected: sin²(i - t)/2
  EXPECT_NEAR(fresnel(std::cos(brewster), 1.5), 0.5 * sqr(std::sin(brewster - (pi / 2 - brewster))), 1e-12);
  EXPECT_EQ(fresnel(0.5, 1 / 1.5), 1);
  EXPECT_NEAR(fresnel(0, 1.5), 1, 1e-12);
  // The mean over diffuse light, 0.0918 for 1.5 (Kulla and Conty 2017 fit it to 1e-3).
  EXPECT_NEAR(1 - tables().transmitted_average(1.5), 0.0918, 5e-4);
}

}  // namespace
}  // namespace tyndall::optics
