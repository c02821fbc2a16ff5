#include "render/path/path_tracer.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "optics/phase.h"
#include "render/lights/light_sum.h"
#include "render/path/light_clamp.h"
#include "render/path/path_distant_guiding.h"
#include "render/path/path_lamp_guiding.h"
#include "render/path/russian_roulette.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;
using compile::RayKind;

// Shadow rays of more paths wait for each other no longer than this.
constexpr std::size_t shadows_together = 1 << 14;

// How many paths advance together, at least while there are samples: their segments fill batches of hundreds
// of lanes. Where no medium varies there are few segments, and more paths would leave the cache.
std::size_t paths_together(const CompiledScene& world) { return world.features.heterogeneous ? 192 : 16; }

// Sample s of g groups is sample s / g of group s mod g; each group is a scrambling of its own.
Sampler sampler_for(const CompiledScene& world, const PathSettings& settings, const CameraSample& s) {
  const auto groups = static_cast<std::uint64_t>(settings.groups);
  const std::uint64_t seed = world.scene.settings.seed;
  return {groups == 1 ? seed : hash_bits(seed, 1 + s.sample % groups),
          static_cast<std::uint32_t>(world.scene.frame), static_cast<std::uint32_t>(s.x),
          static_cast<std::uint32_t>(s.y), static_cast<std::uint32_t>(s.sample / groups)};
}

constexpr std::string_view branch_words(std::uint32_t branch) {
  constexpr std::string_view words[] = {"",
                                        "behind: ",
                                        "towards a distant light: ",
                                        "behind, towards a distant light: ",
                                        "towards a lamp: ",
                                        "behind, towards a lamp: "};
  return words[branch];
}

constexpr std::string_view kind_word(PathOrigin::Kind kind) {
  switch (kind) {
    case PathOrigin::Kind::camera:
      return "the camera";
    case PathOrigin::Kind::volume:
      return "a medium";
    case PathOrigin::Kind::surface:
      return "a surface";
    case PathOrigin::Kind::delta:
      return "a mirror or glass";
  }
  return "";
}

void say_direct_light(const PathOutputs& outputs, const LightTarget& target, const Rgb& light) {
  if (outputs.trace && !is_black(light))
    outputs.say("  + ({:.6g}, {:.6g}, {:.6g}) direct light, {}depth {} {}\n", light.x, light.y, light.z,
                branch_words(target.branch), target.depth,
                target.on_surface ? "on a surface" : "in a medium");
}

void say_ray(const PathOutputs& outputs, const PathState& s, const March& m, const Vec3d& origin) {
  const Vec3d from = s.ray.origin + origin, along = s.ray.direction;
  outputs.say(
      "{}depth {} ray from {} ({:.6g}, {:.6g}, {:.6g}) along ({:.6g}, {:.6g}, {:.6g}): {} segments, "
      "transmittance {:.6g}, throughput {:.6g}\n",
      branch_words(s.branch), s.depth, kind_word(s.origin.kind), from.x, from.y, from.z, along.x, along.y,
      along.z, m.count, luminance(m.end_transmittance()), luminance(s.throughput));
}

}  // namespace

PathTracer::PathTracer(const CompiledScene& world, const CameraRays& camera, const PathSettings& settings)
    : world_(world), camera_(camera), settings_(settings), media_(settings.method, settings.distance) {}

