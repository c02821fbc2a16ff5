// Scenes and what pictures of them cost, for the benchmarks.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compile/compiled_scene.h"
#include "image/image.h"
#include "render/render.h"
#include "scene/scene.h"

namespace tyndall {

// Parses and resolves; nothing, with the problems printed to stderr, when it has any. `name` is for messages.
// `overrides` are those of --set.
std::optional<scene::Scene> read_scene(const std::string& name, std::string text,
                                       std::vector<std::pair<std::string, std::string>> overrides = {});
std::optional<scene::Scene> load_scene(const std::string& path);

// R, G and B of a film's image, not denoised.
image::Image picture_of(const image::Image& image);

// Time and error of a picture: time times the mean squared relative error against a reference is what a way
// of rendering costs, whatever its number of samples.
struct PictureCost {
  double seconds = 0, relmse = 0;
  double product() const { return seconds * relmse; }
};
PictureCost cost_of(const compile::CompiledScene& world, const render::RenderOptions& options,
                    const image::Image& reference);

// Two ways of rendering one picture: of five rounds each, alternated, the one in the middle by product().
// Each round has other samples, `samples` a pixel; the reference is of the second way.
struct TwoCosts {
  PictureCost first, second;
  double gain() const { return first.product() / second.product(); }
};
TwoCosts alternated_costs(const compile::CompiledScene& world, const render::RenderOptions& first,
                          const render::RenderOptions& second, int samples, int reference_samples);

}  // namespace tyndall
