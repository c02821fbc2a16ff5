// The reference renderer's paths: Woodcock tracking with spectral weights, light sampled at every real
// collision.
#include "reference/reference.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/check.h"
#include "base/numerics.h"
#include "base/parallel.h"
#include "optics/sky.h"
#include "reference/reference_world.h"

namespace tyndall::reference {

namespace {

double average(const Vec3d& v) { return (v.x + v.y + v.z) / 3; }

// Where a direction leads: a light with the radiance times solid angle that one sample of it stands for.
struct LightSample {
  Vec3d direction;
  double distance = infinity;
  Vec3d weight;
};

Vec3d cone_direction(const Vec3d& axis, double one_minus_cos_max, double u, double phi) {
  const double m = u * one_minus_cos_max, sine = safe_sqrt(m * (2 - m));
  return Frame<double>::around(axis).world({sine * std::cos(phi), sine * std::sin(phi), 1 - m});
}

LightSample sample(const scene::PointLight& light, const Vec3d& x, double, double) {
  const Vec3d d = light.position - x;
  const double distance = length(d);
  return {d / distance, distance, Vec3d(light.emitted_intensity()) / sqr(distance)};
}

LightSample sample(const scene::SpotLight& light, const Vec3d& x, double, double) {
  const Vec3d d = light.position - x;
  const double distance = length(d);
  const double share = light.cone().share(-d / distance);
  return {d / distance, distance, Vec3d(light.emitted_intensity()) * (share / sqr(distance))};
}

// Uniform in the cone that the sphere fills; dark from inside.
LightSample sample_shape(const scene::Sphere& sphere, const Vec3d& radiance, const Vec3d& x, double u,
                         double v) {
  const Vec3d d = sphere.center - x;
  const double distance2 = length_squared(d), ratio2 = sqr(sphere.radius) / distance2;
  if (ratio2 >= 1) return {};
  const double one_minus_cos = ratio2 / (1 + std::sqrt(1 - ratio2));
  const Vec3d direction = cone_direction(d / std::sqrt(distance2), one_minus_cos, u, 2 * pi * v);
  const double along = dot(d, direction);
  const double entry = along - safe_sqrt(sqr(sphere.radius) - length_squared(d - direction * along));
  return {direction, entry, radiance * (2 * pi * one_minus_cos)};
}

// Uniform over the area.
LightSample sample_shape(const scene::Quad& quad, const Vec3d& radiance, const Vec3d& x, double u, double v) {
  const Vec3d d = quad.center + quad.u * (2 * u - 1) + quad.v * (2 * v - 1) - x;
  const Vec3d n = cross(quad.u, quad.v);  // its length is a quarter of the area
  const double distance = length(d), facing = -dot(n, d);
  if (facing <= 0) return {};
  return {d / distance, distance, radiance * (4 * facing / (distance * sqr(distance)))};
}

// Uniform over the area.
LightSample sample_shape(const scene::Disk& disk, const Vec3d& radiance, const Vec3d& x, double u, double v) {
  const Vec3d n = normalize(disk.normal);
  const Frame<double> frame = Frame<double>::around(n);
  const double r = disk.radius * std::sqrt(u), phi = 2 * pi * v;
  const Vec3d d = disk.center + frame.x * (r * std::cos(phi)) + frame.y * (r * std::sin(phi)) - x;
  const double distance = length(d), facing = -dot(n, d);
  if (facing <= 0) return {};
  return {d / distance, distance, radiance * (pi * sqr(disk.radius) * facing / (distance * sqr(distance)))};
}

// Uniform in the cone of its disc, whose irradiance on a facing surface is π sin² of the half angle times
// radiance.
LightSample sample(const scene::DistantLight& light, const Vec3d&, double u, double v) {
  const double half = 0.5 * light.angle.radians, one_minus_cos = 2 * sqr(std::sin(0.5 * half));
  const double share = one_minus_cos > 0 ? 2 * one_minus_cos / sqr(std::sin(half)) : 1;
  return {cone_direction(-normalize(light.direction), one_minus_cos, u, 2 * pi * v), infinity,
          Vec3d(*light.irradiance) * share};
}

// Of the shapes that scenes for the reference have.
LightSample sample(const scene::AreaLight& light, const Vec3d& x, double u, double v) {
  const Vec3d radiance = radiance_of(light);
  if (const auto* sphere = std::get_if<scene::Sphere>(&light.shape))
    return sample_shape(*sphere, radiance, x, u, v);
  if (const auto* quad = std::get_if<scene::Quad>(&light.shape))
    return sample_shape(*quad, radiance, x, u, v);
  return sample_shape(std::get<scene::Disk>(light.shape), radiance, x, u, v);
}

// Found by rays that escape instead.
LightSample sample(const scene::EnvironmentLight&, const Vec3d&, double, double) { return {}; }

LightSample sample(const auto&, const Vec3d&, double, double) {
  CHECK(false);  // the reference has no such light
}

// One path after the other through one pixel, with that pixel's own random numbers.
class Tracker {
 public:
  Tracker(const World& world, const ReferenceSettings& settings, std::uint64_t seed)
      : world_(world), settings_(settings), random_(seed) {}

