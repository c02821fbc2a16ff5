#include "render/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/check.h"
#include "base/numerics.h"
#include "optics/light_sampling.h"
#include "render/decisions.h"
#include "render/emission_light.h"
#include "render/light_met.h"
#include "render/light_sum.h"
#include "render/path_light.h"
#include "render/path_roulette.h"
#include "render/path_state.h"
#include "render/path_sunward.h"
#include "render/propagation.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;
using compile::Ray;
using compile::RayKind;

// Sample s of g groups is sample s / g of group s mod g; each group is a scrambling of its own.
Sampler sampler_for(const CompiledScene& world, const PathSettings& settings, const CameraSample& s) {
  const auto groups = static_cast<std::uint64_t>(settings.groups);
  const std::uint64_t seed = world.scene.settings.seed;
  return {groups == 1 ? seed : hash_bits(seed, 1 + s.sample % groups),
          static_cast<std::uint32_t>(world.scene.frame), static_cast<std::uint32_t>(s.x),
          static_cast<std::uint32_t>(s.y), static_cast<std::uint32_t>(s.sample / groups)};
}

class PathTracer {
 public:
  PathTracer(const CompiledScene& world, const CameraRays& camera, const PathSettings& settings,
             std::span<const CameraSample> samples, Worker& worker, const PathOutputs& outputs)
      : world_(world),
        camera_(camera),
        settings_(settings),
        context_{world, settings, worker},
        samples_(samples),
        worker_(worker),
        radiance_(outputs.radiance),
        aovs_(outputs.aovs),
        trace_(outputs.trace),
        deadline_(outputs.deadline) {}

  // All paths go one ray on at a time: rays, one march of all, what each meets, one batch of shadow rays.
  // False when the deadline passed before the last of them ended.
  bool run() {
    std::fill(radiance_.begin(), radiance_.end(), Rgb{});
    std::fill(aovs_.begin(), aovs_.end(), AovSample{});
    while (start_paths(), active_ > 0) {
      if (deadline_ != nullptr && deadline_->passed()) return false;
      worker_.march_requests.clear();
      for (std::size_t i = 0; i < active_; ++i) trace_ray(slot(i));
      propagate(world_, settings_, std::span(worker_.slots).first(active_), worker_);
      const std::size_t before = active_;
      for (std::size_t i = 0; i < before; ++i) {
        ended_.push_back(!advance(i));
        if (worker_.shadows.size() >= shadows_together) trace_shadows();
      }
      trace_shadows();
      trace_emission_rays();
      remove_ended();
    }
    return true;
  }

 private:
  PathSlot& slot(std::size_t i) { return *worker_.slots[i]; }

  // The next free slot, its memory from an earlier path.
  PathSlot& new_slot() {
    if (active_ == worker_.slots.size()) worker_.slots.push_back(std::make_unique<PathSlot>());
    return slot(active_++);
  }

  // New camera samples take the places of paths that have ended.
  void start_paths() {
    while (active_ < paths_together() && started_ < samples_.size()) {
      const CameraSample& s = samples_[started_];
      PathSlot& path = new_slot();
      path.sampler = sampler_for(world_, settings_, s);
      path.sample = static_cast<std::uint32_t>(started_++);
      const SobolPoint u = path.sampler->point(decision(Decision::pixel, 0, 0));
      path.state = {};
      const double time = world_.features.motion ? path.sampler->point(decision(Decision::time, 0, 0))[0] : 0;
      path.state.ray = camera_.ray(s.x, s.y, u[0], u[1], u[2], u[3], time);
      ++worker_.statistics.samples;
    }
  }

