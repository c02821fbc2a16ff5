#include "tools/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "render/film/part_file.h"
#include "tools/numbers.h"
#include "tools/staleness.h"

namespace tyndall::tools {

namespace {

// A part as its file tells of it.
struct ToldPart {
  std::string path;
  PartFacts facts;
  SampleBox box;
};

std::optional<render::PixelWindow> picture_of(const PictureIdentity& identity) {
  const std::string& size = identity.setting("resolution").value;
  const std::size_t x = size.find('x');
  if (x == std::string::npos) return std::nullopt;
  const auto width = read_decimal<int>(std::string_view(size).substr(0, x)),
             height = read_decimal<int>(std::string_view(size).substr(x + 1));
  const auto side = scene::RenderSettings::resolution_range;
  if (!width || !height || !side.holds(*width) || !side.holds(*height)) return std::nullopt;
  return render::PixelWindow{0, 0, *width, *height};
}

int samples_of_whole(const PictureIdentity& identity) {
  return read_decimal<int>(identity.setting("samples").value).value_or(0);
}

// What all parts of a picture have in common.
PictureIdentity without_part(PictureIdentity identity) {
  identity.crop.reset();
  identity.samples.reset();
  identity.setting("samples").value.clear();
  return identity;
}

// Whether an identity has samples and pixels of the picture.
bool is_part_of(const PictureIdentity& identity, const render::PixelWindow& picture) {
  const auto& samples = identity.samples;
  const render::PixelWindow crop = identity.crop.value_or(picture);
  return samples && samples->first >= 0 && samples->first <= samples->last &&
         samples->last < samples_of_whole(identity) && crop.x0 >= 0 && crop.y0 >= 0 && crop.x0 < crop.x1 &&
         crop.y0 < crop.y1 && crop.x1 <= picture.x1 && crop.y1 <= picture.y1;
}

std::string told_part(const std::string& path, ToldPart& told) {
  const render::PartText text = render::read_part_text(path);
  if (!text.error.empty()) return text.error;
  const auto facts = part_facts_from(text.text);
  const auto picture = facts ? picture_of(facts->identity) : std::nullopt;
  if (!picture || !is_part_of(facts->identity, *picture))
    return fmt::format("cannot read '{}': it does not tell which part of a picture it is", path);
  if (facts->is_checkpoint)
    return fmt::format("'{}' is the checkpoint of a render that has not ended: render the same with --resume",
                       path);
  told = {path, *facts, {facts->identity.crop.value_or(*picture), *facts->identity.samples}};
  return {};
}

// What is to be said against parts of one picture, by what they tell.
std::string overlap(const std::vector<ToldPart>& parts, const render::PixelWindow& picture) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const auto both = common(parts[i].box, parts[j].box))
        return fmt::format("'{}' and '{}' both have {}", parts[j].path, parts[i].path,
                           text_of(*both, picture));
  return {};
}

std::string gap_text(const std::vector<SampleBox>& gaps, const render::PixelWindow& picture) {
  constexpr std::size_t most_told = 8;
  std::vector<std::string> told;
  for (std::size_t i = 0; i < std::min(gaps.size(), most_told); ++i)
    told.push_back(text_of(gaps[i], picture));
  if (gaps.size() > most_told) told.push_back(fmt::format("and {} more", gaps.size() - most_told));
  return fmt::format("{}", fmt::join(told, ", "));
}

// Whether each pixel of a film has all of the samples that are told of.
bool is_whole(const render::Film& film, const SampleBox& box) {
  if (film.window() != box.pixels) return false;
  const auto count = static_cast<std::uint32_t>(box.samples.last - box.samples.first + 1);
  for (int y = box.pixels.y0; y < box.pixels.y1; ++y)
    for (int x = box.pixels.x0; x < box.pixels.x1; ++x)
      if (film.samples(x, y) != count) return false;
  return true;
}