// All paths go one ray on at a time: rays, one march of all, what each meets, one batch of shadow rays.
bool PathTracer::trace(std::span<const CameraSample> samples, const PathOutputs& given,
                       ThreadContext& thread) {
  CHECK_EQ(samples.size(), given.radiance.size());
  PathOutputs outputs = given;
  if (settings_.clamp.limits()) {
    scattered_.assign(samples.size(), {});
    outputs.scattered = scattered_;
  }
  std::fill(outputs.radiance.begin(), outputs.radiance.end(), Rgb{});
  std::fill(outputs.aovs.begin(), outputs.aovs.end(), AovSample{});
  CutLightMeter cut_light(settings_, outputs.radiance);
  Run run{samples, outputs, {world_, settings_, media_, shadows_, emission_rays_, thread}, cut_light};
  active_ = 0;
  while (start_paths(run), active_ > 0) {
    if (outputs.deadline != nullptr && outputs.deadline->passed()) return false;
    for (std::size_t i = 0; i < active_; ++i) cut_light.note_ray(*slots_[i]);
    for (std::size_t i = 0; i < active_; ++i) trace_ray(run, *slots_[i]);
    media_.propagate(world_, thread);
    const std::size_t before = active_;
    for (std::size_t i = 0; i < before; ++i) {
      ended_.push_back(!advance(run, i));
      if (shadows_.size() >= shadows_together) trace_shadows(run);
    }
    trace_shadows(run);
    trace_emission_rays(run);
    remove_ended();
  }
  cut_light.finish(thread.statistics);
  if (!scattered_.empty())
    clamp_light(settings_.clamp, scattered_, outputs.radiance, outputs.aovs, thread.statistics.clamped_light);
  return true;
}

// The next free slot, its memory from an earlier path.
PathSlot& PathTracer::new_slot() {
  if (active_ == slots_.size()) slots_.push_back(std::make_unique<PathSlot>());
  return *slots_[active_++];
}

// New camera samples take the places of paths that have ended.
void PathTracer::start_paths(Run& run) {
  while (active_ < paths_together(world_) && run.started < run.samples.size()) {
    const CameraSample& s = run.samples[run.started];
    PathSlot& path = new_slot();
    path.sampler = sampler_for(world_, settings_, s);
    path.sample = static_cast<std::uint32_t>(run.started++);
    path.state = {};
    const PathNumbers numbers = path.numbers(path.state);
    const SobolPoint u = numbers.point(Decision::pixel);
    const double time = world_.features.motion
                            ? world_.scene.animation.shutter_curve.moment(numbers.point(Decision::time)[0])
                            : 0;
    path.state.ray = camera_.ray(s.x, s.y, u[0], u[1], u[2], u[3], time);
    ++run.context.thread.statistics.samples;
    run.cut_light.note_start();
  }
}

// Keeps the order of the others: a sample's light is added in an order of its own.
void PathTracer::remove_ended() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < active_; ++i) {
    if (i >= ended_.size() || !ended_[i])
      std::swap(slots_[kept++], slots_[i]);
    else
      slots_[i]->release();
  }
  active_ = kept;
  ended_.clear();
}

void PathTracer::trace_ray(const Run& run, PathSlot& path) {
  PathState& s = path.state;
  path.next_ray();
  ++run.context.thread.statistics.rays;
  const RayKind kind = s.origin.kind == PathOrigin::Kind::camera ? RayKind::camera : RayKind::scattered;
  const auto hit = world_.features.walks_surfaces()
                       ? trace_through(world_, s.ray, kind, run.context.thread, path.crossings)
                       : world_.closest_hit(s.ray, kind);
  // An optional is copied whole even when it holds nothing.
  if (hit)
    path.hit = hit;
  else
    path.hit.reset();
  std::vector<MarchCrossing>& crossings = path.march().crossings;
  crossings.clear();
  for (const Crossing& c : path.crossings) crossings.push_back({c.t, 1 - c.surface.opacity});
  s.ray.t_max = path.hit ? path.hit->t : infinity;
  media_.request(
      world_, {&path.ray(), s.ray, kind, s.throughput, path.numbers(s), settings_.jitters,
               s.depth > 0 || !settings_.whole_camera_marches, settings_.orders_after(s.media_scatterings)});
}

// What the ray of path i gathers, the direct light along it, and its next ray. False when the path ends.
bool PathTracer::advance(const Run& run, std::size_t i) {
  PathSlot& path = *slots_[i];
  PathState& s = path.state;
  const March& m = path.march();
  if (run.outputs.trace) say_ray(run.outputs, s, m, world_.origin);
  if (s.is_guided()) {
    run.outputs.add_cost(path.sample, m.count);
    if (s.is_sent_to_lamp()) {
      gather_.meet_surfaces(run.context, path);
      light_lamp_ray(run.context, path, s, gather_.surfaces(), goes_on(s));
    } else {
      light_guided(run.context, path, s);
    }
    return false;
  }
  const Rgb before = run.outputs.radiance[path.sample];
  gather_.gather(run.context, path, run.outputs);
  run.cut_light.note_gathered(path, before);
  if (!run.outputs.aovs.empty()) gather_.record(path, run.outputs.aovs[path.sample]);
  run.cut_light.note_carried(path, gather_.surfaces(), run.context.thread.statistics);
  if (s.depth > static_cast<std::uint32_t>(settings_.bounces)) return false;
  if (s.media_scatterings > settings_.real_scatterings) return false;
  const bool continues = goes_on(s);
  if (traits(settings_.method).aims) light_aimed(run.context, path, s, continues && continues_in_volumes(s));
  return scatter(run, path, continues);
}

