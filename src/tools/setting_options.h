// The options that give parameters of `render {}` in the scene's place: one for each row of
// scene::RenderSettings.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/render_settings.h"

namespace CLI {
class App;
}

namespace tyndall::tools {

struct GivenSettings {
  scene::RenderSettings values;
  std::set<std::string_view> names;  // of those among `values` that were given

  // A setting, when it was given.
  template <class T>
  std::optional<T> get(T scene::RenderSettings::*wanted) const {
    std::optional<T> value;
    scene::RenderSettings::fields([&](auto member, const scene::SettingInfo& info) {
      if constexpr (std::is_same_v<decltype(member), T scene::RenderSettings::*>)
        if (member == wanted && names.contains(info.name)) value = values.*member;
    });
    return value;
  }
};

void add_setting_options(CLI::App& command, GivenSettings& given);

// The scene's settings with those of the command line in their place.
void apply(const GivenSettings& given, scene::RenderSettings& settings);

// What was given as it is written on the command line: {"--samples", "16"}.
std::vector<std::pair<std::string_view, std::string>> as_options(const GivenSettings& given);

// All settings by name, as the metadata of pictures tell them.
std::vector<std::pair<std::string, std::string>> as_texts(const scene::RenderSettings& settings);
// Whether one has this name.
bool is_setting(std::string_view name);
// What a setting is told as when the scene's own is told as `own`.
std::string text_of(const GivenSettings& given, std::string_view name, const std::string& own);

// Whether the metadata of a picture tell the setting of this name in an entry of its own.
bool has_own_entry(std::string_view name);

}  // namespace tyndall::tools
