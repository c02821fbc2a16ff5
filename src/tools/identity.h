// What decided a picture: held in its metadata part by part, so that it can be said why a picture is not the
// one that would be rendered now.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/image.h"
#include "render/context/clamped_light.h"
#include "render/film/film.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

struct PictureIdentity {
  struct File {
    std::string path;  // from the scene's folder
    std::string hash;  // of its words, where it is scene text, or of its bytes (content.h)
    std::string view;  // of those words that say how the picture is shown
    bool is_text = false;
  };
  struct Setting {
    std::string name;         // "light_samples"; its option is --light-samples
    std::string value;        // that the picture has; empty where there is none
    std::string scene_value;  // that it has when the option is not given
  };
  std::string version, simd;
  std::string scene_hash;                                      // of the scene's printed form at this frame
  std::string text, view_text;                                 // hashes of the main file's words
  std::vector<File> files;                                     // that the scene read, by path
  std::vector<std::pair<std::string, std::string>> overrides;  // --set NAME=EXPR
  std::vector<std::string> include_directories;
  int frame = 0;
  std::vector<Setting> settings;  // all but those of the part
  // The part of the picture.
  std::optional<render::PixelWindow> crop;
  std::optional<SampleRange> samples;  // nothing where a goal decides how many there are

  // The number of settings' row of this name; there is one.
  Setting& setting(std::string_view name);
  const Setting& setting(std::string_view name) const;
  // Of --denoise.
  bool is_denoised() const;
};

// The options of these arguments; `own` are the names and texts of what the scene says of `render` and of
// its camera's view.
void set_options(PictureIdentity& identity, const RenderArguments& arguments,
                 const std::vector<std::pair<std::string, std::string>>& own);

// What the picture of these arguments would be made of. The settings of the scene, that of `loaded` wherever
// it has been moved to, are those that it gives itself: apply() comes after this.
PictureIdentity identity_of(const RenderArguments& arguments, const LoadedScene& loaded,
                            const scene::Scene& scene);

// How the picture is shown, or, of light, is to be shown.
image::View view_in(const PictureIdentity& identity);

// A path from the folder of the scene.
std::string path_from_scene(const std::string& scene_path, const std::string& path);

nlohmann::json to_json(const PictureIdentity& identity);
// Nothing when the text is no identity, or one of a kind that this program does not write.
std::optional<PictureIdentity> identity_from(const std::string& json_text);

// What was found about a picture.
struct PictureFindings {
  std::string samples;                                // what is to be said of the samples of a pixel
  std::optional<render::ClampedLight> clamped_light;  // of a scene with a clamp
  std::string step_bias{};                            // in words; empty where steps do not matter
};

// The metadata of a picture: all of its identity, and what was found. Two runs of any thread count write the
// same.
image::Metadata metadata_of(const PictureIdentity& identity, const PictureFindings& found);

// ", clamp removed 1.2% of the light", for the last line; nothing where there is no clamp.
std::string removed_text(const std::optional<render::ClampedLight>& light);

// The metadata's entry of a picture; empty when there is none.
std::string metadata_entry(const image::Metadata& metadata, std::string_view name);
inline constexpr std::string_view identity_entry = "tyndall:identity",
                                  developed_entry = "tyndall:developed";  // by `develop`, and how
// Those that a picture keeps which is made of another one.
inline constexpr std::string_view entries_of_making[] = {
    "tyndall:version",    "tyndall:scene_hash",  "tyndall:frame",     "tyndall:samples",
    "tyndall:seed",       "tyndall:settings",    "tyndall:simd",      identity_entry,
    "tyndall:unfinished", "tyndall:interrupted", "tyndall:step_bias", "tyndall:clamp_removed"};

}  // namespace tyndall::tools
