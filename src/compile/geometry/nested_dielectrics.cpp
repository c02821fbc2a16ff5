#include "compile/geometry/nested_dielectrics.h"

#include <algorithm>

namespace tyndall::compile {

namespace {

// Of a prototype's surfaces and those of its instances, as a Group counts them.
std::vector<std::uint64_t> surface_counts(const scene::Scene& scene) {
  std::vector<std::uint64_t> counts;
  for (const scene::Prototype& p : scene.prototypes) {
    std::uint64_t count = p.shapes.size();
    for (const scene::Instance& i : p.instances) count += counts[i.prototype.index];
    counts.push_back(count);
  }
  return counts;
}

class VolumeRanks {
 public:
  explicit VolumeRanks(const scene::Scene& scene) : scene_(scene), counts_(surface_counts(scene)) {}

  void add(std::span<const scene::Volume> volumes, std::uint64_t first_surface) {
    for (const scene::Volume& v : volumes) {
      auto& rank = ranks.emplace_back();
      if (v.priority)
        rank = {*v.priority, v.boundary ? static_cast<std::int64_t>(first_surface + *v.boundary) : -1};
    }
  }
  void add(std::span<const scene::Instance> instances, std::uint64_t first_surface) {
    for (const scene::Instance& i : instances) {
      const scene::Prototype& p = scene_.prototypes[i.prototype.index];
      add(p.volumes, first_surface);
      add(p.instances, first_surface + p.shapes.size());
      first_surface += counts_[i.prototype.index];
    }
  }
  std::vector<std::optional<SolidRank>> ranks;

 private:
  const scene::Scene& scene_;
  std::vector<std::uint64_t> counts_;
};

// Which prototypes' things that name no material have one of glass somewhere.
std::vector<bool> prototypes_given_glass(const scene::Scene& scene,
                                         std::span<const CompiledMaterial> materials) {
  std::vector<bool> given(scene.prototypes.size());
  const auto give = [&](std::span<const scene::Instance> instances, bool inherits) {
    for (const scene::Instance& i : instances)
      if (i.material.valid() ? materials[i.material.index].transmits : inherits)
        given[i.prototype.index] = true;
  };
  give(scene.instances, false);
  for (std::size_t p = given.size(); p-- > 0;) give(scene.prototypes[p].instances, given[p]);
  return given;
}

// Takes a stay out of the intervals for which `yields(volume)` holds.
template <class Yields>
void take_out(const Intervald& stay, const Yields& yields, std::vector<VolumeInterval>& rest,
              std::vector<VolumeInterval>& intervals) {
  rest.clear();
  for (const VolumeInterval& i : intervals) {
    if (stay.hi <= i.t0 || i.t1 <= stay.lo || !yields(i.volume)) {
      rest.push_back(i);
      continue;
    }
    if (i.t0 < stay.lo) rest.push_back({i.t0, stay.lo, i.volume});
    if (stay.hi < i.t1) rest.push_back({stay.hi, i.t1, i.volume});
  }
  intervals.swap(rest);
}

}  // namespace

std::vector<std::optional<SolidRank>> volume_ranks(const scene::Scene& scene) {
  VolumeRanks all(scene);
  all.add(scene.volumes, 0);
  all.add(scene.instances, scene.shapes.size());
  return std::move(all.ranks);
}

Solids::Solids(const scene::Scene& scene, const Vec3d& origin, std::span<const CompiledMaterial> materials,
               const ShapeParts& parts)
    : materials_(materials), world_(parts, false) {
  const std::vector<bool> given_glass = prototypes_given_glass(scene, materials);
  const auto is_body = [&](const scene::ShapeInstance& s, bool inherits_glass) {
    return !is_sheet(s.shape, parts) &&
           (s.material.valid() ? materials[s.material.index].transmits : inherits_glass);
  };
  std::vector<double> counts;
  const auto bodies = [&](const auto& things, const Group::Keeps& keeps) {
    auto count = static_cast<double>(std::count_if(things.shapes.begin(), things.shapes.end(), keeps));
    for (const scene::Instance& i : things.instances) count += counts[i.prototype.index];
    return count;
  };
  prototypes_.reserve(scene.prototypes.size());  // groups point to earlier ones
  for (const scene::Prototype& p : scene.prototypes) {
    const Group::Keeps keeps = [&, inherits = given_glass[prototypes_.size()]](const auto& s) {
      return is_body(s, inherits);
    };
    counts.push_back(bodies(p, keeps));
    Group group(parts, false);
    group.add(p.shapes, p.moving_shapes, {}, {}, keeps);
    group.add(p.instances, p.moving_instances, prototypes_);
    group.finish();
    prototypes_.push_back(std::move(group));
  }
  const Group::Keeps keeps = [&](const auto& s) { return is_body(s, false); };
  count_ = bodies(scene, keeps);
  const auto body = std::find_if(scene.shapes.begin(), scene.shapes.end(), keeps);
  if (count_ == 1 && body != scene.shapes.end())
    single_ = static_cast<std::uint64_t>(body - scene.shapes.begin());
  world_.add(scene.shapes, scene.motion.shapes, origin, {}, keeps);
  world_.add(scene.instances, scene.motion.instances, prototypes_, origin);
  world_.finish();
}

std::optional<Solids::Holder> Solids::at(const Vec3d& position, double time, RayKind kind) const {
  constexpr double short_way = 0x1p-100;  // a point, but for what has no room for one
  std::optional<Holder> highest;
  world_.for_each_interval({position, {0, 0, 1}, short_way, time}, kind,
                           [&](const GroupBody& body, const Intervald& stay) {
                             const CompiledMaterial& material = materials_[body.material.index];
                             const SolidRank rank{body.priority, static_cast<std::int64_t>(body.number)};
                             // A stay that holds the point begins there.
                             if (!material.transmits || stay.lo != 0 || (highest && rank < highest->rank))
                               return;
                             highest = {rank, material.ior, body.material.index};
                           });
  return highest;
}

void Solids::cut(const Ray& ray, RayKind kind, std::span<const CompiledVolume> volumes,
                 std::vector<VolumeInterval>& intervals) const {
  const bool any = std::any_of(intervals.begin(), intervals.end(),
                               [&](const VolumeInterval& i) { return volumes[i.volume].rank.has_value(); });
  if (!any) return;
  const std::vector<VolumeInterval> whole = intervals;
  std::vector<VolumeInterval> rest;
  world_.for_each_interval({ray.origin, ray.direction, ray.t_max, ray.time}, kind,
                           [&](const GroupBody& body, const Intervald& stay) {
                             if (!materials_[body.material.index].transmits) return;
                             const SolidRank rank{body.priority, static_cast<std::int64_t>(body.number)};
                             const auto yields = [&](std::uint32_t volume) {
                               return volumes[volume].rank && *volumes[volume].rank < rank;
                             };
                             take_out(stay, yields, rest, intervals);
                           });
  for (const VolumeInterval& i : whole) {
    const auto& rank = volumes[i.volume].rank;
    if (!rank) continue;
    const auto yields = [&](std::uint32_t volume) {
      return volumes[volume].rank && volumes[volume].rank->priority < rank->priority;
    };
    take_out({i.t0, i.t1}, yields, rest, intervals);
  }
  std::sort(intervals.begin(), intervals.end(), [](const VolumeInterval& a, const VolumeInterval& b) {
    return a.t0 != b.t0 ? a.t0 < b.t0 : a.volume < b.volume;
  });
}

}  // namespace tyndall::compile
