// What only the whole scene shows: a missing camera, no light, a light that would shine infinitely bright.
#include "resolve/checks/scene_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "resolve/checks/light_warnings.h"
#include "resolve/checks/medium_warnings.h"
#include "resolve/checks/view_warnings.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// The start of the main file: where what is missing could stand.
Span start(const Run& run) { return {run.main->source, 0, 0}; }

void check_camera(Run& run) {
  if (run.camera.valid()) return;
  run.diagnostics.error(start(run), "the scene has no camera",
                        "write `camera perspective { from: (0, 1, 5) to: (0, 0, 0) }`");
}

// Whether anything in a scene or prototype gives light.
template <class Things>
bool shines(const scene::Scene& s, const Things& things) {
  return std::any_of(things.volumes.begin(), things.volumes.end(),
                     [&](const scene::Volume& v) { return s.media[v.medium.index].emission.has_value(); }) ||
         std::any_of(things.shapes.begin(), things.shapes.end(),
                     [&](const scene::ShapeInstance& shape) {
                       return shape.material.valid() &&
                              s.materials[shape.material.index].emission.has_value();
                     }) ||
         std::any_of(things.instances.begin(), things.instances.end(), [&](const scene::Instance& i) {
           return i.material.valid() && s.materials[i.material.index].emission.has_value();
         });
}

void check_light(Run& run) {
  const scene::Scene& s = run.scene;
  if (!s.lights.empty() || shines(s, s)) return;
  for (const scene::Prototype& prototype : s.prototypes)
    if (shines(s, prototype)) return;
  run.diagnostics.warning(start(run), "nothing shines: the picture will be black",
                          "write `light environment { radiance: 1 }`");
}

// The radiance that fog sends from a point light to a camera at the same place is infinite (transport §3).
void check_light_at_camera(Run& run) {
  const auto has_volumes = [](const auto& things) { return !things.volumes.empty(); };
  if (!has_volumes(run.scene) &&
      std::none_of(run.scene.prototypes.begin(), run.scene.prototypes.end(), has_volumes))
    return;
  const Vec3d eye = std::visit([](const auto& camera) { return camera.from; }, run.scene.camera);
  // Closer than rounding of the transforms that lead to both.
  const double nearest = 1e-9 * (1 + length(eye));
  for (const scene::LightInstance& light : run.scene.lights) {
    const auto place = std::visit([](const auto& l) { return l.point(); }, light.light);
    if (!place || length(*place - eye) > nearest) continue;
    run.diagnostics.error(light.definition,
                          "a light without extent at the camera makes fog infinitely bright",
                          "give it a size: `light sphere { center: … radius: 2cm … }`");
  }
}

// Of the shapes of lights [m²]; others have theirs by their triangles.
template <class S>
std::optional<double> area_of(const S& shape) {
  if constexpr (std::is_same_v<S, scene::Quad>)
    return 4 * length(cross(shape.u, shape.v));
  else if constexpr (scene::is_one_of<S, scene::LightShapes>)
    return shape.area();
  else
    return std::nullopt;
}

// What has a power and hardly an area: its radiance would be no number.
void check_lights_too_small(Run& run) {
  constexpr double most = 1e30;
  for (const scene::LightInstance& instance : run.scene.lights) {
    const auto* light = std::get_if<scene::AreaLight>(&instance.light);
    if (light == nullptr || !light->power) continue;
    const auto area = std::visit([](const auto& shape) { return area_of(shape); }, light->shape);
    const double power = max_component(*light->power);
    if (!area || power <= most * pi * *area) continue;
    run.diagnostics.error(
        instance.definition,
        fmt::format("a light of {:.3g} W with an area of {:.3g} m² is brighter than {:g} W/m²/sr, the most "
                    "that a light may be",
                    power, *area, most),
        "make it larger; what is as small as that is a `light point`");
  }
}

// A ray that glass has bent cannot be aimed at a point: behind it such lights give nothing.
void check_lights_behind_glass(Run& run) {
  const scene::Scene& s = run.scene;
  const auto glass = std::find_if(s.materials.begin(), s.materials.end(),
                                  [](const scene::Material& m) { return m.transmission.has_value(); });
  if (glass == s.materials.end()) return;
  for (const scene::LightInstance& light : s.lights) {
    const std::string_view help = std::visit([](const auto& l) { return l.help_for_size(); }, light.light);
    if (help.empty()) continue;
    run.diagnostics.warning(
        light.definition,
        fmt::format("a light without size gives no light through the glass of '{}'", glass->name),
        std::string(help), {{glass->definition, "the glass is here"}});
  }
}

}  // namespace

void check_overrides(Run& run) {
  for (const Override& o : run.overrides) {
    if (o.used) continue;
    std::vector<std::string_view> lets;
    for (const syntax::SymbolId let : run.file_lets) lets.push_back(run.symbols.text(let));
    std::string help = did_you_mean(run.symbols.text(o.symbol), lets);
    if (help.empty())
      help = lets.empty() ? "the scene has no top-level `let`"
                          : fmt::format("it has: {}", fmt::join(lets, ", "));
    run.diagnostics.error(o.span, fmt::format("no top-level `let {}` to set", run.symbols.text(o.symbol)),
                          std::move(help));
  }
}

void check_scene(Run& run) {
  if (run.diagnostics.has_errors()) return;  // what is missing may stand where something could not be read
  check_camera(run);
  check_light(run);
  check_light_at_camera(run);
  check_lights_too_small(run);
  if (run.diagnostics.has_errors()) return;
  scene::RenderSettings settings = run.scene.settings;
  if (run.options.amend_settings) run.options.amend_settings(settings);
  warn_of_what_is_out_of_view(run, settings);
  warn_of_camera_shut_in(run, settings);
  warn_of_lights_shut_in(run, settings);
  warn_of_lights_turned_away(run, settings);
  warn_of_media(run, settings);
  check_lights_behind_glass(run);
}

}  // namespace tyndall::resolve
