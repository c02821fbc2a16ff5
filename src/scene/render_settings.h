// The parameters of `render {}`, a row each. What reads them from a scene, checks and prints them, the
// options of the command line, the metadata of pictures and the manual derive from these rows.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/fields.h"
#include "scene/clamp.h"
#include "scene/multiple_scattering.h"
#include "scene/ranges.h"
#include "scene/step.h"

namespace tyndall::scene {

// The size of a picture in pixels.
struct Resolution {
  int width = 640, height = 360;
};

// Where the metadata of a picture tell a setting: in the list of them, or in an entry of its own.
enum class ToldIn : std::uint8_t { settings, own_entry };

struct SettingInfo : FieldInfo {
  std::string_view option;  // of the command line, in place of what the scene says
  std::string_view help;    // of that option
  // Of whole numbers, where it is narrower than what their type holds.
  std::optional<WholeRange> range = std::nullopt;
  ToldIn told_in = ToldIn::settings;
};

struct RenderSettings {
  static constexpr std::string_view keyword = "render";
  static constexpr WholeRange resolution_range{1, 16384};  // a side: the film stays addressable
  static constexpr WholeRange samples_range{1, 1 << 30};
  static constexpr WholeRange light_samples_range{1, 65536};
  static constexpr WholeRange bounces_range{0, 1 << 30};

  Resolution resolution;
  int samples = 64;
  Step step;  // volumes may override it
  int light_samples = 1;
  int bounces = 1024;
  std::uint64_t seed = 0;
  MultipleScattering multiple_scattering;
  Clamp clamp;

  template <class F>
  static void fields(F&& field) {
    using S = RenderSettings;
    field(&S::resolution, SettingInfo{{"resolution", "the picture's (width, height) in pixels"},
                                      "--resolution",
                                      "Size of the picture in pixels, in place of the scene's",
                                      resolution_range,
                                      ToldIn::own_entry});
    field(&S::samples, SettingInfo{{"samples", "paths through each pixel"},
                                   "--samples",
                                   "Samples per pixel, in place of the scene's",
                                   samples_range,
                                   ToldIn::own_entry});
    field(&S::step,
          SettingInfo{
              {"step",
               "length of a march's segments: `auto`, > 0 [m], `adaptive(tolerance)` or `auto(tolerance)`",
               Quantity::length},
              "--step",
              "Length of a step through a volume in metres; auto: as long as keeps the picture right; "
              "adaptive(TOLERANCE): likewise, to this share of it; auto(TOLERANCE): as long as proven bounds "
              "of the density allow; in place of the scene's (a volume's own stays)"});
    field(&S::light_samples, SettingInfo{{"light_samples", "light points for each path segment"},
                                         "--light-samples",
                                         "Direct-light samples a march, in place of the scene's",
                                         light_samples_range});
    field(&S::bounces, SettingInfo{{"bounces", "scatterings and reflections at most"},
                                   "--bounces",
                                   "Scatterings after the first, in place of the scene's",
                                   bounces_range});
    field(&S::seed, SettingInfo{{"seed", "of the random numbers, a whole number >= 0"},
                                "--seed",
                                "Seed of the random numbers, in place of the scene's",
                                std::nullopt,
                                ToldIn::own_entry});
    field(&S::multiple_scattering,
          SettingInfo{
              {"multiple_scattering", "of light in media: `full`, or `approximate(…)`, which see"},
              "--multiple-scattering",
              "Follow light through all scatterings in media, or approximate those after the first ones, in "
              "place of what the scene says"});
    field(
        &S::clamp,
        SettingInfo{
            {"clamp",
             "the most that one path may bring, > 0 [radiance]: for direct and indirect light each, or "
             "`(direct, "
             "indirect)`; `off`: no limit. Makes pictures darker, which is told"},
            "--clamp",
            "Limit what one path may bring to a pixel, for direct and indirect light each; less noise, and a "
            "darker picture, as the last line tells; in place of what the scene says"});
  }
};

}  // namespace tyndall::scene
