#include "resolve/motion.h"

#include <array>
#include <cmath>

#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

using scene::Moving;

// Whether motion is even is seen at moments that have no simple part of a period in common.
constexpr std::array probes{0.29, 0.61, 1.0};
constexpr int fine_moments = 32;      // after the first
constexpr double even_enough = 1e-7;  // relative

// Takes things in at one moment after another.
template <class T>
class Keys {
 public:
  explicit Keys(std::vector<Moving<T>>& moving) : moving_(moving) {}

  // `earlier` moments, the first among them, were taken in before. False when the things are others.
  bool add(const std::vector<T>& first, const std::vector<T>& now, std::size_t earlier) {
    if (first.size() != now.size()) return false;
    std::vector<Moving<T>> all;
    auto known = moving_.begin();
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      const bool moved_before = known != moving_.end() && known->index == i;
      if (!moved_before) {
        const std::vector<double> a = moving_numbers(first[i]), b = moving_numbers(now[i]);
        if (a.size() != b.size()) return false;
        if (a == b) continue;
        all.push_back({i, std::vector<T>(earlier, first[i])});
      } else {
        all.push_back(std::move(*known++));
      }
      all.back().keys.push_back(now[i]);
    }
    moving_ = std::move(all);
    return true;
  }

  // Whether the keys at the probes lie evenly between the first and the last.
  bool even() const {
    for (const Moving<T>& thing : moving_)
      for (std::size_t k = 0; k + 1 < probes.size(); ++k) {
        const std::vector<double> a = moving_numbers(thing.keys.front()),
                                  b = moving_numbers(thing.keys.back()),
                                  x = moving_numbers(thing.keys[k + 1]);
        for (std::size_t n = 0; n < a.size(); ++n) {
          const double straight = a[n] + probes[k] * (b[n] - a[n]);
          if (!(std::abs(x[n] - straight) <= even_enough * (std::abs(a[n]) + std::abs(b[n])))) return false;
        }
      }
    return true;
  }
  void keep_ends() {
    for (Moving<T>& thing : moving_) thing.keys.erase(thing.keys.begin() + 1, thing.keys.end() - 1);
  }

 private:
  std::vector<Moving<T>>& moving_;
};

// The lists of a scene and of its prototypes, and what moves of each.
class Lists {
 public:
  explicit Lists(scene::Scene& scene)
      : scene_(scene), volumes_(scene::all_volumes(scene)), camera_{scene.camera} {}

  // False when it has other things than the first.
  bool add(const scene::Scene& now, std::size_t earlier) {
    if (now.prototypes.size() != scene_.prototypes.size()) return false;
    bool same = Keys(camera_motion_).add(camera_, {now.camera}, earlier) &&
                Keys(scene_.motion.shapes).add(scene_.shapes, now.shapes, earlier) &&
                Keys(scene_.motion.instances).add(scene_.instances, now.instances, earlier) &&
                Keys(scene_.motion.volumes).add(volumes_, scene::all_volumes(now), earlier) &&
                Keys(scene_.motion.lights).add(scene_.lights, now.lights, earlier);
    for (std::size_t i = 0; i < scene_.prototypes.size() && same; ++i) {
      scene::Prototype& first = scene_.prototypes[i];
      same = Keys(first.moving_shapes).add(first.shapes, now.prototypes[i].shapes, earlier) &&
             Keys(first.moving_instances).add(first.instances, now.prototypes[i].instances, earlier);
    }
    if (!camera_motion_.empty()) scene_.motion.camera = camera_motion_[0].keys;
    return same;
  }

  bool even() {
    bool all = true;
    each([&](auto keys) { all &= keys.even(); });
    return all;
  }
  void keep_ends() {
    each([](auto keys) { keys.keep_ends(); });
    if (!camera_motion_.empty()) scene_.motion.camera = camera_motion_[0].keys;
  }
  void forget() {
    scene_.motion = {};
    camera_motion_.clear();
    for (scene::Prototype& p : scene_.prototypes) {
      p.moving_shapes.clear();
      p.moving_instances.clear();
    }
  }

 private:
  template <class Visit>
  void each(Visit visit) {
    visit(Keys(camera_motion_));
    visit(Keys(scene_.motion.shapes));
    visit(Keys(scene_.motion.instances));
    visit(Keys(scene_.motion.volumes));
    visit(Keys(scene_.motion.lights));
    for (scene::Prototype& p : scene_.prototypes) {
      visit(Keys(p.moving_shapes));
      visit(Keys(p.moving_instances));
    }
  }

  scene::Scene& scene_;
  std::vector<scene::Volume> volumes_;
  std::vector<scene::Camera> camera_;
  std::vector<Moving<scene::Camera>> camera_motion_;
};

}  // namespace

void find_motion(Run& run, SceneAt scene_at) {
  Lists lists(run.scene);
  const auto read = [&](double fraction, std::size_t earlier) {
    const std::optional<scene::Scene> now = scene_at(run, fraction);
    if (!now) return false;
    if (lists.add(*now, earlier)) return true;
    run.diagnostics.error(
        run.animation, "the scene has other things later while the shutter is open",
        "numbers may depend on `time`, but not how many things there are and of which kind");
    return false;
  };
  std::size_t earlier = 1;
  for (const double fraction : probes)
    if (!read(fraction, earlier++)) return lists.forget();
  if (lists.even()) return lists.keep_ends();
  lists.forget();
  earlier = 1;
  for (int k = 1; k <= fine_moments; ++k)
    if (!read(k / double{fine_moments}, earlier++)) return lists.forget();
}

}  // namespace tyndall::resolve
