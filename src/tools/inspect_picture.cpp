#include "tools/inspect_picture.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "image/image.h"
#include "render/film/part_file.h"
#include "tools/identity.h"
#include "tools/part_facts.h"
#include "tools/report.h"

namespace tyndall::tools {

namespace {

constexpr std::string_view ends[] = {"tyndall:unfinished", "tyndall:interrupted", developed_entry};

std::string lines_of(const PictureIdentity& identity, const image::Metadata& metadata) {
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    if (!value.empty()) text += fmt::format("{:<22}{}\n", name, value);
  };
  line("version", identity.version);
  line("simd", identity.simd);
  line("frame", fmt::format("{}", identity.frame));
  line("scene text", identity.text);
  line("scene at this frame", identity.scene_hash);
  for (const auto& file : identity.files) line("file", fmt::format("{}  {}", file.hash, file.path));
  for (const auto& [name, expression] : identity.overrides) line("--set", name + "=" + expression);
  for (const std::string& directory : identity.include_directories) line("--include", directory);
  for (const auto& setting : identity.settings)
    line(setting.name,
         setting.value == setting.scene_value ? setting.value : fmt::format("{} (option)", setting.value));
  line("samples of a pixel", metadata_entry(metadata, "tyndall:samples"));
  if (const auto& crop = identity.crop)
    line("crop", fmt::format("{},{},{},{}", crop->x0, crop->y0, crop->x1, crop->y1));
  for (const std::string_view end : ends) line(end.substr(end.find(':') + 1), metadata_entry(metadata, end));
  return text;
}

nlohmann::json json_of(const PictureIdentity& identity, const image::Metadata& metadata) {
  nlohmann::json json = to_json(identity);
  json["samples_of_a_pixel"] = metadata_entry(metadata, "tyndall:samples");
  for (const std::string_view end : ends)
    if (const std::string value = metadata_entry(metadata, end); !value.empty())
      json[std::string(end.substr(end.find(':') + 1))] = value;
  return json;
}

struct Told {
  std::optional<PictureIdentity> identity;
  image::Metadata metadata;
  std::string error;
};

Told told_by_picture(const std::string& path) {
  image::ReadResult read = image::read_metadata(path);
  return {identity_from(metadata_entry(read.metadata, identity_entry)), std::move(read.metadata),
          std::move(read.error)};
}

Told told_by_part(const std::string& path) {
  render::PartText read = render::read_part_text(path);
  const auto facts = part_facts_from(read.text);
  if (!facts) return {std::nullopt, {}, std::move(read.error)};
  Told told{facts->identity, {}, {}};
  if (const auto& samples = facts->identity.samples)
    told.metadata.emplace_back("tyndall:samples", fmt::format("{}..{}", samples->first, samples->last));
  if (facts->is_checkpoint) told.metadata.emplace_back("tyndall:unfinished", "a checkpoint");
  return told;
}

}  // namespace

bool is_picture(const std::string& path) {
  for (const std::string_view ending : {".exr", ".png", ".jpg", ".jpeg", ".tif", ".tiff"})
    if (path.ends_with(ending)) return true;
  return is_part(path) || path.ends_with(checkpoint_extension);
}

ExitStatus inspect_picture(const std::string& path, bool as_json) {
  const Told told =
      is_part(path) || path.ends_with(checkpoint_extension) ? told_by_part(path) : told_by_picture(path);
  if (!told.error.empty() || !told.identity) {
    print_error(told.error.empty()
                    ? fmt::format("'{}' does not tell what it was rendered from: pictures of this version of "
                                  "tyndall do",
                                  path)
                    : told.error);
    return ExitStatus::problem;
  }
  if (as_json)
    print_json(json_of(*told.identity, told.metadata));
  else
    print_result(lines_of(*told.identity, told.metadata));
  return ExitStatus::done;
}

}  // namespace tyndall::tools
