#include "render/path/path_gather.h"

#include "optics/light_sampling.h"
#include "render/path/emission_sampling.h"
#include "render/path/emitter_mis.h"

namespace tyndall::render {

namespace {

struct Gathering {
  const PathContext& context;
  const PathSlot& path;
  const PathOutputs& outputs;

  const PathState& state() const { return path.state; }
  void add(const Rgb& light, LightPart part, std::string_view what) const {
    outputs.add(path.sample, part, light, what);
  }
  float mis_weight(const EmitterPoint& hit) const {
    return mis_weight_of_light(context.world, context.settings.light_samples, path.state, hit, context.media);
  }
};

void gather_emission(const Gathering& g) {
  const PathState& s = g.state();
  const March& m = g.path.march();
  if (is_black(m.emitted)) return;
  const PathSettings& settings = g.context.settings;
  const float share =
      settings.emission ? mis_weight_of_emission(*settings.emission, settings.light_samples, s) : 1;
  const bool first = s.depth == 0 && s.branch == 0;
  g.add(s.throughput * m.emitted * share, first ? LightPart::volume_emission : s.part(s.depth),
        "emission of media");
}

void gather_infinity(const Gathering& g, const Rgb& at_end) {
  const compile::CompiledScene& world = g.context.world;
  const PathState& s = g.state();
  if (!world.features.environment && !world.features.distant_discs) return;
  for (std::uint32_t i = 0; i < world.lights.size(); ++i) {
    const Rgb radiance = compile::LightAt(world, i, s.ray.time)->radiance_from_infinity(s.ray.direction);
    if (!is_black(radiance))
      g.add(at_end * radiance * g.mis_weight({i, {}, {}}), s.part(s.depth), "a light at infinity");
  }
}

void gather_light(const Gathering& g, const compile::SurfaceHit& hit, const Rgb& at_end) {
  const PathState& s = g.state();
  const Rgb radiance =
      compile::LightAt(g.context.world, hit.light, s.ray.time)->emitted(s.ray.direction, hit.normal);
  if (!is_black(radiance))
    g.add(at_end * radiance * g.mis_weight({hit.light, hit.position, hit.normal}), s.part(s.depth),
          "a light hit");
}

}  // namespace

void PathGather::gather(const PathContext& context, const PathSlot& path, const PathOutputs& outputs) {
  const Gathering g{context, path, outputs};
  const PathState& s = path.state;
  const March& m = path.march();
  gather_emission(g);
  surfaces_.clear();
  const auto meet = [&](const SurfacePoint& point, const Rgb& throughput, float share) {
    g.add(throughput * point.emission * share, s.part(s.depth), "emission of a surface");
    surfaces_.add(point, throughput);
  };
  for (std::size_t k = 0; k < path.crossings.size(); ++k) {
    const SurfacePoint& point = path.crossings[k].surface;
    meet(point, s.throughput * m.crossings[k].before * point.opacity, 1);
  }
  const Rgb at_end = s.throughput * m.end_transmittance();
  const auto& hit = path.hit;
  if (!hit) {
    gather_infinity(g, at_end);
  } else if (hit->light != compile::no_index) {
    gather_light(g, *hit, at_end);
  } else {
    end_ = evaluate_surface(context.world, *hit, s.ray.direction, context.thread);
    const bool sampled = hit->glow != compile::no_index;
    meet(*end_, at_end, sampled ? g.mis_weight({hit->glow, hit->position, hit->normal}) : 1);
  }
}

void PathGather::meet_surfaces(const PathContext& context, const PathSlot& path) {
  surfaces_.clear();
  const PathState& s = path.state;
  const March& m = path.march();
  for (std::size_t k = 0; k < path.crossings.size(); ++k) {
    const SurfacePoint& point = path.crossings[k].surface;
    surfaces_.add(point, s.throughput * m.crossings[k].before * point.opacity);
  }
  if (!path.hit || path.hit->light != compile::no_index) return;
  end_ = evaluate_surface(context.world, *path.hit, s.ray.direction, context.thread);
  surfaces_.add(*end_, s.throughput * m.end_transmittance());
}

void PathGather::record(const PathSlot& path, AovSample& out) const {
  const PathState& s = path.state;
  const March& m = path.march();
  out.cost += 1 + m.count;
  if (s.depth > 0) return;
  out.transmittance = m.end_transmittance();
  out.optical_depth = m.optical_depth();
  out.albedo = m.total_scattered() + surfaces_.scattered();
  const auto meet = [&](double t, const Vec3d& n) {
    out.hit_surface = true;
    out.depth = t;
    out.normal = Vec3f(dot(n, s.ray.direction) > 0 ? -n : n);
  };
  if (path.hit) meet(path.hit->t, path.hit->normal);
  // The nearest one that is mostly there hides those behind it.
  for (auto c = path.crossings.rbegin(); c != path.crossings.rend(); ++c)
    if (c->surface.opacity >= 0.5f) meet(c->t, c->surface.normal);
}

}  // namespace tyndall::render
