// How pictures are shown, as the command line says it in place of what the scene or the picture says.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/view.h"
#include "scene/scene.h"

namespace CLI {
class App;
}

namespace tyndall::tools {

struct GivenView {
  std::optional<image::Exposure> exposure;
  std::optional<image::Tonemap> tonemap;
  std::optional<Rgb> white;
  std::optional<double> bloom;
};

// --exposure and --tonemap; `instead_of` ends their help: "in place of the camera's".
void add_view_options(CLI::App& command, GivenView& given, const std::string& instead_of);

// --white-balance and --bloom.
void add_lens_options(CLI::App& command, GivenView& given);

// A view with what was given in its place.
image::View in_place(const GivenView& given, image::View view);

// That of the scene's camera.
image::View view_of(const scene::Scene& scene);

// Whether a picture of this name is developed, so that its numbers depend on the view: an .exr and a part
// hold light.
bool is_developed(const std::string& output);

// What these options decide, by name as settings are: {"exposure", "auto"}.
std::vector<std::pair<std::string, std::string>> as_texts(const image::View& view);
// What is told of one of them when the scene's own is told as `own`.
std::string text_of(const GivenView& given, std::string_view name, const std::string& own);
bool is_view_setting(std::string_view name);
inline constexpr std::string_view exposure_setting = "exposure", tonemap_setting = "tonemap";

}  // namespace tyndall::tools
