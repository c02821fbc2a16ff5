#include "render/lights/lamp_guiding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/numerics.h"
#include "compile/geometry/geometry.h"
#include "optics/light_sampling.h"
#include "render/lights/light_selection.h"

namespace tyndall::render {

namespace {

// A lamp this many times its radius away is far; one that is twice as near or nearer is no target: what
// passes a wide lamp is not much brighter than what does not.
constexpr double far_in_radii = 4;

// Unit vectors around w: Frame's, for doubles.
Vec3d around(const Vec3d& w, double theta, double phi) {
  const Frame<double> frame = Frame<double>::around(w);
  return normalize(w * std::cos(theta) +
                   (frame.x * std::cos(phi) + frame.y * std::sin(phi)) * std::sin(theta));
}

// What a spot lights by the solid angle that it fills; nothing where that is much, for paths go there by
// themselves.
double spot_weight(const LitSpot& spot, const compile::Ray& ray) {
  const double d2 = length_squared(spot.center - ray.origin);
  if (!(d2 > 0 && d2 < sqr(ray.t_max))) return 0;
  return std::max(spot.power * (d2 - 2 * sqr(spot.radius)), 0.0) / sqr(d2);
}
// Spots that weigh less, as a part of the one that weighs most, are left to paths: looking at 64 of them
// costs as much as a ray.
constexpr double least_spot = 0.1;

}  // namespace

bool guides_to_lamps(const compile::CompiledScene& world) {
  // A lamp is near all that is in the box of a medium which is not far larger.
  const auto is_small_in = [](const Vec3d& lamp, const shapes::Bounds& box) {
    return far_in_radii * length(lamp) < length(box.hi - box.lo);
  };
  const auto holds = [](const shapes::Bounds& box, const Vec3d& p) {
    return box.lo.x <= p.x && p.x <= box.hi.x && box.lo.y <= p.y && p.y <= box.hi.y && box.lo.z <= p.z &&
           p.z <= box.hi.z;
  };
  std::vector<shapes::Bounds> boxes;
  for (const compile::CompiledVolume& volume : world.volumes)
    boxes.push_back(world.geometry->volume_bounds(volume));
  return std::any_of(world.lights.begin(), world.lights.end(), [&](const compile::CompiledLight& light) {
    const auto bounds = light.bounds();
    return bounds && std::any_of(boxes.begin(), boxes.end(), [&](const shapes::Bounds& box) {
             return holds(box, bounds->center()) && is_small_in(bounds->hi - bounds->lo, box);
           });
  });
}

LampGuide::LampGuide(const compile::CompiledScene& world, const LitSpots* spots, const compile::Ray& ray,
                     std::span<const float> picks, const LightRegion* region) {
  add_lamps(world, ray, picks, region);
  if (spots) {
    std::array<double, LitSpots::most_spots> weights;
    double most = 0;
    for (std::size_t i = 0; i < spots->spots().size(); ++i)
      most = std::max(most, weights[i] = spot_weight(spots->spots()[i], ray));
    for (std::size_t i = 0; i < spots->spots().size(); ++i)
      if (weights[i] > least_spot * most) add(spots->spots()[i], ray.origin, weights[i]);
  }
  double of_lamps = 0, of_spots = 0;
  for (const Lamp& lamp : lamps_) of_lamps += lamp.share;
  for (const Spot& spot : spots_) of_spots += spot.share;
  const double both = lamps_.empty() || spots_.empty() ? 1 : 0.5;
  for (Lamp& lamp : lamps_) lamp.share *= both / of_lamps;
  for (Spot& spot : spots_) spot.share *= both / of_spots;
}

void LampGuide::add_lamps(const compile::CompiledScene& world, const compile::Ray& ray,
                          std::span<const float> picks, const LightRegion* region) {
  const LightSelection lights(world, ray, 0, 0, region);
  if (lights.empty()) return;
  if (!world.light_tree) {
    for (std::uint32_t i = 0; i < world.lights.size(); ++i)
      add(*compile::LightAt(world, i, ray.time), ray, lights.probability(i));
    return;
  }
  InlineVector<std::uint32_t, 8> chosen;
  for (float u : picks) {
    const std::uint32_t i = lights.sample(u);
    if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
    chosen.push_back(i);
    add(*compile::LightAt(world, i, ray.time), ray, lights.probability(i));
  }
}

// A ray to a lamp brings about its power over its distance; the probability goes with that over the square.
void LampGuide::add(const compile::CompiledLight& light, const compile::Ray& ray, double probability) {
  const auto bounds = light.bounds();
  if (!bounds || !(probability > 0)) return;
  const Vec3d to = bounds->center() - ray.origin;
  const double distance = length(to), radius = length(bounds->hi - bounds->lo) / 2;
  const double part = std::min(2 * distance / (far_in_radii * radius) - 1, 1.0);
  if (!(distance > 0 && distance < ray.t_max && part > 0)) return;
  lamps_.push_back({to / distance, probability * distance * part});
}

void LampGuide::add(const LitSpot& spot, const Vec3d& x, double weight) {
  const Vec3d to = spot.center - x;
  const double d2 = length_squared(to);
  spots_.push_back({to / std::sqrt(d2), weight, optics::one_minus_cos_of(sqr(spot.radius) / d2)});
}

double LampGuide::pdf(const Vec3d& w) const {
  double pdf = 0;
  for (const Lamp& lamp : lamps_) pdf += lamp.share / (2 * sqr(pi) * length(cross(lamp.toward, w)));
  for (const Spot& spot : spots_)
    if (0.5 * length_squared(spot.toward - w) <= spot.m_max)
      pdf += spot.share / optics::cone_solid_angle(spot.m_max);
  return pdf;
}

Vec3d LampGuide::sample(float u_target, float u0, float u1) const {
  double u = u_target;
  for (const Lamp& lamp : lamps_) {
    if (u < lamp.share || (spots_.empty() && &lamp + 1 == lamps_.end()))
      return around(lamp.toward, pi * u0, 2 * pi * u1);
    u -= lamp.share;
  }
  std::size_t i = 0;
  while (i + 1 < spots_.size() && u >= spots_[i].share) u -= spots_[i++].share;
  return optics::sample_cone(spots_[i].toward, spots_[i].m_max, u0, u1);
}

}  // namespace tyndall::render
