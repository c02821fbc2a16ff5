#include "tools/frame_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <unordered_set>
#include <utility>

#include "scene/render_settings.h"
#include "tools/numbers.h"

namespace tyndall::tools {
namespace {

std::optional<std::int64_t> read_frame(std::string_view text) {
  const auto number = read_decimal<std::int64_t>(text);
  if (!number || *number < scene::frame_range.least || *number > scene::frame_range.most) return std::nullopt;
  return number;
}

// A single frame or a range.
struct Stretch {
  std::int64_t first = 0, last = 0, step = 1;
};

std::optional<Stretch> read_stretch(std::string_view text) {
  const std::size_t to = text.find("..");
  const auto first = read_frame(text.substr(0, to));
  if (!first) return std::nullopt;
  if (to == std::string_view::npos) return Stretch{*first, *first, 1};
  text.remove_prefix(to + 2);
  const std::size_t by = text.find("..");
  const auto last = read_frame(text.substr(0, by));
  if (!last) return std::nullopt;
  const bool backwards = *last < *first;
  std::int64_t step = backwards ? -1 : 1;
  if (by != std::string_view::npos) {
    const auto given = read_frame(text.substr(by + 2));
    if (!given || *given == 0 || (*given < 0 && !backwards)) return std::nullopt;
    step = std::abs(*given) * step;
  }
  return Stretch{*first, *last, step};
}

// Where the mark is, and how long; of no length where there is none. The last, if there are several.
std::pair<std::size_t, std::size_t> mark_of(std::string_view path) {
  const std::size_t slash = path.rfind('/'), name = slash == std::string_view::npos ? 0 : slash + 1;
  for (std::size_t end = path.size(); end > name;) {
    if (path[end - 1] != '#') {
      --end;
      continue;
    }
    std::size_t begin = end;
    while (begin > name && path[begin - 1] == '#') --begin;
    if (end - begin >= 2) return {begin, end - begin};
    end = begin;
  }
  return {path.size(), 0};
}

}  // namespace

std::optional<std::vector<int>> read_frames(std::string_view text) {
  std::vector<int> frames;
  std::unordered_set<int> known;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto stretch = read_stretch(text.substr(begin, end - begin));
    if (!stretch) return std::nullopt;
    const auto& [first, last, step] = *stretch;
    if (static_cast<std::size_t>(std::abs((last - first) / step)) >= most_frames) return std::nullopt;
    for (std::int64_t frame = first; step > 0 ? frame <= last : frame >= last; frame += step)
      if (known.insert(static_cast<int>(frame)).second) frames.push_back(static_cast<int>(frame));
    if (frames.size() > most_frames) return std::nullopt;
    begin = end + 1;
  }
  return frames;
}

std::string frames_text(std::vector<int> frames) {
  std::sort(frames.begin(), frames.end());
  std::string text;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t end = i + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
    if (!text.empty()) text += ",";
    text += end - i > 2 ? fmt::format("{}..{}", frames[i], frames[end - 1]) : fmt::format("{}", frames[i]);
    i = end - i > 2 ? end : i + 1;
  }
  return text;
}

bool has_frame_mark(std::string_view path) { return mark_of(path).second > 0; }

std::string numbered(const std::string& path, int frame) {
  const auto [begin, length] = mark_of(path);
  if (length == 0) return path;
  return path.substr(0, begin) + fmt::format("{:0{}}", frame, length) + path.substr(begin + length);
}

std::string with_frame_mark(const std::string& path) {
  const std::filesystem::path given(path);
  return (given.parent_path() / (given.stem().string() + ".####" + given.extension().string())).string();
}

}  // namespace tyndall::tools