  double uniform() { return uniform_(random_); }
  std::uint64_t violations() const { return violations_; }

  // Radiance along a camera ray.
  Vec3d radiance(Ray ray) {
    Vec3d sum, beta{1, 1, 1};
    double t_min = 0;
    for (int scatterings = 0;; ++scatterings) {
      const std::optional<Surface> surface = world_.nearest_surface(ray, t_min, infinity);
      double t_end = surface ? surface->t : infinity;
      const auto light = ray.camera ? world_.nearest_light(ray, t_min, t_end) : std::nullopt;
      if (light) t_end = light->t;

      if (const std::optional<double> t = collide(ray, t_end, beta, sum)) {
        if (scatterings > settings_.bounces) return sum;
        ray = scatter_in_medium(ray, *t, beta, sum);
        t_min = 0;
      } else {
        if (is_zero(beta)) return sum;
        if (light) return sum + beta * light->radiance;
        if (!surface) return sum + beta * radiance_from_infinity(ray);
        sum += beta * Vec3d(surface->emission);
        if (scatterings > settings_.bounces) return sum;
        if (!scatter_at_surface(*surface, ray, beta, sum)) return sum;
        t_min = surface_offset(surface->position);
      }
    }
  }

 private:
  static bool is_zero(const Vec3d& v) { return v.x == 0 && v.y == 0 && v.z == 0; }
  // Environments for every ray; the discs of distant lights, which are sampled elsewhere, for camera rays.
  Vec3d radiance_from_infinity(const Ray& ray) const {
    Vec3d sum;
    for (const scene::LightInstance& instance : world_.scene().lights)
      if (const auto* environment = std::get_if<scene::EnvironmentLight>(&instance.light))
        sum += Vec3d(
            optics::sky_radiance(environment->radiance, environment->world_from_picture(), ray.direction));
    if (!ray.camera) return sum;
    for (const scene::LightInstance& instance : world_.scene().lights) {
      const auto* distant = std::get_if<scene::DistantLight>(&instance.light);
      if (distant == nullptr || distant->angle.radians == 0) continue;
      const double half = 0.5 * distant->angle.radians;
      if (0.5 * length_squared(ray.direction + normalize(distant->direction)) < 2 * sqr(std::sin(0.5 * half)))
        sum += Vec3d(*distant->irradiance) / (pi * sqr(std::sin(half)));
    }
    return sum;
  }

  // Far above the rounding of an intersection in double, far below anything visible. [m]
  static double surface_offset(const Vec3d& p) { return 1e-9 * (1 + length(p)); }

  // The next t of a Poisson process of rate `majorant`.
  double next_candidate(double t) { return t - std::log1p(-uniform()) / settings_.majorant; }

  // Sums of the coefficients at the point, with the majorant checked.
  struct Sums {
    Vec3d sigma_s, sigma_t, emission;
  };
  Sums sums_at(const Vec3d& position, bool camera) {
    world_.media_at(position, camera, media_);
    Sums sums;
    for (const MediumPoint& medium : media_) {
      sums.sigma_s += medium.sigma_s;
      sums.sigma_t += medium.sigma_t;
      sums.emission += medium.emission;
    }
    if (max_component(sums.sigma_t) > settings_.majorant) ++violations_;
    return sums;
  }

  // The distance of a real scattering before t_end, or nothing. Emission met on the way is added to `sum`;
  // when the path was absorbed, beta becomes zero.
  std::optional<double> collide(const Ray& ray, double t_end, Vec3d& beta, Vec3d& sum) {
    const Intervald hull = world_.volume_hull(ray, t_end);
    if (hull.empty()) return {};
    for (double t = next_candidate(hull.lo); t < hull.hi; t = next_candidate(t)) {
      const Sums here = sums_at(ray.origin + ray.direction * t, ray.camera);
      const double mu = settings_.majorant;
      sum += beta * here.emission / mu;
      // One event for all channels, drawn by their mean; each channel's weight corrects for its own share.
      const Vec3d scatter = beta * here.sigma_s, absorb = beta * (here.sigma_t - here.sigma_s);
      const Vec3d pass = beta * (Vec3d(mu) - here.sigma_t);
      const double s = average(scatter), a = std::max(0.0, average(absorb)), n = average(pass);
      const double u = uniform() * (s + a + n);
      if (u < s) {
        beta = scatter * ((s + a + n) / (mu * s));
        return t;
      }
      if (u < s + a) {
        beta = {};
        return {};
      }
      beta = pass * ((s + a + n) / (mu * n));
    }
    return {};
  }

