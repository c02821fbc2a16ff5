#include "resolve/motion_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "resolve/motion_track.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

using scene::Moving;

// The lists of things of a scene and of its prototypes.
struct Things {
  std::vector<scene::Camera> camera;  // one
  std::vector<scene::ShapeInstance> shapes;
  std::vector<scene::Instance> instances;
  std::vector<scene::Volume> volumes;
  std::vector<scene::LightInstance> lights;
  struct Object {
    std::vector<scene::ShapeInstance> shapes;
    std::vector<scene::Instance> instances;
  };
  std::vector<Object> objects;
};

Things things_of(const scene::Scene& scene) {
  Things out{{scene.camera}, scene.shapes, scene.instances, scene::all_volumes(scene), scene.lights, {}};
  for (const scene::Prototype& p : scene.prototypes) out.objects.push_back({p.shapes, p.instances});
  return out;
}

// How much there is to read at each moment.
std::size_t size_of(const scene::Scene& scene, const Things& things) {
  std::size_t size =
      things.shapes.size() + things.instances.size() + things.volumes.size() + things.lights.size() + 1;
  for (const Things::Object& o : things.objects) size += o.shapes.size() + o.instances.size();
  for (const scene::SharedMesh& m : scene.meshes) size += m->points.size();
  for (const scene::StrandSet& s : scene.strand_sets) size += s.points.size();
  return size;
}

// Whether the two are things of one kind.
template <class T>
bool alike(const T& a, const T& b) {
  return scene::moving_numbers(a).size() == scene::moving_numbers(b).size();
}

// What moves of one list.
template <class T>
class Tracks {
 public:
  // The list at the moments that are looked at first. False when it has other things then.
  bool begin(const std::map<double, const std::vector<T>*>& lists, const Balls& balls) {
    const std::vector<T>& first = *lists.begin()->second;
    for (const auto& [moment, list] : lists)
      if (list->size() != first.size()) return false;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      std::map<double, T> known;
      bool moves = false;
      for (const auto& [moment, list] : lists) {
        const T& now = (*list)[i];
        if (!alike(first[i], now)) return false;
        moves |= scene::moving_numbers(now) != scene::moving_numbers(first[i]);
        known.emplace(moment, now);
      }
      if (moves) tracks_.emplace(i, Track<T>(i, std::move(known), balls));
    }
    first_ = first;
    return true;
  }

  // The list at a later moment.
  bool look(double moment, const std::vector<T>& list, const Balls& balls) {
    if (list.size() != first_.size()) return false;
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      if (!alike(first_[i], list[i])) return false;
      const auto track = tracks_.find(i);
      if (track != tracks_.end())
        track->second.look(moment, list[i], balls);
      else if (scene::moving_numbers(list[i]) != scene::moving_numbers(first_[i]))
        late_.emplace(i, std::map<double, T>{{0, first_[i]}}).first->second.emplace(moment, list[i]);
    }
    return true;
  }

  void decide(const Balls& balls) {
    for (auto& [i, track] : tracks_) track.decide(balls);
    for (auto& [i, known] : late_) {
      known.emplace(1, first_[i]);  // there it stood as it did at first
      tracks_.emplace(i, Track<T>(i, std::move(known), balls));
    }
    late_.clear();
  }

  void add_wanted(std::set<double>& moments) const {
    for (const auto& [i, track] : tracks_) moments.insert(track.wanted().begin(), track.wanted().end());
  }

  // The thing that is farthest off; null when all are near enough.
  const Track<T>* worst() const {
    const Track<T>* found = nullptr;
    for (const auto& [i, track] : tracks_)
      if (track.error() > (found ? found->error() : 0)) found = &track;
    return found;
  }

  std::vector<Moving<T>> result() const {
    std::vector<Moving<T>> out;
    for (const auto& [i, track] : tracks_) out.push_back(track.result());
    return out;
  }

 private:
  std::vector<T> first_;
  std::map<std::uint32_t, Track<T>> tracks_;
  std::map<std::uint32_t, std::map<double, T>> late_;  // what was seen to move only now
};

// What is told of ways that have too many turns.
struct Worst {
  double error = 0;
  Span span{};
};

// What moves of a scene.
class Ways {
 public:
  explicit Ways(std::size_t objects) : objects_(objects) {}

  bool begin(const std::map<double, Things>& seen, const Balls& balls) {
    const std::size_t objects = objects_.size();
    return std::all_of(seen.begin(), seen.end(),
                       [&](const auto& at) { return at.second.objects.size() == objects; }) &&
           each([&](auto& tracks, auto list_of) {
             std::map<double, decltype(&list_of(seen.begin()->second))> lists;
             for (const auto& [moment, things] : seen) lists[moment] = &list_of(things);
             return tracks.begin(lists, balls);
           });
  }
  bool look(double moment, const Things& things, const Balls& balls) {
    return things.objects.size() == objects_.size() &&
           each([&](auto& tracks, auto list_of) { return tracks.look(moment, list_of(things), balls); });
  }
  void decide(const Balls& balls) {
    each([&](auto& tracks, auto) { return tracks.decide(balls), true; });
  }
  std::set<double> wanted() {
    std::set<double> moments;
    each([&](auto& tracks, auto) { return tracks.add_wanted(moments), true; });
    return moments;
  }
  Worst worst(Span camera) {
    Worst found;
    each([&](auto& tracks, auto) {
      const auto* track = tracks.worst();
      if (track && track->error() > found.error) found = {track->error(), span_of(track->first(), camera)};
      return true;
    });
    return found;
  }