bool PathTracer::goes_on(const PathState& s) const {
  return s.depth < static_cast<std::uint32_t>(settings_.bounces) || settings_.gathers_after_last;
}

bool PathTracer::continues_in_volumes(const PathState& s) const {
  return s.media_scatterings < settings_.real_scatterings || settings_.gathers_after_last;
}

// Direct light in the volume and on a surface, and the choice of the next ray.
bool PathTracer::scatter(const Run& run, PathSlot& path, bool continues) {
  PathState& s = path.state;
  const HitSurfaces& surfaces = gather_.surfaces();
  const double volume_mass = std::max(0.0f, luminance(s.throughput * path.march().total_scattered())),
               surface_mass = surfaces.mass();
  if (!(volume_mass + surface_mass > 0)) return false;
  const bool both = s.origin.kind == PathOrigin::Kind::camera;  // camera rays follow both, deeper ones choose
  const bool volume_continues = continues && continues_in_volumes(s);
  const double volume_probability = both               ? (volume_mass > 0)
                                    : volume_continues ? volume_mass / (volume_mass + surface_mass)
                                                       : 0;
  prepare_light(run.context, path, s, settings_.orders_after(s.media_scatterings), s.shares);
  if (volume_mass > 0) light_volume(run.context, path, s, volume_continues, volume_probability);

  const bool chooses = surface_mass > 0 && (!both || surfaces.several());
  const double u = chooses ? path.numbers(s).point(Decision::continuation)[3] : 0;
  if (surface_mass > 0 && (both || u >= volume_probability)) {
    const double part = both ? u : (u - volume_probability) / (1 - volume_probability);
    const HitSurface& surface = surfaces.choose(part);
    const double probability = surface.mass / surface_mass * (both ? 1 : 1 - volume_probability);
    PathState next = s;
    next.throughput = surface.throughput * static_cast<float>(1 / probability);
    light_surface(run.context, path, next, *surface.point, continues);
    const bool goes_on = continues && continue_from_surface(run, path, next, *surface.point);
    if (!both || volume_mass <= 0) {
      s = next;
      return goes_on;
    }
    if (goes_on) follow(path, next);  // a camera ray that meets both medium and surface goes on twice
  }
  return volume_mass > 0 && volume_continues && continue_in_volume(run, path, volume_probability);
}

// One more path of the same sample; it takes its first step in the next round.
void PathTracer::follow(const PathSlot& from, const PathState& state) {
  PathSlot& path = new_slot();
  path.state = state;
  path.sample = from.sample;
  path.sampler = from.sampler;
}

bool PathTracer::continue_in_volume(const Run& run, PathSlot& path, double volume_probability) {
  PathState& s = path.state;
  const SobolPoint v = path.numbers(s).point(Decision::continuation);
  const Scattering at = media_.scatter(path.ray(), v[2], volume_probability);
  const PhaseMixture phase(world_, path.march(), at.segment);
  const float cosine_complement = phase.sample(v[4], v[0], v[5]);
  const float pdf_phase = phase.pdf(cosine_complement);
  if (!(at.pdf > 0 && pdf_phase > 0)) return false;

  s.throughput *= at.weight;
  s.first_in_volume |= s.depth == 0;
  ++s.media_scatterings;
  const Vec3d x = s.ray.origin + s.ray.direction * at.t;
  const Vec3f w =
      optics::rotate_from(Vec3f(s.ray.direction), cosine_complement, static_cast<float>(2 * pi) * v[1]);
  const GuidedScattering scattering{x, w, pdf_phase, phase};
  const GuidedShare guided = share_with_guided(run.context, path, s, scattering, v[6]);
  if (guided.sent) follow(path, *guided.sent);
  const LampShare lamps = share_with_lamp_ray(run.context, path, s, scattering, at.segment);
  if (lamps.sent) follow(path, *lamps.sent);
  s.throughput *= phase.eval(cosine_complement) * (1 / pdf_phase);
  s.origin = {PathOrigin::Kind::volume,
              x,
              at.pdf * pdf_phase,
              volume_probability * pdf_phase,
              s.shares,
              &path.ray().light,
              at.segment,
              at.t};
  s.shares = {guided.left, lamps.left, 1};
  s.ray = {x, normalize(Vec3d(w)), infinity, s.ray.time};
  return next_depth(s, *path.sampler);
}

