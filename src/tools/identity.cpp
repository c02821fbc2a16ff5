#include "tools/identity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "syntax/parser.h"
#include "tools/choices.h"
#include "tools/content.h"
#include "tools/numbers.h"
#include "vm/run/machine.h"

namespace tyndall::tools {

namespace {

namespace fs = std::filesystem;

using File = PictureIdentity::File;
using Setting = PictureIdentity::Setting;

// The files that the scene read, the main one left out.
std::vector<File> files_of(const LoadedScene& loaded, const std::string& scene_path) {
  std::map<std::string, SourceId> texts;
  for (std::uint32_t i = 0; i < loaded.sources.size(); ++i)
    if (SourceId(i) != loaded.source)
      texts[loaded.sources[SourceId(i)].name()] = SourceId(i);  // as it was read last
  std::vector<File> files;
  for (const std::string& path : loaded.files_read) {
    File file{path_from_scene(scene_path, path), {}, {}, false};
    if (const auto text = texts.find(path); text != texts.end()) {
      Diagnostics told_already;
      file.is_text = true;
      const syntax::TokenList tokens = syntax::lex(loaded.sources, text->second, told_already);
      WordsHashes words = hash_of_words(tokens, loaded.sources);
      file.hash = std::move(words.light);
      file.view = std::move(words.view);
    } else {
      file.hash = hash_of_file(path);
    }
    files.push_back(std::move(file));
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.path < b.path; });
  return files;
}

std::string aov_text(const render::AovSet& aovs) {
  std::string text;
  for (const render::AovInfo& info : render::aov_infos())
    if (aovs.has(info.aov)) text += fmt::format("{}{}", text.empty() ? "" : ",", info.name);
  return text;
}

// The settings that only the command line has.
std::vector<Setting> option_settings(const RenderArguments& arguments) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  const RenderArguments usual;
  const auto of = [&](const RenderArguments& a) {
    return std::vector<std::pair<std::string, std::string>>{
        {"method", std::string(name(a.method))},
        {"distance", std::string(name(a.distance))},
        {"transmittance", std::string(name(a.transmittance))},
        {"emission", std::string(name_in(emissions, a.emission_sampling))},
        {"error", number(a.error)},
        {"time_limit", number(a.time_limit)},
        {"aov", aov_text(a.aovs)},
        {"denoise", a.denoise ? "on" : ""}};
  };
  const auto values = of(arguments), usual_values = of(usual);
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < values.size(); ++i)
    settings.push_back({values[i].first, values[i].second, usual_values[i].second});
  return settings;
}

// Null when there is none of this name.
Setting* find_setting(std::vector<Setting>& settings, std::string_view name) {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [name](const Setting& setting) { return setting.name == name; });
  return found == settings.end() ? nullptr : &*found;
}

}  // namespace

std::string path_from_scene(const std::string& scene_path, const std::string& path) {
  std::error_code failed;
  const fs::path folder = fs::path(scene_path).parent_path();
  const fs::path relative = fs::proximate(path, folder.empty() ? fs::path(".") : folder, failed);
  return failed ? path : relative.generic_string();
}

Setting& PictureIdentity::setting(std::string_view name) {
  Setting* found = find_setting(settings, name);
  CHECK(found != nullptr);
  return *found;
}
const Setting& PictureIdentity::setting(std::string_view name) const {
  return const_cast<PictureIdentity&>(*this).setting(name);
}

bool PictureIdentity::is_denoised() const {
  return std::any_of(settings.begin(), settings.end(), [](const Setting& setting) {
    return setting.name == "denoise" && !setting.value.empty();
  });
}

void set_options(PictureIdentity& identity, const RenderArguments& arguments,
                 const std::vector<std::pair<std::string, std::string>>& own) {
  const bool has_goal = arguments.error || arguments.time_limit;
  identity.settings.clear();
  for (const auto& [name, text] : own) {
    if (is_view_setting(name)) continue;
    const bool unlimited = name == "samples" && has_goal && !arguments.settings.names.contains(name);
    identity.settings.push_back({name, unlimited ? "" : text_of(arguments.settings, name, text), text});
  }
  for (Setting& setting : option_settings(arguments)) identity.settings.push_back(std::move(setting));
  for (const auto& [name, text] : own)
    if (is_view_setting(name)) identity.settings.push_back({name, text_of(arguments.view, name, text), text});
  identity.crop = arguments.crop;
  identity.samples.reset();
  identity.overrides = arguments.scene.overrides;
  identity.include_directories = arguments.scene.include_directories;
  identity.version = TYNDALL_VERSION;
  identity.simd = vm::simd_name();
  if (has_goal) return;
  Setting& count = identity.setting("samples");
  const int wanted = read_decimal<int>(count.value).value_or(1);
  identity.samples = arguments.sample_range.value_or(SampleRange{0, wanted - 1});
  count.value = fmt::format("{}", std::max(wanted, identity.samples->last + 1));
}

PictureIdentity identity_of(const RenderArguments& arguments, const LoadedScene& loaded,
                            const scene::Scene& scene) {
  PictureIdentity identity;
  std::vector<std::pair<std::string, std::string>> own = as_texts(scene.settings);
  for (auto& text : as_texts(view_of(scene))) own.push_back(std::move(text));
  set_options(identity, arguments, own);
  identity.scene_hash = hash_of_text(scene::print(scene, scene::Printed::as_light));
  const WordsHashes words = hash_of_words(loaded.tokens, loaded.sources);
  identity.text = words.light;
  identity.view_text = words.view;
  identity.files = files_of(loaded, arguments.scene.path);
  identity.frame = scene.frame;
  return identity;
}

