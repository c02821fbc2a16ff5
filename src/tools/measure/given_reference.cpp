#include "tools/measure/given_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/image.h"
#include "tools/measure/measured_child.h"

namespace tyndall::tools {
namespace {

// Three channels of the names, interleaved; empty where one is missing.
std::vector<float> channels_of(const image::Image& image, const std::string& before) {
  std::vector<std::size_t> channels;
  for (const char* name : {"R", "G", "B"}) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), before + name);
    if (found == image.channels.end()) return {};
    channels.push_back(static_cast<std::size_t>(found - image.channels.begin()));
  }
  std::vector<float> values;
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
    for (const std::size_t channel : channels) values.push_back(image.pixels[i + channel]);
  return values;
}

GivenReference read_here(const std::string& path, int width, int height) {
  const image::ReadResult read = image::read(path);
  if (!read.image) return {.problem = read.error};
  const image::Image& image = *read.image;
  const image::Image::Place whole = image::whole_of(image);
  if (whole.whole_width != width || whole.whole_height != height)
    return {.problem = fmt::format("the reference '{}' has {}x{} pixels, and the scene is rendered with "
                                   "{}x{}: give --resolution {}x{}, or "
                                   "leave --reference away and one is made",
                                   path, whole.whole_width, whole.whole_height, width, height,
                                   whole.whole_width, whole.whole_height)};
  if (image.width != width || image.height != height)
    return {.problem =
                fmt::format("the reference '{}' is a crop of its picture: give the whole picture", path)};
  const std::vector<float> mean = channels_of(image, "");
  if (mean.empty())
    return {.problem = fmt::format(
                "the reference '{}' has no channels R, G and B: give a picture of `render`", path)};
  if (!std::all_of(mean.begin(), mean.end(), [](float value) { return std::isfinite(value); }))
    return {.problem =
                fmt::format("the reference '{}' has values that are not finite: render it anew", path)};
  if (std::all_of(mean.begin(), mean.end(), [](float value) { return value == 0; }))
    return {.problem = fmt::format("the reference '{}' is black: no error is relative to it", path)};
  if (!channels_of(image, "noisy.").empty())
    return {.problem = fmt::format(
                "the reference '{}' is denoised, which is no truth: render it without --denoise", path)};
  const std::vector<float> half = channels_of(image, "half.");
  if (half.empty()) return {.reference = Reference{{mean}}};
  std::vector<float> other(mean.size());
  for (std::size_t i = 0; i < mean.size(); ++i) other[i] = 2 * mean[i] - half[i];
  return {.reference = Reference{{half, other}}};
}

// "!" and the problem, or the numbers of all parts.
std::string bytes_of(const GivenReference& given) {
  if (!given.reference) return "!" + given.problem;
  std::string bytes = "+";
  for (const std::vector<float>& part : given.reference->parts)
    bytes.append(reinterpret_cast<const char*>(part.data()), part.size() * sizeof(float));
  return bytes;
}

}  // namespace

GivenReference read_reference(const std::string& path, int width, int height) {
  // The library of pictures and its threads stay out of this process, which forks and is measured.
  const std::atomic<bool> never{false};
  const ChildResult child = in_child([&] { return bytes_of(read_here(path, width, height)); }, never);
  if (!child.problem.empty())
    return {.problem = fmt::format("cannot read the reference '{}': {}", path, child.problem)};
  if (child.bytes[0] == '!') return {.problem = child.bytes.substr(1)};
  const std::size_t values = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  GivenReference given{.reference = Reference{}};
  for (std::size_t at = 1; at < child.bytes.size(); at += values * sizeof(float)) {
    given.reference->parts.emplace_back(values);
    std::memcpy(given.reference->parts.back().data(), child.bytes.data() + at, values * sizeof(float));
  }
  return given;
}

}  // namespace tyndall::tools
