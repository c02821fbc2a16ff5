// Laws of the lights: what is drawn follows the density that is told, the power given is the power that
// leaves, and a ray's reached parts are those that light reaches.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "compile/lights/compiled_light.h"

namespace tyndall::compile {
namespace UNNAMED {

CompiledLight compiled(const scene::Light& light) {
  static const scene::Scene empty;
  return {light, {empty, {}}};
}

struct Case {
  std::string name;
  scene::Light light;
  Vec3d middle;  // no point of it is farther than 1.5 from that
};
using Cases = std::vector<Case>;

// Of power 7 W. A light that is none of these does not compile: it wants cases, none if it has no place.
const Rgb power(7.0f);
template <class Light>
Cases cases_of() = delete;
template <>
Cases cases_of<scene::PointLight>() {
  return {{"point", scene::PointLight{{0.1, 0.2, -0.3}, power, {}}, {0.1, 0.2, -0.3}}};
}
template <>
Cases cases_of<scene::SpotLight>() {
  Cases list;
  for (const double angle : {5.0, 60.0, 90.0, 130.0})
    for (const double blend : {0.0, 0.4, 1.0})
      list.push_back({"spot " + std::to_string(angle) + " " + std::to_string(blend),
                      scene::SpotLight{{0.1, 0, 0.2}, {1, 2, -0.5}, {angle * pi / 180}, blend, power, {}},
                      {0.1, 0, 0.2}});
  return list;
}
template <>
Cases cases_of<scene::DistantLight>() {
  return {};
}
template <>
Cases cases_of<scene::EnvironmentLight>() {
  return {};
}

// The lights that are named after a shape.
template <class S>
std::pair<S, Vec3d> shape_and_middle() = delete;
template <>
std::pair<scene::Sphere, Vec3d> shape_and_middle() {
  return {{{0.2, 0, 0.1}, 0.7}, {0.2, 0, 0.1}};
}
template <>
std::pair<scene::Quad, Vec3d> shape_and_middle() {
  return {{{0, 0.2, 0}, {0.3, 0, 0.5}, {0.8, 0.1, 0}}, {0, 0.2, 0}};
}
template <>
std::pair<scene::Disk, Vec3d> shape_and_middle() {
  return {{{0, 0.2, 0}, {1, 3, -2}, 0.6}, {0, 0.2, 0}};
}
template <>
std::pair<scene::Cylinder, Vec3d> shape_and_middle() {
  return {{{0, -0.4, 0}, {0.2, 0.6, 0.4}, 0.3}, {0.1, 0.1, 0.2}};
}
template <class S>
void add_shape(Cases& list) {
  const auto [shape, middle] = shape_and_middle<S>();
  list.push_back({std::string(S::keyword), scene::AreaLight{shape, power, {}}, middle});
}
template <class... S>
void add_shapes(Cases& list, const std::variant<S...>*) {
  (add_shape<S>(list), ...);
}
template <>
Cases cases_of<scene::AreaLight>() {
  Cases list;
  add_shapes(list, static_cast<const scene::LightShapes*>(nullptr));
  return list;
}

template <class... Light>
Cases all_cases(const std::variant<Light...>*) {
  Cases list;
  const auto add = [&](const Cases& more) { list.insert(list.end(), more.begin(), more.end()); };
  (add(cases_of<Light>()), ...);
  return list;
}
// Every light that has a place.
Cases placed_lights() { return all_cases(static_cast<const scene::Light*>(nullptr)); }

// Where a ray meets the light's surface, and the normal there; written anew, apart from the renderer's
// queries.
struct Met {
  Vec3d y, normal;
};
std::optional<Met> meets(const scene::Sphere& s, const Vec3d& x, const Vec3d& w) {
  const double b = dot(x - s.center, w), c = length_squared(x - s.center) - sqr(s.radius);
  if (b * b < c || b > 0) return {};
  const Vec3d y = x + w * (-b - std::sqrt(b * b - c));
  return Met{y, normalize(y - s.center)};
}
std::optional<Met> meets_plane(const Vec3d& center, const Vec3d& normal, const Vec3d& x, const Vec3d& w) {
  const double t = dot(center - x, normal) / dot(w, normal);
  return t > 0 ? std::optional(Met{x + w * t, normal}) : std::nullopt;
}
std::optional<Met> meets(const scene::Quad& q, const Vec3d& x, const Vec3d& w) {
  const Vec3d n = cross(q.u, q.v);
  const auto met = meets_plane(q.center, normalize(n), x, w);
  if (!met) return {};
  const Vec3d off = met->y - q.center;
  const bool inside = std::abs(dot(cross(off, q.v), met->normal)) <= length(n) &&
                      std::abs(dot(cross(q.u, off), met->normal)) <= length(n);
  return inside ? met : std::nullopt;
}
std::optional<Met> meets(const scene::Disk& d, const Vec3d& x, const Vec3d& w) {
  const auto met = meets_plane(d.center, normalize(d.normal), x, w);
  return met && length(met->y - d.center) < d.radius ? met : std::nullopt;
}
// From outside: its mantle, or the end that faces x.
std::optional<Met> meets(const scene::Cylinder& c, const Vec3d& x, const Vec3d& w) {
  const double height = length(c.to - c.from);
  const Vec3d axis = (c.to - c.from) / height;
  const auto across = [&](const Vec3d& v) { return v - axis * dot(v, axis); };
  const Vec3d o = across(x - c.from), d = across(w);
  const double a = length_squared(d), b = dot(o, d), root = b * b - a * (length_squared(o) - sqr(c.radius));
  if (root >= 0 && length(o) > c.radius) {
    const double t = (-b - std::sqrt(root)) / a;
    const Vec3d y = x + w * t;
    const double along = dot(y - c.from, axis);
    if (t > 0 && along >= 0 && along <= height) return Met{y, normalize(across(y - c.from))};
  }
  const bool to_end = dot(w, axis) < 0;
  const auto met = meets(scene::Disk{to_end ? c.to : c.from, to_end ? axis : -axis, c.radius}, x, w);
  return met;
}
std::optional<Met> meets(const scene::Light& light, const Vec3d& x, const Vec3d& w) {
  return std::visit(
      [&]<class S>(const S& shape) -> std::optional<Met> {
        if constexpr (scene::is_one_of<S, scene::LightShapes>) return meets(shape, x, w);
        return {};
      },
      std::get<scene::AreaLight>(light).shape);
}
template <class S>
bool has_shape(const scene::Light& light) {
  return std::holds_alternative<S>(std::get<scene::AreaLight>(light).shape);
}

// What rounding makes of the cosine at a hit of a round mantle: `meets` loses the squares of distance and
// radius against each other, so the hit is off along the mantle, and its normal turned, by that much over the
// cosine.
double curved_error(const scene::Light& light, double distance, double cosine) {
  if (!has_shape<scene::Cylinder>(light)) return 0;
  const double radius = std::get<scene::Cylinder>(std::get<scene::AreaLight>(light).shape).radius;
  return 16 * std::numeric_limits<double>::epsilon() * sqr(distance / radius) / sqr(cosine);
}

// Pearson's statistic of drawn directions in cells around the way to the light, against the integral of the
// density.
TEST(Lights, DrawWithTheDensityTheyTell) {
  constexpr int rows = 6, columns = 8, draws = 20000, fine = 250;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const Case& c : placed_lights()) {
    const CompiledLight light = compiled(c.light);
    if (light.is_delta()) continue;
    for (const Vec3d x : {Vec3d(0.5, 3, -1.5), Vec3d(2, 1.2, -0.2), Vec3d(-0.9, 6, -3), Vec3d(30, 90, -60)}) {
      const Frame<double> frame = Frame<double>::around(normalize(c.middle - x));
      // 1 - cos of a cone that holds the light.
      const double sine = std::min(1.0, 1.5 / length(c.middle - x)),
                   m_max = sine < 1 ? 1 - std::sqrt(1 - sine * sine) : 2;
      std::vector<double> expected(rows * columns), found(rows * columns);
      double inside = 0;
      for (int i = 0; i < rows * fine; ++i)
        for (int j = 0; j < columns * fine; ++j) {
          const double m = m_max * (i + 0.5) / (rows * fine), phi = 2 * pi * (j + 0.5) / (columns * fine);
          const double s = std::sqrt(m * (2 - m));
          const Vec3d w = frame.world({s * std::cos(phi), s * std::sin(phi), 1 - m});
          const auto met = meets(c.light, x, w);
          if (!met) continue;
          const double share =
              light.pdf(x, w, met->y, met->normal) * 2 * pi * m_max / (rows * columns * fine * fine);
          expected[static_cast<std::size_t>(i / fine * columns + j / fine)] += draws * share;
          inside += share;
        }
      int missed = 0;  // points that face away
      for (int k = 0; k < draws; ++k) {
        const float u0 = uniform(random), u1 = uniform(random);
        const auto drawn = light.sample(x, *light.sample_pivot(u0, u1), u0, u1);
        if (!drawn) {
          ++missed;
          continue;
        }
        const auto met = meets(c.light, x, drawn->direction);
        ASSERT_TRUE(met || has_shape<scene::Sphere>(c.light) || has_shape<scene::Cylinder>(c.light))
            << c.name;
        if (met) {
          const double error =
              1e-9 + curved_error(c.light, drawn->distance, dot(drawn->direction, met->normal));
          EXPECT_NEAR(light.pdf(x, drawn->direction, met->y, met->normal) / drawn->pdf_solid_angle, 1, error);
          EXPECT_NEAR(length(met->y - x) / drawn->distance, 1, 1e-6) << c.name;
        }
        const Vec3d local = frame.local(drawn->direction);
        const double m = length_squared(drawn->direction - frame.z) / 2, phi = std::atan2(local.y, local.x);
        const int row = std::min(rows - 1, static_cast<int>(m / m_max * rows));
        const int column = static_cast<int>(std::floor(phi / (2 * pi) * columns + columns)) % columns;
        found[static_cast<std::size_t>(row * columns + column)] += 1;
      }
      // Only a closed surface that is drawn over its area has points that face away. The edge of the light
      // crosses cells.
      if (!has_shape<scene::Cylinder>(c.light)) {
        EXPECT_EQ(missed, 0) << c.name;
      }
      const double away = double(missed) / draws, deviation = std::sqrt(away * (1 - away) / draws);
      EXPECT_NEAR(inside, 1 - away, 0.002 + 4 * deviation) << c.name;
      double chi2 = 0;
      int cells = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] < 10) continue;
        chi2 += sqr(found[i] - expected[i]) / expected[i];
        ++cells;
      }
      // Six standard deviations of the statistic above its mean.
      EXPECT_LT(chi2, cells + 6 * std::sqrt(2.0 * cells)) << c.name << " from " << x.y;
    }
  }
}