  // Ratio tracking (Novák et al. 2014) towards a light; zero when a surface is in the way.
  Vec3d transmittance(const Vec3d& from, const Vec3d& direction, double t_min, double distance) {
    const Ray ray{from, direction};
    const double t_end = distance < infinity ? distance * (1 - 1e-9) : infinity;
    if (world_.occluded(ray, t_min, t_end)) return {};
    Vec3d result{1, 1, 1};
    const Intervald hull = world_.volume_hull(ray, t_end);
    if (hull.empty()) return result;
    for (double t = next_candidate(hull.lo); t < hull.hi && !is_zero(result); t = next_candidate(t))
      result *= Vec3d(1, 1, 1) - sums_at(from + direction * t, false).sigma_t / settings_.majorant;
    return result;
  }

  template <class Value>
  Vec3d light_sum(const Vec3d& from, double t_min, Value&& scattered) {
    Vec3d sum;
    for (const scene::LightInstance& instance : world_.scene().lights) {
      const double u = uniform(), v = uniform();
      const LightSample light =
          std::visit([&](const auto& one) { return sample(one, from, u, v); }, instance.light);
      const Vec3d value = is_zero(light.weight) ? Vec3d{} : light.weight * scattered(light.direction);
      if (!is_zero(value)) sum += value * transmittance(from, light.direction, t_min, light.distance);
    }
    return sum;
  }

  // The phase function's value in each channel: the mixture by each medium's scattering.
  static Vec3d phase_value(const std::vector<MediumPoint>& media, const Vec3d& w, const Vec3d& direction) {
    Vec3d value, total;
    const float m = static_cast<float>(0.5 * length_squared(w - direction));
    for (const MediumPoint& medium : media) {
      double density = 0;
      for (const MediumPoint::Lobe& lobe : medium.lobes) density += lobe.weight * lobe.phase.eval(m);
      value += medium.sigma_s * density;
      total += medium.sigma_s;
    }
    for (std::size_t c = 0; c < 3; ++c) value[c] = total[c] > 0 ? value[c] / total[c] : 0;
    return value;
  }

  // Direct light at the collision, then the ray onwards.
  Ray scatter_in_medium(const Ray& ray, double t, Vec3d& beta, Vec3d& sum) {
    const Vec3d x = ray.origin + ray.direction * t;
    const std::vector<MediumPoint> media = media_;  // shadow rays overwrite it
    sum += beta * light_sum(x, 0, [&](const Vec3d& to_light) {
             return phase_value(media, ray.direction, to_light);
           });

    Vec3d total;
    for (const MediumPoint& medium : media) total += medium.sigma_s;
    // The medium that scatters, by the mean share in the channels; weights give each channel its own share.
    Vec3d per_channel;
    for (std::size_t c = 0; c < 3; ++c) per_channel[c] = total[c] > 0 ? beta[c] / total[c] : 0;
    double u = uniform() * average(total * per_channel);
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < media.size(); ++i) {
      const double share = average(media[i].sigma_s * per_channel);
      if (share <= 0) continue;
      chosen = i;
      if (u < share) break;
      u -= share;
    }
    const double probability = average(media[chosen].sigma_s * per_channel) / average(total * per_channel);
    beta = media[chosen].sigma_s * per_channel / probability;
    return {x, sample_direction(media[chosen], ray.direction), false};
  }

  Vec3d sample_direction(const MediumPoint& medium, const Vec3d& w) {
    double total = 0;
    for (const MediumPoint::Lobe& lobe : medium.lobes) total += lobe.weight;
    double u = uniform() * total;
    std::size_t chosen = 0;
    while (chosen + 1 < medium.lobes.size() && u >= medium.lobes[chosen].weight)
      u -= medium.lobes[chosen++].weight;
    const double m = medium.lobes[chosen].phase.sample(static_cast<float>(uniform()) * one_minus_ulp_f,
                                                       static_cast<float>(uniform()) * one_minus_ulp_f);
    const double phi = 2 * pi * uniform(), sine = safe_sqrt(m * (2 - m));
    return normalize(Frame<double>::around(w).world({sine * std::cos(phi), sine * std::sin(phi), 1 - m}));
  }

