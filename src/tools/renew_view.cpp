#include "tools/renew_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "image/image.h"
#include "render/film/part_file.h"
#include "tools/part_facts.h"
#include "tools/staleness.h"

namespace tyndall::tools {

namespace {

std::string renew_part(const std::string& path, const PictureIdentity& identity) {
  const render::PartResult read = render::read_part(path);
  if (!read.part) return read.error;
  std::optional<PartFacts> facts = part_facts_from(read.part->text);
  if (!facts) return fmt::format("cannot read '{}': it does not say what it is of", path);
  facts->identity = identity;
  return render::write_part(path, to_text(*facts), read.part->film, read.part->rest);
}

std::string renew_picture(const std::string& path, const PictureIdentity& identity) {
  image::Metadata metadata = image::read_metadata(path).metadata;
  const image::Metadata told =
      metadata_of(identity, {metadata_entry(metadata, "tyndall:samples"), std::nullopt, {}});
  for (const auto& entry : told)
    std::erase_if(metadata, [&](const auto& there) { return there.first == entry.first; });
  metadata.insert(metadata.begin(), told.begin(), told.end());
  return image::retell(path, metadata, view_in(identity));
}

}  // namespace

bool has_other_view(const RenderArguments& arguments) {
  if (is_developed(arguments.output)) return false;
  const auto there = identity_of_finished(arguments.output);
  return there && !view_differences(*there, expected_identity(*there, arguments)).empty();
}

std::string renew_view(const RenderArguments& arguments, FrameSource& source) {
  if (!source.read(arguments)) return {};  // nothing better is known
  const auto there = identity_of_finished(arguments.output);
  if (!there || !differences(*there, source.identity()).empty()) return {};
  return is_part(arguments.output) ? renew_part(arguments.output, source.identity())
                                   : renew_picture(arguments.output, source.identity());
}

}  // namespace tyndall::tools