// The flux through a sphere around the light, from the samples that a scene's points would take.
TEST(Lights, EmitThePowerGiven) {
  constexpr int points = 60000;
  const double radius = 5, golden = pi * (3 - std::sqrt(5.0));
  for (const Case& c : placed_lights()) {
    const CompiledLight light = compiled(c.light);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<float> uniform(0, 1);
    double flux = 0;
    for (int i = 0; i < points; ++i) {
      const double z = 1 - (2 * i + 1.0) / points, r = std::sqrt(1 - z * z);
      const Vec3d outward{r * std::cos(golden * i), r * std::sin(golden * i), z};
      const float u0 = uniform(random), u1 = uniform(random);
      const Vec3d x = outward * radius;
      const auto drawn = light.sample(x, *light.sample_pivot(u0, u1), u0, u1);
      if (drawn)
        flux += drawn->radiance_over_pdf.x * -dot(drawn->direction, outward) * 4 * pi * sqr(radius) / points;
    }
    // A cone of 5 degrees holds 114 of the points; its rim is met by their spacing.
    EXPECT_NEAR(flux, 7, c.name.starts_with("spot 5") ? 0.35 : 0.07) << c.name;
  }
}

TEST(Lights, ReachThePartsTheyTell) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Case& c : placed_lights()) {
    const CompiledLight light = compiled(c.light);
    const optics::Pivot pivot = *light.sample_pivot(0.3f, 0.6f);
    int reached_points = 0, dark_points = 0;
    for (int ray = 0; ray < 2000; ++ray) {
      const Vec3d origin{3 * uniform(random), 3 * uniform(random), 3 * uniform(random)};
      const Vec3d direction = normalize(Vec3d{uniform(random), uniform(random), uniform(random)});
      const double t_max = ray % 2 ? 4 : infinity;
      const optics::ReachedParts reached = light.reached_parts(pivot, origin, direction, t_max);
      double before = 0;
      for (int i = 0; i < reached.count; ++i) {
        EXPECT_LE(before, reached.parts[i].lo) << c.name;
        EXPECT_FALSE(reached.parts[i].empty()) << c.name;
        before = reached.parts[i].hi;
      }
      EXPECT_LE(before, t_max) << c.name;
      for (int k = 0; k < 20; ++k) {
        const double t = 4 * (k + 0.5) / 20;
        bool in_part = false, near_edge = false;
        for (int i = 0; i < reached.count; ++i) {
          in_part |= reached.parts[i].contains(t);
          near_edge |= std::abs(reached.parts[i].lo - t) < 1e-9 || std::abs(reached.parts[i].hi - t) < 1e-9;
        }
        const auto drawn = light.sample(origin + direction * t, pivot, 0.3f, 0.6f);
        const bool lit = drawn && !is_black(drawn->radiance_over_pdf);
        if (!near_edge) {
          EXPECT_EQ(lit, in_part) << c.name << " at " << t;
        }
        ++(in_part ? reached_points : dark_points);
      }
      // A light is not chosen for a ray that its cone misses.
      if (reached.count == 0 && std::holds_alternative<scene::SpotLight>(c.light)) {
        EXPECT_EQ(light.importance({origin, direction, 0, t_max}), 0) << c.name;
      }
    }
    EXPECT_GT(reached_points, 0) << c.name;
    EXPECT_EQ(dark_points > 0, c.name != "point") << c.name;
  }
}

