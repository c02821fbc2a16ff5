// How a scene does without each of its features.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tools/measure/feature_costs.h"

namespace tyndall::tools {
namespace {

using scene::Scene;

// More of a kind are taken out together.
constexpr std::size_t most_by_name = 12;

// Whether anything is open to motion.
bool moves(const Scene& scene) { return scene.animation.shutter.open(); }

void still(Scene& scene) {
  scene.motion = {};
  scene.animation.shutter.closes = scene.animation.shutter.opens;
  for (scene::Prototype& prototype : scene.prototypes) {
    prototype.moving_shapes.clear();
    prototype.moving_instances.clear();
  }
}

// Keeps of the list what `keep` says of its index, and of what moves in it likewise.
template <class T, class Keep>
void keep_moving(std::vector<scene::Moving<T>>& moving, std::size_t count, const Keep& keep) {
  std::vector<std::uint32_t> now(count);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) now[i] = keep(i) ? kept++ : kept;
  std::erase_if(moving, [&](const scene::Moving<T>& m) { return !keep(m.index); });
  for (scene::Moving<T>& m : moving) m.index = now[m.index];
}

template <class Gone>
void remove_volumes(Scene& scene, const Gone& gone) {
  const std::vector<scene::Volume> all = all_volumes(scene);
  keep_moving(scene.motion.volumes, all.size(), [&](std::size_t i) { return !gone(all[i].medium); });
  const auto is_gone = [&](const scene::Volume& volume) { return gone(volume.medium); };
  std::erase_if(scene.volumes, is_gone);
  for (scene::Prototype& prototype : scene.prototypes) std::erase_if(prototype.volumes, is_gone);
}

template <class Gone>
void remove_lights(Scene& scene, const Gone& gone) {
  const std::vector<scene::LightInstance> all = scene.lights;
  keep_moving(scene.motion.lights, all.size(), [&](std::size_t i) { return !gone(i, all[i]); });
  scene.lights.clear();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!gone(i, all[i])) scene.lights.push_back(all[i]);
}

std::string keyword_of(const scene::LightInstance& light) {
  return std::visit(
      []<class L>(const L& l) -> std::string {
        if constexpr (requires { l.keyword(); })
          return std::string(l.keyword());
        else
          return std::string(L::keyword);
      },
      light.light);
}

void add_media(std::vector<Feature>& features, const Scene& scene) {
  std::vector<bool> used(scene.media.size());
  for (const scene::Volume& volume : all_volumes(scene)) used[volume.medium.index] = true;
  const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  if (count > 1)
    features.push_back({fmt::format("all {} media", count), [](Scene& s, RenderArguments&) {
                          remove_volumes(s, [](scene::MediumId) { return true; });
                        }});
  if (count > most_by_name) return;
  std::map<std::string, int> names;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    // Those without a name are called `medium`.
    const std::string& given = scene.media[i].name;
    const std::string name = given == "medium" ? given : "medium " + given;
    const int number = ++names[name];
    features.push_back(
        {number == 1 ? name : fmt::format("{} ({})", name, number), [i](Scene& s, RenderArguments&) {
           remove_volumes(s, [i](scene::MediumId id) { return id.index == i; });
         }});
  }
}

void add_lights(std::vector<Feature>& features, const Scene& scene) {
  std::map<std::string, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) kinds[keyword_of(scene.lights[i])].push_back(i);
  for (const auto& [kind, members] : kinds) {
    if (members.size() > 1)
      features.push_back(
          {fmt::format("{}, all {}", kind, members.size()), [kind = kind](Scene& s, RenderArguments&) {
             remove_lights(s, [&](std::size_t, const scene::LightInstance& light) {
               return keyword_of(light) == kind;
             });
           }});
    if (scene.lights.size() > most_by_name) continue;
    for (std::size_t k = 0; k < members.size(); ++k)
      features.push_back(
          {members.size() == 1 ? kind : fmt::format("{}, number {}", kind, k + 1),
           [i = members[k]](Scene& s, RenderArguments&) {
             remove_lights(s, [i](std::size_t index, const scene::LightInstance&) { return index == i; });
           }});
  }
}

bool has_pictures(const scene::Material& material) { return !material.program.tables.planes.empty(); }

void add_pictures(std::vector<Feature>& features, const Scene& scene) {
  if (std::none_of(scene.materials.begin(), scene.materials.end(), has_pictures)) return;
  features.push_back({"materials with pictures, made grey", [](Scene& s, RenderArguments&) {
                        Scene grey;
                        add_diffuse(grey, Rgb(0.8f));
                        for (scene::Material& material : s.materials)
                          if (has_pictures(material)) material = grey.materials[0];
                      }});
}

void add_depth_of_field(std::vector<Feature>& features, const Scene& scene) {
  const auto* camera = std::get_if<scene::PerspectiveCamera>(&scene.camera);
  if (camera == nullptr || camera->aperture == 0) return;
  features.push_back({"depth of field", [](Scene& s, RenderArguments&) {
                        std::get<scene::PerspectiveCamera>(s.camera).aperture = 0;
                        for (scene::Camera& key : s.motion.camera.keys)
                          if (auto* moving = std::get_if<scene::PerspectiveCamera>(&key))
                            moving->aperture = 0;
                      }});
}

void add_outputs(std::vector<Feature>& features, const RenderArguments& arguments) {
  for (const render::AovInfo& info : render::aov_infos()) {
    const auto aov = render::aov_of_name(info.name);
    if (!aov || !arguments.aovs.has(*aov)) continue;
    features.push_back(
        {fmt::format("output channel {}", info.name), [aov = *aov](Scene&, RenderArguments& a) {
           render::AovSet others;
           for (const render::AovInfo& other : render::aov_infos())
             if (const auto one = render::aov_of_name(other.name); one != aov && a.aovs.has(*one))
               others.add(*one);
           a.aovs = others;
         }});
  }
}

}  // namespace

std::vector<Feature> features_to_take_out(const Scene& scene, const RenderArguments& arguments) {
  std::vector<Feature> features;
  if (moves(scene)) features.push_back({"motion blur", [](Scene& s, RenderArguments&) { still(s); }});
  add_media(features, scene);
  add_lights(features, scene);
  add_pictures(features, scene);
  add_depth_of_field(features, scene);
  add_outputs(features, arguments);
  return features;
}

}  // namespace tyndall::tools
