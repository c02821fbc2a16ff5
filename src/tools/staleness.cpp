#include "tools/staleness.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "image/image.h"
#include "render/film/part_file.h"
#include "syntax/parser.h"
#include "tools/content.h"
#include "tools/part_facts.h"
#include "tools/scene_text.h"

namespace tyndall::tools {

namespace {

namespace fs = std::filesystem;

// "--samples was 64, is 128"; nothing where they are the same.
void tell(std::vector<std::string>& told, std::string_view what, const std::string& was,
          const std::string& is) {
  if (was == is) return;
  if (was.empty())
    told.push_back(fmt::format("{} {} is new", what, is));
  else if (is.empty())
    told.push_back(fmt::format("{} was {}, is not given", what, was));
  else
    told.push_back(fmt::format("{} was {}, is {}", what, was, is));
}

void tell_files(std::vector<std::string>& told, const PictureIdentity& was, const PictureIdentity& is) {
  std::map<std::string, std::pair<const std::string*, const std::string*>> files;
  for (const PictureIdentity::File& file : was.files) files[file.path].first = &file.hash;
  for (const PictureIdentity::File& file : is.files) files[file.path].second = &file.hash;
  for (const auto& [path, hashes] : files) {
    const auto& [before, now] = hashes;
    if (before && now && *before == *now) continue;
    const std::string_view what = !before        ? "is read now, and was not"
                                  : !now         ? "was read, and is not now"
                                  : now->empty() ? "cannot be read any more"
                                                 : "has changed";
    told.push_back(fmt::format("'{}' {}", path, what));
  }
}

void tell_overrides(std::vector<std::string>& told, const PictureIdentity& was, const PictureIdentity& is) {
  std::map<std::string, std::pair<std::string, std::string>> values;
  for (const auto& [name, text] : was.overrides) values[name].first = text;
  for (const auto& [name, text] : is.overrides) values[name].second = text;
  for (const auto& [name, texts] : values) tell(told, "--set " + name, texts.first, texts.second);
}

// Those of the view, or the others.
void tell_settings(std::vector<std::string>& told, const PictureIdentity& was, const PictureIdentity& is,
                   bool of_view) {
  std::map<std::string, std::pair<std::string, std::string>> values;
  for (const auto& setting : was.settings) values[setting.name].first = setting.value;
  for (const auto& setting : is.settings) values[setting.name].second = setting.value;
  for (const auto& [name, texts] : values) {
    if (is_view_setting(name) != of_view) continue;
    std::string option = "--" + name;
    std::replace(option.begin(), option.end(), '_', '-');
    tell(told, option, texts.first, texts.second);
  }
}

std::string text_of(const std::optional<render::PixelWindow>& crop) {
  return crop ? fmt::format("{},{},{},{}", crop->x0, crop->y0, crop->x1, crop->y1) : std::string();
}
std::string text_of(const std::optional<SampleRange>& samples) {
  return samples ? fmt::format("{}..{}", samples->first, samples->last) : std::string();
}

// Of the scene text at this path; empty when it cannot be read.
WordsHashes hash_of_text_at(const std::string& path) {
  std::error_code ignored;
  // A pipe would be empty for whoever reads it next.
  std::string text;
  if (!fs::is_regular_file(path, ignored) || !read_scene_text(path, text).empty()) return {};
  Sources sources;
  Diagnostics told_by_rendering;
  const SourceId source = sources.add(path, std::move(text));
  return hash_of_words(syntax::lex(sources, source, told_by_rendering), sources);
}

// What a picture's or part's metadata say.
struct Recorded {
  std::optional<PictureIdentity> identity;
  std::string problem;  // why there is none, or why it is of no use
};

Recorded recorded_in_part(const std::string& path) {
  const render::PartText text = render::read_part_text(path);
  if (!text.error.empty()) return {{}, text.error};
  const auto facts = part_facts_from(text.text);
  if (!facts) return {{}, "it does not tell what it was rendered from"};
  if (facts->is_checkpoint) return {{}, "it is unfinished"};
  return {facts->identity, {}};
}

Recorded recorded_in(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {{}, "it is not there"};
  if (is_part(path)) return recorded_in_part(path);
  const image::ReadResult read = image::read_metadata(path);
  if (!read.error.empty()) return {{}, read.error};
  for (const auto& [entry, why] : {std::pair("tyndall:unfinished", "it is unfinished"),
                                   std::pair("tyndall:interrupted", "it was interrupted"),
                                   std::pair("tyndall:developed", "it was developed from another picture")})
    if (!metadata_entry(read.metadata, entry).empty()) return {{}, why};
  Recorded recorded{identity_from(metadata_entry(read.metadata, identity_entry)), {}};
  if (!recorded.identity) recorded.problem = "it does not tell what it was rendered from";
  return recorded;
}

}  // namespace

std::vector<std::string> differences(const PictureIdentity& was, const PictureIdentity& is) {
  std::vector<std::string> told;
  tell(told, "the program's version", was.version, is.version);
  if (was.text != is.text) told.emplace_back("the scene's text has changed");
  tell_files(told, was, is);
  tell_overrides(told, was, is);
  if (was.include_directories != is.include_directories) told.emplace_back("--include has changed");
  if (was.frame != is.frame) told.push_back(fmt::format("it is frame {}, not {}", was.frame, is.frame));
  tell_settings(told, was, is, false);
  tell(told, "--crop", text_of(was.crop), text_of(is.crop));
  // The number of samples tells of all ranges but parts.
  if (was.setting("samples").value == is.setting("samples").value)
    tell(told, "--sample-range", text_of(was.samples), text_of(is.samples));
  if (told.empty() && was.scene_hash != is.scene_hash) told.emplace_back("the scene has changed");
  return told;
}

std::vector<std::string> view_differences(const PictureIdentity& was, const PictureIdentity& is) {
  std::vector<std::string> told;
  tell_settings(told, was, is, true);
  const auto view_of_file = [](const PictureIdentity::File& file) { return file.view; };
  if (was.view_text != is.view_text ||
      !std::ranges::equal(was.files, is.files, {}, view_of_file, view_of_file))
    told.emplace_back("what the scene says of its view has changed");
  return told;
}

std::vector<std::string> differences(const PictureIdentity& was, const PictureIdentity& is,
                                     const std::string& output) {
  std::vector<std::string> told = differences(was, is);
  if (is_developed(output))
    for (std::string& of_view : view_differences(was, is)) told.push_back(std::move(of_view));
  return told;
}

PictureIdentity expected_identity(const PictureIdentity& was, const RenderArguments& arguments) {
  PictureIdentity is = was;
  const fs::path scene = arguments.scene.path, folder = scene.parent_path();
  WordsHashes words = hash_of_text_at(scene.string());
  is.text = std::move(words.light);
  is.view_text = std::move(words.view);
  for (PictureIdentity::File& file : is.files) {
    const std::string path = (folder / file.path).string();
    if (file.is_text) words = hash_of_text_at(path);
    file.hash = file.is_text ? words.light : hash_of_file(path);
    if (file.is_text) file.view = words.view;
  }
  if (arguments.scene.frame) is.frame = *arguments.scene.frame;
  std::vector<std::pair<std::string, std::string>> own;
  for (const PictureIdentity::Setting& setting : was.settings)
    if (is_setting(setting.name) || is_view_setting(setting.name))
      own.emplace_back(setting.name, setting.scene_value);
  set_options(is, arguments, own);
  return is;
}

std::vector<std::string> why_stale(const RenderArguments& arguments) {
  const Recorded recorded = recorded_in(arguments.output);
  if (!recorded.identity) return {recorded.problem};
  return differences(*recorded.identity, expected_identity(*recorded.identity, arguments), arguments.output);
}

bool has_part(const std::string& path, const PictureIdentity& whole, PictureIdentity part) {
  const auto& [has, wanted] = std::pair(whole.samples, part.samples);
  if (has && wanted && has->first <= wanted->first && wanted->last <= has->last) part.samples = has;
  const auto& outer = whole.crop;
  const auto& inner = part.crop;
  if (!outer || (inner && outer->x0 <= inner->x0 && outer->y0 <= inner->y0 && inner->x1 <= outer->x1 &&
                 inner->y1 <= outer->y1))
    part.crop = whole.crop;
  return differences(whole, part, path).empty();
}

bool is_in_whole(const RenderArguments& arguments) {
  if (arguments.part_of.empty()) return false;
  const auto whole = identity_of_finished(arguments.part_of);
  return whole && has_part(arguments.part_of, *whole, expected_identity(*whole, arguments));
}

std::optional<PictureIdentity> identity_of_finished(const std::string& path) {
  return recorded_in(path).identity;
}

}  // namespace tyndall::tools
