#include "tools/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "tools/frame_list.h"
#include "tools/part_facts.h"
#include "tools/shell_word.h"

namespace tyndall::tools {
namespace {

Words joined(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// A word of a comment: paths are refused that have line breaks.
std::string heading(const Plan& plan) {
  const std::size_t tasks = plan.frames.size(), renders = tasks * std::max<std::size_t>(plan.parts.size(), 1);
  std::string text = fmt::format(
      "# Commands that render {}, made by Tyndall {}.\n"
      "# Any of them may be run again, or twice at a time: what is there already is kept.\n",
      plan.scene, TYNDALL_VERSION);
  if (plan.parts.empty())
    return text +
           "# They do not depend on each other. One after the other: sh -e THIS_FILE\n"
           "# Side by side, with GNU parallel: grep -v '^#' THIS_FILE | parallel\n";
  return text + fmt::format(
                    "# The first {0} render parts, the other {1} merge them when all parts of their frame "
                    "are there.\n"
                    "# One after the other: sh -e THIS_FILE\n"
                    "# Side by side, with GNU parallel: grep -v '^#' THIS_FILE | head -n {0} | parallel &&\n"
                    "#   grep -v '^#' THIS_FILE | tail -n {1} | parallel\n",
                    renders, tasks);
}

}  // namespace

std::vector<std::vector<int>> in_chunks(const std::vector<int>& frames, std::size_t size) {
  std::vector<std::vector<int>> chunks;
  for (std::size_t i = 0; i < frames.size(); i += size)
    chunks.emplace_back(frames.begin() + static_cast<std::ptrdiff_t>(i),
                        frames.begin() + static_cast<std::ptrdiff_t>(std::min(i + size, frames.size())));
  return chunks;
}

std::vector<SampleRange> split_samples(int samples, int count) {
  std::vector<SampleRange> ranges;
  const auto begin = [&](std::int64_t i) { return static_cast<int>(samples * i / count); };
  for (int i = 0; i < count; ++i) ranges.push_back({begin(i), begin(i + 1) - 1});
  return ranges;
}

std::string part_path(const Plan& plan, std::size_t i) {
  const std::filesystem::path output = plan.output;
  const std::string name =
      fmt::format("{}.{}of{}{}", output.stem().string(), i + 1, plan.parts.size(), part_extension);
  return (output.parent_path() / name).string();
}

Words render_words(const Plan& plan) { return joined({plan.program, "render", plan.scene}, plan.options); }

Words frames_words(const Plan& plan, const std::vector<int>& frames) {
  return {"--frames", frames_text(frames), "-o", plan.output, "--resume"};
}

Words part_words(const Plan& plan, const std::string& frame, std::size_t i) {
  const auto& [first, last] = plan.parts[i];
  return {"--frame",
          frame,
          "--sample-range",
          fmt::format("{}..{}", first, last),
          "-o",
          part_path(plan, i),
          "--part-of",
          plan.output,
          "--resume"};
}

Words merge_words(const Plan& plan, const std::string& frame) {
  Words words{plan.program, "merge"};
  for (std::size_t i = 0; i < plan.parts.size(); ++i) words.push_back(part_path(plan, i));
  return joined(std::move(words), {"--frame", frame, "-o", plan.output, "--remove-parts"});
}

std::string plan_lines(const Plan& plan) {
  std::string text = heading(plan);
  const auto add = [&text](const Words& words) { text += shell_words(words) + "\n"; };
  const Words render = render_words(plan);
  if (plan.parts.empty())
    for (const std::vector<int>& frames : plan.frames) add(joined(render, frames_words(plan, frames)));
  const auto number = [](const std::vector<int>& frames) { return fmt::format("{}", frames.front()); };
  for (const std::vector<int>& frames : plan.frames)
    for (std::size_t i = 0; i < plan.parts.size(); ++i)
      add(joined(render, part_words(plan, number(frames), i)));
  if (!plan.parts.empty())
    for (const std::vector<int>& frames : plan.frames) add(merge_words(plan, number(frames)));
  return text;
}

}  // namespace tyndall::tools