  void give_to(scene::Scene& scene) const {
    auto camera = camera_.result();
    if (!camera.empty()) scene.motion.camera = std::move(camera[0]);
    scene.motion.shapes = shapes_.result();
    scene.motion.instances = instances_.result();
    scene.motion.volumes = volumes_.result();
    scene.motion.lights = lights_.result();
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      scene.prototypes[i].moving_shapes = objects_[i].shapes.result();
      scene.prototypes[i].moving_instances = objects_[i].instances.result();
    }
  }

 private:
  static Span span_of(const auto& thing, Span) { return thing.definition; }
  static Span span_of(const scene::Camera&, Span camera) { return camera; }

  // Calls visit(tracks, list_of) for each list until it returns false.
  template <class Visit>
  bool each(Visit visit) {
    bool all = visit(
                   camera_, [](const Things& t) -> auto& { return t.camera; }) &&
               visit(
                   shapes_, [](const Things& t) -> auto& { return t.shapes; }) &&
               visit(
                   instances_, [](const Things& t) -> auto& { return t.instances; }) &&
               visit(
                   volumes_, [](const Things& t) -> auto& { return t.volumes; }) &&
               visit(
                   lights_, [](const Things& t) -> auto& { return t.lights; });
    for (std::size_t i = 0; i < objects_.size() && all; ++i)
      all = visit(
                objects_[i].shapes, [i](const Things& t) -> auto& { return t.objects[i].shapes; }) &&
            visit(
                objects_[i].instances, [i](const Things& t) -> auto& { return t.objects[i].instances; });
    return all;
  }

  Tracks<scene::Camera> camera_;
  Tracks<scene::ShapeInstance> shapes_;
  Tracks<scene::Instance> instances_;
  Tracks<scene::Volume> volumes_;
  Tracks<scene::LightInstance> lights_;
  struct Object {
    Tracks<scene::ShapeInstance> shapes;
    Tracks<scene::Instance> instances;
  };
  std::vector<Object> objects_;
};

void report_too_fast(Run& run, const Worst& worst, int moments) {
  run.diagnostics.error(
      worst.span,
      fmt::format("turns too often or moves too unevenly while the shutter is open: between {} moments it is "
                  "off its way by up "
                  "to {:.2g} "
                  "times what would be seen",
                  moments, worst.error),
      "close the shutter sooner, or let it turn or swing less often: a blur of many turns looks like that of "
      "one");
}

}  // namespace

void report_other_things(Run& run) {
  run.diagnostics.error(run.animation, "the scene has other things later while the shutter is open",
                        "numbers may depend on `time`, but not how many things there are and of which kind");
}

void find_motion(Run& run, SceneAt scene_at) {
  const Balls balls(run.scene);
  std::map<double, SceneThen> scenes;
  std::map<double, Things> seen;
  seen[0] = things_of(run.scene);
  const std::size_t size = size_of(run.scene, seen[0]);
  const int most =
      static_cast<int>(std::clamp<std::size_t>(max_moments_of_things / size, least_max_moments, max_moments));
  const auto [a, b] = tests_between(0, 1);
  for (const double moment : {a, b, 1.0}) {
    std::optional<SceneThen> now = scene_at(run, moment);
    if (!now || !deforms_only(run, *now)) return;
    seen[moment] = things_of(now->scene);
    scenes.emplace(moment, std::move(*now));
  }
  Ways ways(run.scene.prototypes.size());
  if (!ways.begin(seen, balls)) return report_other_things(run);
  add_deformation(run, scene_at, scenes);
  int moments = static_cast<int>(seen.size());
  seen.clear();
  scenes.clear();
  for (std::set<double> wanted = ways.wanted(); !wanted.empty(); wanted = ways.wanted()) {
    if (moments + static_cast<int>(wanted.size()) > most) break;
    moments += static_cast<int>(wanted.size());
    for (const double moment : wanted) {
      const std::optional<SceneThen> now = scene_at(run, moment);
      if (!now) return;
      if (!ways.look(moment, things_of(now->scene), balls)) return report_other_things(run);
    }
    ways.decide(balls);
  }
  const Worst worst = ways.worst(run.camera);
  if (worst.error > 0) report_too_fast(run, worst, moments);
  ways.give_to(run.scene);
}

}  // namespace tyndall::resolve
