#include "resolve/images.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "image/image.h"
#include "image/plane_maker.h"
#include "resolve/kept_parts.h"

namespace tyndall::resolve {

Images::Images(Run& run) : run_(run), memory_(run.options.texture_memory) {
  if (const KeptParts* kept = kept_parts(run); kept && kept->tiles) memory_.tiles = kept->tiles;
}

void Images::keep_in(KeptParts& parts) {
  std::erase_if(known_, [](const auto& known) { return known.second.planes.empty(); });  // not to be read
  parts.images = known_;
  parts.tiles = memory_.tiles;
}

std::string Images::find(const std::string& name, Span span) {
  const auto path = find_file(run_, "picture", name, span);
  if (!path) return {};
  std::error_code failed;
  if (std::filesystem::is_regular_file(*path, failed)) return path->string();
  run_.diagnostics.error(span, fmt::format("cannot read '{}': it is not a file", name));
  return {};
}

std::vector<PlanePointer> Images::planes(const eval::Image& image) {
  if (stand_in_) {
    const PlanePointer black = make_plane("", 1, 1, {0});
    return image.channel.empty() ? std::vector{black, black, black} : std::vector{black};
  }
  const auto [known, is_new] = known_.try_emplace({image.path, image.channel, image.encoding});
  if (!is_new) return known->second.planes;
  const bool is_kept = take_kept(known->first, known->second);
  if (!is_kept) known->second = decoded(image);
  if (run_.options.kept) run_.options.kept->files.count(is_kept);
  if (!known->second.planes.empty())
    note_asset(run_, {image.path, known->second.kind, image.channel}, known->second.bytes);
  return known->second.planes;
}

// What the frame before decoded, as long as this one has the memory for it.
bool Images::take_kept(const Key& key, Decoded& into) {
  const KeptParts* kept = kept_parts(run_);
  if (!kept) return false;
  const auto before = kept->images.find(key);
  if (before == kept->images.end()) return false;
  if (!before->second.is_paged) {
    if (before->second.bytes > memory_.left) return false;
    memory_.left -= before->second.bytes;
  }
  into = before->second;
  return true;
}

void Images::tell_of(const image::PlaneMaker& maker, const eval::Image& image, const std::string& file) {
  if (maker.not_finite() > 0)
    run_.diagnostics.warning(
        image.span, fmt::format("'{}' holds {} values that are not finite", file, maker.not_finite()),
        "they count as 0");
  if (maker.negative() > 0)
    run_.diagnostics.warning(image.span,
                             fmt::format("'{}' holds {} value{} below 0", file, maker.negative(),
                                         maker.negative() == 1 ? "" : "s"),
                             "no colour is negative: they count as 0; a channel that is named, as in "
                             "image(file, \"R\"), is read as it is");
}

Images::Decoded Images::decoded(const eval::Image& image) {
  const auto fail = [&](std::string message, std::string help = {}) -> Decoded {
    run_.diagnostics.error(image.span, std::move(message), std::move(help));
    return {};
  };
  using Negative = image::PlaneMaker::Negative;
  const std::string file = std::filesystem::path(image.path).filename().string();
  // Colours are light or shares of it. A channel that is named may hold numbers of any kind.
  image::PlaneMaker maker(file, image.channel.empty() ? Negative::cleared : Negative::kept, memory_);
  std::optional<image::Encoding> encoding;
  if (image.encoding != eval::Image::Encoding::of_file)
    encoding =
        image.encoding == eval::Image::Encoding::srgb ? image::Encoding::srgb : image::Encoding::linear;
  std::string error = image::read_rows(image.path, image.channel, encoding, maker);
  if (!error.empty()) return fail(error);
  std::vector<PlanePointer> planes = maker.finish(error);
  if (!error.empty()) return fail(fmt::format("cannot read '{}': {}", image.path, error));
  if (planes.empty())
    return fail(fmt::format("'{}' has no channel '{}'", file, image.channel),
                fmt::format("it has: {}", fmt::join(maker.header().channels, ", ")));
  tell_of(maker, image, file);
  if (image.channel.empty()) planes.resize(3, planes[0]);
  return {std::move(planes), maker.is_paged() ? "image in a temporary file" : "image", maker.bytes(),
          maker.is_paged()};
}

}  // namespace tyndall::resolve