  // Keeps the order of the others: a sample's light is added in an order of its own.
  void remove_ended() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < active_; ++i)
      if (i >= ended_.size() || !ended_[i]) std::swap(worker_.slots[kept++], worker_.slots[i]);
    active_ = kept;
    ended_.clear();
  }

  void trace_ray(PathSlot& path) {
    PathState& s = path.state;
    path.current ^= 1;
    ++worker_.statistics.rays;
    const RayKind kind = s.origin.kind == PathOrigin::Kind::camera ? RayKind::camera : RayKind::scattered;
    const auto hit = world_.features.walks_surfaces()
                         ? trace_through(world_, s.ray, kind, worker_, path.crossings)
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
    path_ = &path;
    request_propagation(world_, settings_, path, kind, worker_);
  }

  // What the ray of path i gathers, the direct light along it, and its next ray. False when the path ends.
  bool advance(std::size_t i) {
    path_ = &slot(i);
    PathState& s = path_->state;
    const March& m = path_->march();
    if (trace_)
      say("{}depth {} ray from ({:.6g}, {:.6g}, {:.6g}) along ({:.6g}, {:.6g}, {:.6g}): {} segments, "
          "transmittance {:.6g}, throughput {:.6g}\n",
          s.is_sunward() ? "  towards the sun: "
          : s.branch     ? "  behind: "
                         : "",
          s.depth, s.ray.origin.x + world_.origin.x, s.ray.origin.y + world_.origin.y,
          s.ray.origin.z + world_.origin.z, s.ray.direction.x, s.ray.direction.y, s.ray.direction.z, m.count,
          luminance(m.end_transmittance()), luminance(s.throughput));

    if (s.is_sunward()) {
      if (!aovs_.empty()) aovs_[path_->sample].cost += 1 + m.count;
      light_sunward(context_, *path_, s);
      return false;
    }
    gather_emission(s, m);
    meet_surfaces(s, m);
    if (!aovs_.empty()) record(s, m);
    if (s.depth > static_cast<std::uint32_t>(settings_.bounces)) {
      const Rgb carried = s.throughput * m.total_scattered() + met_.scattered();
      worker_.statistics.cut_paths += m.scatters() || !met_.empty();
      worker_.statistics.cut_throughput += max_component(carried);
      return false;
    }
    if (s.media_scatterings > settings_.real_scatterings) return false;
    const bool continues =
        s.depth < static_cast<std::uint32_t>(settings_.bounces) || settings_.gathers_after_last;
    if (settings_.method == Method::tracking)
      light_aimed(context_, *path_, s, continues && continues_in_volumes(s));
    return scatter(s, m, path_->light(), continues);
  }

  bool continues_in_volumes(const PathState& s) const {
    return s.media_scatterings < settings_.real_scatterings || settings_.gathers_after_last;
  }

  // The surfaces that the ray goes through, and what it ends at. Adds their light.
  void meet_surfaces(const PathState& s, const March& m) {
    met_.clear();
    const auto meet = [&](const SurfacePoint& point, const Rgb& throughput, float share) {
      add(throughput * point.emission * share, s.part(s.depth), "emission of a surface");
      met_.add(point, throughput);
    };
    for (std::size_t k = 0; k < path_->crossings.size(); ++k) {
      const SurfacePoint& point = path_->crossings[k].surface;
      meet(point, s.throughput * m.crossings[k].before * point.opacity, 1);
    }
    const Rgb at_end = s.throughput * m.end_transmittance();
    const auto& hit = path_->hit;
    if (!hit) {
      gather_infinity(s, at_end);
    } else if (hit->light != compile::no_index) {
      gather_light(s, *hit, at_end);
    } else {
      end_surface_ = evaluate_surface(world_, *hit, s.ray.direction, worker_);
      const bool sampled = hit->glow != compile::no_index;
      meet(*end_surface_, at_end, sampled ? weight(s, hit->glow, hit->position, hit->normal) : 1);
    }
  }

  // What the outputs beside the picture keep of a ray.
  void record(const PathState& s, const March& m) {
    AovSample& out = aovs_[path_->sample];
    out.cost += 1 + m.count;
    if (s.depth > 0) return;
    out.transmittance = m.end_transmittance();
    out.optical_depth = m.optical_depth();
    out.albedo = m.total_scattered() + met_.scattered();
    const auto meet = [&](double t, const Vec3d& n) {
      out.met_surface = true;
      out.depth = t;
      out.normal = Vec3f(dot(n, s.ray.direction) > 0 ? -n : n);
    };
    if (path_->hit) meet(path_->hit->t, path_->hit->normal);
    // The nearest one that is mostly there hides those behind it.
    for (auto c = path_->crossings.rbegin(); c != path_->crossings.rend(); ++c)
      if (c->surface.opacity >= 0.5f) meet(c->t, c->surface.normal);
  }

  // Whether light is summed apart before a sample's is.
  bool sums_apart() const { return settings_.light_samples > 1; }

  void trace_shadows() {
    LightSum sum(radiance_, aovs_), sum_of_higher(radiance_, aovs_);
    for (const ShadowRay& ray :
         worker_.shadows.trace(world_, settings_.transmittance, settings_.orders, worker_)) {
      if (sums_apart()) {
        sum.add(ray.sample, ray.part, ray.contribution);
        sum_of_higher.add(ray.sample, ray.higher_part, ray.higher);
      } else {
        radiance_[ray.sample] += ray.contribution + ray.higher;
        if (!aovs_.empty()) {
          aovs_[ray.sample].add(ray.part, ray.contribution);
          aovs_[ray.sample].add(ray.higher_part, ray.higher);
        }
      }
      if (!aovs_.empty()) aovs_[ray.sample].cost += 1 + ray.segments;
      if (trace_ && !is_black(ray.contribution))
        say("  + ({:.6g}, {:.6g}, {:.6g}) direct light\n", ray.contribution.x, ray.contribution.y,
            ray.contribution.z);
      if (trace_ && !is_black(ray.higher))
        say("  + ({:.6g}, {:.6g}, {:.6g}) light scattered further, approximated\n", ray.higher.x,
            ray.higher.y, ray.higher.z);
    }
    sum.finish();
    sum_of_higher.finish();
    worker_.shadows.clear();
  }

  void trace_emission_rays() {
    LightSum sum(radiance_, aovs_);
    for (const auto& ray : worker_.emission_rays.trace(world_, worker_)) {
      if (sums_apart()) {
        sum.add(ray->sample, ray->part, ray->contribution);
      } else {
        radiance_[ray->sample] += ray->contribution;
        if (!aovs_.empty()) aovs_[ray->sample].add(ray->part, ray->contribution);
      }
      if (!aovs_.empty()) aovs_[ray->sample].cost += 1 + ray->march.count;
      if (trace_ && !is_black(ray->contribution))
        say("  + ({:.6g}, {:.6g}, {:.6g}) emission of media, sampled\n", ray->contribution.x,
            ray->contribution.y, ray->contribution.z);
    }
    sum.finish();
    worker_.emission_rays.clear();
  }

  // Direct light in the volume and on a surface, and the choice of the next ray.
  bool scatter(PathState& s, const March& m, LightStrategies& strategies, bool continues) {
    const double volume_mass = std::max(0.0f, luminance(s.throughput * m.total_scattered())),
                 surface_mass = met_.mass();
    if (!(volume_mass + surface_mass > 0)) return false;
    const bool both =
        s.origin.kind == PathOrigin::Kind::camera;  // camera rays follow both, deeper ones choose
    const bool volume_continues = continues && continues_in_volumes(s);
    const double volume_probability = both               ? (volume_mass > 0)
                                      : volume_continues ? volume_mass / (volume_mass + surface_mass)
                                                         : 0;
    if (!flies(settings_.method))
      strategies.set(world_, m, s.throughput, settings_.method, settings_.distance,
                     settings_.orders_after(s.media_scatterings));
    strategies.set_distant(s.share_of_distant, false);
    if (volume_mass > 0) light_volume(context_, *path_, s, strategies, volume_continues, volume_probability);

    const bool chooses = surface_mass > 0 && (!both || met_.several());
    const double u = chooses ? point(Decision::end_or_volume, s)[0] : 0;
    if (surface_mass > 0 && (both || u >= volume_probability)) {
      const double part = both ? u : (u - volume_probability) / (1 - volume_probability);
      const MetSurface& surface = met_.choose(part);
      const double probability = surface.mass / surface_mass * (both ? 1 : 1 - volume_probability);
      PathState next = s;
      next.throughput = surface.throughput * static_cast<float>(1 / probability);
      light_surface(context_, *path_, next, *surface.point, continues);
      const bool goes_on = continues && continue_from_surface(next, *surface.point);
      if (!both || volume_mass <= 0) {
        s = next;
        return goes_on;
      }
      if (goes_on) follow(next);  // a camera ray that meets both medium and surface goes on twice
    }
    return volume_mass > 0 && volume_continues && continue_in_volume(s, m, strategies, volume_probability);
  }

  // One more path of the sample at work; it takes its first step in the next round.
  void follow(const PathState& state) {
    PathSlot& from = *path_;
    PathSlot& path = new_slot();
    path.state = state;
    path.sample = from.sample;
    path.sampler = from.sampler;
  }

  bool continue_in_volume(PathState& s, const March& m, const LightStrategies& strategies,
                          double volume_probability) {
    const SobolPoint v = point(Decision::continuation, s);
    const Scattering at = draw_scattering(settings_, *path_, v[3], v[2], volume_probability);
    worker_.phase.set(world_, m, at.segment);
    const float cosine_complement = worker_.phase.sample(v[4], v[0], v[5]);
    const float pdf_phase = worker_.phase.pdf(cosine_complement);
    if (!(at.pdf > 0 && pdf_phase > 0)) return false;

    s.throughput *= at.weight;
    s.first_in_volume |= s.depth == 0;
    ++s.media_scatterings;
    const Vec3d x = s.ray.origin + s.ray.direction * at.t;
    const Vec3f w =
        optics::rotate_from(Vec3f(s.ray.direction), cosine_complement, static_cast<float>(2 * pi) * v[1]);
    const SunwardShare sunward = share_with_sunward(context_, *path_, s, strategies, x, w, pdf_phase, v[6]);
    if (sunward.sent) follow(*sunward.sent);
    s.throughput *= worker_.phase.eval(cosine_complement) * (1 / pdf_phase);
    s.origin = {PathOrigin::Kind::volume, x,           at.pdf * pdf_phase, volume_probability * pdf_phase,
                s.share_of_distant,       &strategies, at.segment,         at.t};
    s.share_of_distant = sunward.left;
    s.ray = {x, normalize(Vec3d(w)), infinity, s.ray.time};
    return next_depth(s, sampler());
  }

  bool continue_from_surface(PathState& s, const SurfacePoint& surface) {
    const SobolPoint v = point(Decision::continuation, s);
    const auto next = surface.sample(v[2], v[0], v[1], v[3]);
    if (!next) return false;
    s.throughput *= next->weight;
    const Vec3d& start = surface.start(next->direction);
    s.origin = {next->delta ? PathOrigin::Kind::delta : PathOrigin::Kind::surface,
                start,
                next->pdf,
                next->pdf,
                1,
                nullptr,
                0,
                0};
    s.ray = {start, next->direction, infinity, s.ray.time};
    if (surface.transmits && dot(surface.normal, next->direction) < 0)
      s.index_scale *= static_cast<float>(sqr(surface.eta));
    if (s.depth == 0) s.branch |= behind_branch;
    s.share_of_distant = 1;
    return next_depth(s, sampler());
  }

  void gather_emission(const PathState& s, const March& m) {
    if (is_black(m.emitted)) return;
    const float share =
        settings_.emission ? weight_of_met_emission(*settings_.emission, settings_.light_samples, s) : 1;
    const bool first = s.depth == 0 && s.branch == 0;
    add(s.throughput * m.emitted * share, first ? LightPart::volume_emission : s.part(s.depth),
        "emission of media");
  }

  void gather_infinity(const PathState& s, const Rgb& at_end) {
    if (!world_.features.environment && !world_.features.distant_discs) return;
    for (std::uint32_t i = 0; i < world_.lights.size(); ++i) {
      const Rgb radiance =
          optics::radiance_from_infinity(*compile::LightAt(world_, i, s.ray.time), s.ray.direction);
      if (!is_black(radiance))
        add(at_end * radiance * weight(s, i, {}, {}) * share_of_met(s, i), s.part(s.depth),
            "a light at infinity");
    }
  }

  // Of the light that a ray from a medium meets: of distant ones part was left to rays sent for it.
  float share_of_met(const PathState& s, std::uint32_t light) const {
    return std::holds_alternative<optics::DistantLight>(world_.lights[light]) ? s.origin.share_of_distant : 1;
  }

  void gather_light(const PathState& s, const compile::SurfaceHit& hit, const Rgb& at_end) {
    const Rgb radiance =
        optics::emitted(*compile::LightAt(world_, hit.light, s.ray.time), s.ray.direction, hit.normal);
    if (!is_black(radiance))
      add(at_end * radiance * weight(s, hit.light, hit.position, hit.normal), s.part(s.depth), "a light met");
  }

  float weight(const PathState& s, std::uint32_t light, const Vec3d& y, const Vec3d& normal) {
    return weight_of_met_light(world_, settings_.light_samples, s, light, y, normal, worker_);
  }

  // How many paths advance together, at least while there are samples: their segments fill batches of
  // hundreds of lanes. Where no medium varies there are few segments, and more paths would leave the cache.
  std::size_t paths_together() const { return world_.features.heterogeneous ? 192 : 16; }

  // Shadow rays of more paths wait for each other no longer than this.
  static constexpr std::size_t shadows_together = 1 << 14;

  const Sampler& sampler() const { return *path_->sampler; }
  std::uint64_t id(Decision d, const PathState& s) const { return decision(d, s.depth, s.branch); }
  SobolPoint point(Decision d, const PathState& s) const { return sampler().point(id(d, s)); }
  void add(const Rgb& radiance, LightPart part, std::string_view what) {
    radiance_[path_->sample] += radiance;
    if (!aovs_.empty()) aovs_[path_->sample].add(part, radiance);
    if (trace_ && !is_black(radiance))
      say("  + ({:.6g}, {:.6g}, {:.6g}) {}\n", radiance.x, radiance.y, radiance.z, what);
  }
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(*trace_), format, std::forward<Args>(args)...);
  }

  const CompiledScene& world_;
  const CameraRays& camera_;
  const PathSettings& settings_;
  const PathContext context_;
  std::span<const CameraSample> samples_;
  Worker& worker_;
  std::span<Rgb> radiance_;
  std::span<AovSample> aovs_;
  std::string* trace_;
  const Deadline* deadline_;
  std::size_t active_ = 0, started_ = 0;  // slots in use: the first; samples begun: the first
  std::vector<bool> ended_;               // of the slots that advanced in this round
  PathSlot* path_ = nullptr;              // the one at work
  // Of its ray.
  MetSurfaces met_;
  std::optional<SurfacePoint> end_surface_;
};

}  // namespace

bool trace_paths(const CompiledScene& world, const CameraRays& camera, const PathSettings& settings,
                 std::span<const CameraSample> samples, Worker& worker, const PathOutputs& outputs) {
  CHECK_EQ(samples.size(), outputs.radiance.size());
  return PathTracer(world, camera, settings, samples, worker, outputs).run();
}

}  // namespace tyndall::render