// Rays through the apex of a cone, along its axis and across it.
TEST(Lights, ReachThroughTheApex) {
  const CompiledLight spot =
      compiled(scene::SpotLight{{0, 0, 0}, {0, 0, -1}, {30 * pi / 180}, 0, Rgb(1), {}});
  optics::ReachedParts reached = spot.reached_parts({}, {0, 0, 2}, {0, 0, -1}, 10);
  ASSERT_EQ(reached.count, 1);
  EXPECT_EQ(reached.parts[0], (Intervald{2, 10}));
  reached = spot.reached_parts({}, {0, 0, -3}, {0, 0, 1}, 10);
  ASSERT_EQ(reached.count, 1);
  EXPECT_EQ(reached.parts[0], (Intervald{0, 3}));
  EXPECT_EQ(spot.reached_parts({}, {-1, 0, 0}, {1, 0, 0}, 10).count, 0);
  const CompiledLight wide =
      compiled(scene::SpotLight{{0, 0, 0}, {0, 0, -1}, {150 * pi / 180}, 0, Rgb(1), {}});
  // Across the dark cone behind the light: lit before it and after it.
  reached = wide.reached_parts({}, {-5, 0, 1}, {1, 0, 0}, 10);
  ASSERT_EQ(reached.count, 2);
  EXPECT_NEAR(reached.parts[0].hi, 5 - std::tan(30 * pi / 180), 1e-12);
  EXPECT_NEAR(reached.parts[1].lo, 5 + std::tan(30 * pi / 180), 1e-12);
}

