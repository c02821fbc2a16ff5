#include "render/lights/learned_lights.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/numerics.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "compile/lights/light_tree.h"
#include "render/context/thread_context.h"
#include "render/lights/next_event.h"

namespace tyndall::render {

namespace {

// Of a region, and lights that are tried from each.
constexpr std::size_t most_places = 24;
constexpr std::uint32_t trials_a_place = 12;
// Lights beside the tree are tried one by one; of more nothing is learned.
constexpr std::size_t most_others = 16;

// Tries lights from the places of one region after the other.
class Pilot {
 public:
  Pilot(const compile::CompiledScene& world, Transmittance transmittance)
      : world_(world), transmittance_(transmittance), learner_(*world.light_tree) {}

  LightRegion learn(std::span<const LightPlace> places, std::span<const std::uint32_t> members) {
    segments_.clear();
    trials_.clear();
    shadows_.clear();
    trial_of_ray_.clear();
    for (const std::uint32_t i : members) try_lights(places[i], i);
    const auto rays = shadows_.trace(world_, transmittance_, {}, thread_);
    for (std::size_t r = 0; r < rays.size(); ++r)
      trials_[trial_of_ray_[r]].brought = std::max(optics::mean(rays[r].contribution), 0.0);
    return learner_.learn(segments_, trials_);
  }

 private:
  void try_lights(const LightPlace& place, std::uint32_t number) {
    const auto index = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back({place.position, {0, 0, 1}, 0, 0});
    const compile::LightTree& tree = *world_.light_tree;
    for (std::uint32_t k = 0; k < trials_a_place; ++k) {
      const SobolPoint u = sobol_point(number * trials_a_place + k, hash_bits(world_.scene.settings.seed, 7));
      double u_light = u[3];
      const std::uint32_t light = tree.sample(segments_.back(), u_light).light;
      trials_.push_back({index, light, true});
      shine(place, light, u);
    }
    if (tree.others().empty()) return;
    const auto other = number % static_cast<std::uint32_t>(tree.others().size());
    const std::uint32_t light = tree.others()[other];
    trials_.push_back(
        {index, other, false, 0, compile::LightAt(world_, light, place.time)->importance(segments_.back())});
    shine(place, light, sobol_point(number, hash_bits(world_.scene.settings.seed, 8)));
  }

  // Asks what a light brings in the trial that was added last.
  void shine(const LightPlace& place, std::uint32_t index, const SobolPoint& u) {
    const compile::LightAt light(world_, index, place.time);
    const optics::Pivot pivot = light->sample_pivot(u[0], u[1]).value_or(optics::Pivot{});
    const auto drawn = light->sample(place.position, pivot, u[0], u[1]);
    if (!drawn) return;
    const double cosine = place.on_surface() ? dot(place.normal, drawn->direction) : 1;
    if (!(cosine > 0 || place.transmits)) return;
    const Rgb arriving = drawn->radiance_over_pdf * static_cast<float>(std::abs(cosine));
    if (is_black(arriving)) return;
    trial_of_ray_.push_back(trials_.size() - 1);
    shadows_.add(shadow_ray(world_, cosine > 0 ? place.position : place.behind, place.time, *drawn, index,
                            arriving, static_cast<std::uint32_t>(trials_.size())),
                 {});
  }

  const compile::CompiledScene& world_;
  Transmittance transmittance_;
  RegionLearner learner_;
  ThreadContext thread_;
  ShadowBatch shadows_;
  std::vector<optics::RaySegment> segments_;
  std::vector<LightTrial> trials_;
  std::vector<std::size_t> trial_of_ray_;
};

}  // namespace

std::size_t LearnedLights::kind_of(const Vec3d& n) {
  const Vec3d size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 1 + 2 * axis + (n[axis] < 0 ? 1 : 0);
}

std::unique_ptr<const LearnedLights> LearnedLights::of(const compile::CompiledScene& world,
                                                       Transmittance transmittance, int threads) {
  if (!world.light_tree || world.light_tree->node_count() == 0 || !world.features.surfaces ||
      world.light_tree->others().size() > most_others)
    return nullptr;
  const std::vector<LightPlace> all = light_places(world, threads);
  std::vector<LightPlace> places[kind_count];
  for (const LightPlace& place : all) places[place.on_surface() ? kind_of(place.normal) : 0].push_back(place);
  auto out = std::make_unique<LearnedLights>();
  std::vector<std::unique_ptr<Pilot>> pilots;
  for (int i = 0; i < loop_workers(all.size(), threads); ++i)
    pilots.push_back(std::make_unique<Pilot>(world, transmittance));
  for (std::size_t k = 0; k < kind_count; ++k) {
    if (places[k].empty()) continue;
    std::vector<Vec3d> positions;
    for (const LightPlace& place : places[k]) positions.push_back(place.position);
    Kind& kind = out->kinds_[k].emplace(Kind{RegionTree(positions, most_places), {}});
    kind.regions.resize(kind.tree.region_count());
    parallel_for(kind.regions.size(), threads, [&](std::size_t region, int worker) {
      kind.regions[region] = pilots[static_cast<std::size_t>(worker)]->learn(
          places[k], kind.tree.points_of(static_cast<std::uint32_t>(region)));
    });
  }
  return out;
}

const LightRegion* LearnedLights::region_at(std::size_t kind, const Vec3d& x) const {
  if (!kinds_[kind]) return nullptr;
  return &kinds_[kind]->regions[kinds_[kind]->tree.region_at(x)];
}

const LightRegion* LearnedLights::in_medium(const Vec3d& x) const { return region_at(0, x); }

const LightRegion* LearnedLights::on_surface(const Vec3d& x, const Vec3d& normal) const {
  return region_at(kind_of(normal), x);
}

}  // namespace tyndall::render