image::View view_in(const PictureIdentity& identity) {
  const auto text = [&](std::string_view name) -> const std::string& { return identity.setting(name).value; };
  const image::View usual;
  return {.exposure = image::read_exposure(text(exposure_setting)).value_or(usual.exposure),
          .tonemap = image::read_tonemap(text(tonemap_setting)).value_or(usual.tonemap)};
}

nlohmann::json to_json(const PictureIdentity& identity) {
  nlohmann::json files = nlohmann::json::array(), settings = nlohmann::json::array();
  for (const File& file : identity.files)
    files.push_back(
        {{"path", file.path}, {file.is_text ? "words" : "bytes", file.hash}, {"view", file.view}});
  for (const Setting& setting : identity.settings)
    settings.push_back({{"name", setting.name}, {"value", setting.value}, {"scene", setting.scene_value}});
  nlohmann::json result{{"version", identity.version},  {"simd", identity.simd},
                        {"scene", identity.scene_hash}, {"text", identity.text},
                        {"view", identity.view_text},   {"files", files},
                        {"set", identity.overrides},    {"include", identity.include_directories},
                        {"frame", identity.frame},      {"settings", settings}};
  if (const auto& crop = identity.crop) result["crop"] = {crop->x0, crop->y0, crop->x1, crop->y1};
  if (const auto& samples = identity.samples) result["samples"] = {samples->first, samples->last};
  return result;
}

std::optional<PictureIdentity> identity_from(const std::string& json_text) try {
  const nlohmann::json json = nlohmann::json::parse(json_text);
  PictureIdentity identity;
  json.at("version").get_to(identity.version);
  json.at("simd").get_to(identity.simd);
  json.at("scene").get_to(identity.scene_hash);
  json.at("text").get_to(identity.text);
  json.at("view").get_to(identity.view_text);
  for (const nlohmann::json& file : json.at("files")) {
    const bool is_text = file.contains("words");
    identity.files.push_back(
        {file.at("path"), file.at(is_text ? "words" : "bytes"), file.at("view"), is_text});
  }
  json.at("set").get_to(identity.overrides);
  json.at("include").get_to(identity.include_directories);
  json.at("frame").get_to(identity.frame);
  for (const nlohmann::json& setting : json.at("settings"))
    identity.settings.push_back({setting.at("name"), setting.at("value"), setting.at("scene")});
  constexpr std::string_view all_have[] = {"resolution", "samples",        "seed",
                                           "aov",        exposure_setting, tonemap_setting};
  for (const std::string_view needed : all_have)
    if (!find_setting(identity.settings, needed)) return std::nullopt;
  if (json.contains("crop")) {
    const auto [x0, y0, x1, y1] = json.at("crop").get<std::array<int, 4>>();
    identity.crop = {x0, y0, x1, y1};
  }
  if (json.contains("samples")) {
    const auto [first, last] = json.at("samples").get<std::array<int, 2>>();
    identity.samples = SampleRange{first, last};
  }
  return identity;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

namespace {

std::string share_text(const render::ClampedLight& light) {
  return fmt::format("{:.3g}% of the light", 100 * light.share());
}

}  // namespace

std::string removed_text(const std::optional<render::ClampedLight>& light) {
  return light ? ", clamp removed " + share_text(*light) : std::string();
}

image::Metadata metadata_of(const PictureIdentity& identity, const PictureFindings& found) {
  std::string settings;
  for (const auto& [name, value, scene_value] : identity.settings) {
    if (value.empty() || has_own_entry(name)) continue;
    settings += fmt::format("{}{}={}", settings.empty() ? "" : " ", name, value);
  }
  if (const auto& crop = identity.crop)
    settings += fmt::format(" crop={},{},{},{}", crop->x0, crop->y0, crop->x1, crop->y1);
  image::Metadata told{
      {"Software", "Tyndall " + identity.version},
      {"tyndall:version", identity.version},
      {"tyndall:scene_hash", identity.scene_hash},
      {"tyndall:frame", fmt::format("{}", identity.frame)},
      {"tyndall:samples", found.samples},
      {"tyndall:seed", identity.setting("seed").value},
      {"tyndall:settings", settings},
      {"tyndall:simd", identity.simd},
      {std::string(identity_entry),
       to_json(identity).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)},
  };
  if (found.clamped_light) told.emplace_back("tyndall:clamp_removed", share_text(*found.clamped_light));
  if (!found.step_bias.empty()) told.emplace_back("tyndall:step_bias", found.step_bias);
  return told;
}

std::string metadata_entry(const image::Metadata& metadata, std::string_view name) {
  for (const auto& [key, value] : metadata)
    if (key == name) return value;
  // All but an EXR hold them in one text, a line each.
  const std::string begin = fmt::format("{}: ", name);
  for (const auto& [key, value] : metadata) {
    if (key != "ImageDescription") continue;
    for (std::size_t at = 0; at < value.size();) {
      const std::size_t end = std::min(value.find('\n', at), value.size());
      const std::string_view line = std::string_view(value).substr(at, end - at);
      if (line.starts_with(begin)) return std::string(line.substr(begin.size()));
      at = end + 1;
    }
  }
  return {};
}

}  // namespace tyndall::tools