// The flux of a convex mesh light through a sphere around it.
TEST(Lights, MeshesEmitThePowerGiven) {
  scene::Scene scene;
  scene.meshes.push_back(scene::TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 0, 1}},
                                             {},
                                             {}});
  const Transform skewed{{1, 0.3, 0}, {-0.2, 2, 0.1}, {0, 0.4, -0.5}, {3, 1, -2}};
  const CompiledLight light(scene::AreaLight{scene::Mesh{scene::MeshId(0)}, power, {}, true, skewed},
                            {scene, {}});
  std::mt19937_64 random(8);
  std::uniform_real_distribution<float> uniform(0, 1);
  const Vec3d center = skewed.point({0.25, 0.25, 0.25});
  const double radius = 5, golden = pi * (3 - std::sqrt(5.0));
  constexpr int points = 200000;
  double flux = 0;
  for (int i = 0; i < points; ++i) {
    const double z = 1 - (2 * i + 1.0) / points, r = std::sqrt(1 - z * z);
    const Vec3d outward{r * std::cos(golden * i), r * std::sin(golden * i), z};
    const float u0 = uniform(random), u1 = uniform(random);
    const auto drawn = light.sample(center + outward * radius, *light.sample_pivot(u0, u1), u0, u1);
    if (drawn)
      flux += drawn->radiance_over_pdf.x * -dot(drawn->direction, outward) * 4 * pi * sqr(radius) / points;
  }
  EXPECT_NEAR(flux, 7, 0.1);
}

TEST(Lights, BlackSkiesAreNotDrawn) {
  scene::EnvironmentLight light;
  light.radiance.color = Rgb(1);
  for (auto& plane : light.radiance.picture) plane = make_plane("sky", 4, 2, std::vector<float>(8));
  EXPECT_FALSE(compiled(light).sample({}, {}, 0.5f, 0.5f));
  EXPECT_EQ(compiled(light).pdf({}, {0, 0, -1}, {}, {}), 0);
}

// Full inside, falling without a jump, nothing at the rim.
TEST(Spots, FadeSmoothlyToTheRim) {
  const scene::SpotLight light{{0, 0, 0}, {0, 0, -1}, {40 * pi / 180}, 0.5, {}, Rgb(2)};
  const optics::SpotCone spot = light.cone();
  const auto share = [&](double degrees) {
    const double a = degrees * pi / 180;
    return spot.share({std::sin(a), 0, -std::cos(a)});
  };
  EXPECT_EQ(light.emitted_intensity(), Rgb(2));
  EXPECT_EQ(share(0), 1);
  EXPECT_EQ(share(19.99), 1);
  EXPECT_EQ(share(40.01), 0);
  for (double a = 20; a < 40; a += 0.5) {
    EXPECT_GE(share(a), share(a + 0.5));
    EXPECT_NEAR(share(a), share(a + 0.5), 0.08);
  }
}

}  // namespace
}  // namespace tyndall::compile