bool PathTracer::continue_from_surface(const Run& run, PathSlot& path, PathState& s,
                                       const SurfacePoint& surface) {
  const SobolPoint v = path.numbers(s).point(Decision::continuation);
  const auto next = surface.sample(v[2], v[0], v[1], v[4]);
  const LampShare lamps = share_with_lamp_ray(run.context, path, s, surface, next);
  if (lamps.sent) follow(path, *lamps.sent);
  if (!next) return false;
  s.throughput *= next->weight;
  const Vec3d& start = surface.start(next->direction);
  s.origin = {next->delta ? PathOrigin::Kind::delta : PathOrigin::Kind::surface,
              start,
              next->pdf,
              next->pdf,
              surface.model ? LightShares{} : s.surface_shares(),
              nullptr,
              0,
              0,
              light_region(run.context, surface)};
  s.ray = {start, next->direction, infinity, s.ray.time};
  if (surface.transmits && dot(surface.normal, next->direction) < 0)
    s.index_scale *= static_cast<float>(sqr(surface.eta));
  if (s.depth == 0) s.branch |= behind_branch;
  s.shares = {1, lamps.left, 1};
  return next_depth(s, *path.sampler);
}

void PathTracer::trace_shadows(const Run& run) {
  const PathOutputs& outputs = run.outputs;
  LightSum sum(outputs.radiance, outputs.aovs, outputs.scattered),
      sum_of_higher(outputs.radiance, outputs.aovs, outputs.scattered);
  for (const ShadowRay& ray :
       shadows_.trace(world_, settings_.transmittance, settings_.orders, run.context.thread)) {
    const LightTarget& target = ray.target;
    if (settings_.light_samples > 1) {
      sum.add(target.sample, target.part, ray.contribution);
      sum_of_higher.add(target.sample, target.higher_part, ray.higher);
    } else {
      outputs.radiance[target.sample] += ray.contribution + ray.higher;
      if (!outputs.aovs.empty()) {
        outputs.aovs[target.sample].add(target.part, ray.contribution);
        outputs.aovs[target.sample].add(target.higher_part, ray.higher);
      }
      if (!outputs.scattered.empty()) {
        outputs.scattered[target.sample].add(target.part, ray.contribution);
        outputs.scattered[target.sample].add(target.higher_part, ray.higher);
      }
    }
    outputs.add_cost(target.sample, ray.segments);
    say_direct_light(outputs, target, ray.contribution);
    outputs.say_light(ray.higher, "light scattered further, approximated");
  }
  sum.finish();
  sum_of_higher.finish();
  shadows_.clear();
}

void PathTracer::trace_emission_rays(const Run& run) {
  const PathOutputs& outputs = run.outputs;
  LightSum sum(outputs.radiance, outputs.aovs, outputs.scattered);
  for (const auto& ray : emission_rays_.trace(world_, run.context.thread)) {
    const LightTarget& target = ray->target;
    if (settings_.light_samples > 1) {
      sum.add(target.sample, target.part, ray->contribution);
      outputs.say_light(ray->contribution, "emission of media, sampled");
    } else {
      outputs.add(target.sample, target.part, ray->contribution, "emission of media, sampled");
    }
    outputs.add_cost(target.sample, ray->march.count);
  }
  sum.finish();
  emission_rays_.clear();
}

}  // namespace tyndall::render