  // Direct light on a diffuse surface, then a reflected ray, or false when the path was absorbed.
  bool scatter_at_surface(const Surface& surface, Ray& ray, Vec3d& beta, Vec3d& sum) {
    const Vec3d n = dot(surface.normal, ray.direction) < 0 ? surface.normal : -surface.normal;
    const Vec3d reflectance(surface.reflectance);
    if (is_zero(reflectance)) return false;
    sum += beta * reflectance *
           light_sum(surface.position, surface_offset(surface.position),
                     [&](const Vec3d& w) { return Vec3d(std::max(0.0, dot(n, w)) / pi); });
    beta *= reflectance;
    const double survival = std::min(1.0, max_component(reflectance));
    if (uniform() >= survival) return false;
    beta /= survival;
    const double radius = std::sqrt(uniform()), phi = 2 * pi * uniform();
    const Vec3d local{radius * std::cos(phi), radius * std::sin(phi), safe_sqrt(1 - sqr(radius))};
    ray = {surface.position, normalize(Frame<double>::around(n).world(local)), false};
    return true;
  }

  const World& world_;
  const ReferenceSettings& settings_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  std::vector<MediumPoint> media_;
  std::uint64_t violations_ = 0;
};

// The ray through a point of the picture, (0, 0) its upper left and (1, 1) its lower right corner.
Ray camera_ray(const scene::Camera& camera, double aspect, double x, double y) {
  const double sx = (2 * x - 1) * aspect, sy = 1 - 2 * y;
  return std::visit(
      [&](const auto& c) -> Ray {
        const std::optional<Transform> world_from_camera = Transform::look_at(c.from, c.to, c.up);
        CHECK(world_from_camera.has_value());
        if constexpr (requires { c.fov; }) {
          CHECK(c.aperture == 0);
          const double half = std::tan(0.5 * c.fov.radians);
          return {c.from, normalize(world_from_camera->vector({sx * half, sy * half, -1})), true};
        } else if constexpr (requires { c.height; }) {
          return {world_from_camera->point({0.5 * c.height * sx, 0.5 * c.height * sy, 0}),
                  normalize(world_from_camera->vector({0, 0, -1})), true};
        } else {
          const double longitude = (2 * x - 1) * pi, latitude = (0.5 - y) * pi;
          return {c.from,
                  normalize(
                      world_from_camera->vector({std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                                 -std::cos(longitude) * std::cos(latitude)})),
                  true};
        }
      },
      camera);
}

// A seed of its own for every pixel (SplitMix64's finalizer).
std::uint64_t pixel_seed(std::uint64_t seed, std::uint64_t pixel) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15ull + pixel + 1;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace

ReferenceResult::Pixel ReferenceResult::region(int x0, int y0, int x1, int y1) const {
  Pixel sum;
  Vec3d variance;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      sum.mean += at(x, y).mean;
      variance += at(x, y).standard_error * at(x, y).standard_error;
    }
  const double count = double(x1 - x0) * (y1 - y0);
  return {sum.mean / count,
          Vec3d(std::sqrt(variance.x), std::sqrt(variance.y), std::sqrt(variance.z)) / count};
}

ReferenceResult reference_render(const scene::Scene& scene, const ReferenceSettings& settings) {
  CHECK_GE(settings.samples, 2);
  CHECK(scene.volumes.empty() || settings.majorant > 0);
  const World world(scene);
  ReferenceResult result;
  result.width = scene.settings.resolution.width;
  result.height = scene.settings.resolution.height;
  const std::size_t count = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
  result.pixels.resize(count);
  std::vector<std::uint64_t> violations(count);
  parallel_for(count, settings.threads, [&](std::size_t index, int) {
    Tracker tracker(world, settings, pixel_seed(settings.seed, index));
    const auto x = static_cast<double>(index % static_cast<std::size_t>(result.width));
    const auto y = static_cast<double>(index / static_cast<std::size_t>(result.width));
    Vec3d sum, sum_of_squares;
    for (int i = 0; i < settings.samples; ++i) {
      const double px = (x + tracker.uniform()) / result.width, py = (y + tracker.uniform()) / result.height;
      const Vec3d value =
          tracker.radiance(camera_ray(scene.camera, double(result.width) / result.height, px, py));
      sum += value;
      sum_of_squares += value * value;
    }
    const double n = settings.samples;
    ReferenceResult::Pixel& pixel = result.pixels[index];
    pixel.mean = sum / n;
    for (std::size_t c = 0; c < 3; ++c)
      pixel.standard_error[c] = safe_sqrt((sum_of_squares[c] / n - sqr(pixel.mean[c])) / (n - 1));
    violations[index] = tracker.violations();
  });
  for (const std::uint64_t one : violations) result.majorant_violations += one;
  return result;
}

}  // namespace tyndall::reference