// Adds a part to the film, which the first one makes.
std::string add(const ToldPart& part, const render::PixelWindow& window, std::optional<render::Film>& film) {
  const render::PartResult read = render::read_part(part.path);
  if (!read.part) return read.error;
  const render::Film& its = read.part->film;
  if (!film) film.emplace(its.width(), its.height(), its.groups(), its.aovs(), window);
  if (!film->takes(its) || !is_whole(its, part.box))
    return fmt::format("cannot read '{}': its sums are not those that it tells of", part.path);
  film->add(its);
  return {};
}

// The parts' texts, and what is to be said of them: an error, or warnings.
std::string tell_parts(const std::vector<std::string>& paths, std::vector<ToldPart>& parts,
                       std::vector<std::string>& warnings) {
  for (const std::string& path : paths) {
    ToldPart part;
    if (std::string problem = told_part(path, part); !problem.empty()) return problem;
    if (!parts.empty()) {
      const ToldPart& first = parts.front();
      const PictureIdentity &was = first.facts.identity, &is = part.facts.identity;
      if (const auto differing = differences(without_part(was), without_part(is)); !differing.empty())
        return fmt::format("'{}' is no part of the picture that '{}' is of: {}", path, first.path,
                           fmt::join(differing, ", "));
      if (was.simd != is.simd)
        warnings.push_back(
            fmt::format("'{}' was computed with {}, '{}' with {}: last digits may differ from a "
                        "picture of one computer",
                        first.path, was.simd, path, is.simd));
    }
    parts.push_back(std::move(part));
  }
  return {};
}

}  // namespace

MergeResult merge(const MergeRequest& request) {
  MergeResult result;
  std::vector<ToldPart> parts;
  result.error = tell_parts(request.parts, parts, result.warnings);
  if (!result.error.empty()) return result;
  const render::PixelWindow picture = *picture_of(parts.front().facts.identity);
  if (result.error = overlap(parts, picture); !result.error.empty()) return result;
  std::vector<SampleBox> boxes;
  int samples = 0;
  for (const ToldPart& part : parts) {
    boxes.push_back(part.box);
    samples = std::max(samples, samples_of_whole(part.facts.identity));
  }
  const SampleBox there = hull(boxes);
  if (const auto gaps = missing({picture, {0, samples - 1}}, boxes); !gaps.empty() && !request.incomplete) {
    result.error = fmt::format("the picture is not whole: {} are missing; --incomplete takes what there is",
                               gap_text(gaps, picture));
    return result;
  }
  std::optional<render::Film> film;
  for (const ToldPart& part : parts)
    if (result.error = add(part, there.pixels, film); !result.error.empty()) return result;
  Merged& merged =
      result.merged.emplace(Merged{parts.front().facts, missing(there, boxes), std::move(*film), 0});
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (auto& sum = merged.facts.clamped_light; sum && parts[i].facts.clamped_light)
      sum->add_all(*parts[i].facts.clamped_light);
  PictureIdentity& identity = merged.facts.identity;
  identity.setting("samples").value = fmt::format("{}", samples);
  identity.samples = there.samples;
  identity.crop = there.pixels == picture ? std::nullopt : std::optional(there.pixels);
  for (const auto& [pixels, range] : boxes)
    merged.mean_samples += static_cast<double>(pixels.pixels()) * (range.last - range.first + 1) /
                           static_cast<double>(there.pixels.pixels());
  return result;
}

bool is_merged_already(const std::vector<std::string>& parts, const std::string& picture) {
  const auto whole = identity_of_finished(picture);
  if (!whole) return false;
  return std::all_of(parts.begin(), parts.end(), [&](const std::string& path) {
    std::error_code failed;
    ToldPart part;
    return !std::filesystem::exists(path, failed) ||
           (told_part(path, part).empty() && has_part(picture, *whole, part.facts.identity));
  });
}

}  // namespace tyndall::tools
