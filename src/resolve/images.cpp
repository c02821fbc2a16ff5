#include "resolve/images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image/image.h"
#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

PlanePointer plane_of(const image::PlanesResult& read, image::ReadPlane& plane, const std::string& file) {
  // From rows from the top to rows from the bottom.
  const auto width = static_cast<std::ptrdiff_t>(read.width);
  for (std::ptrdiff_t low = 0, high = read.height - 1; low < high; ++low, --high)
    std::swap_ranges(plane.texels.begin() + low * width, plane.texels.begin() + (low + 1) * width,
                     plane.texels.begin() + high * width);
  return make_plane(fmt::format("{} {}", file, read.channels[plane.channel]), read.width, read.height,
                    std::move(plane.texels));
}

}  // namespace

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
  const auto [known, is_new] = known_.try_emplace({image.path, image.channel});
  if (is_new) known->second = decoded(image);
  return known->second;
}

std::vector<PlanePointer> Images::decoded(const eval::Image& image) {
  const auto fail = [&](std::string message, std::string help = {}) -> std::vector<PlanePointer> {
    run_.diagnostics.error(image.span, std::move(message), std::move(help));
    return {};
  };
  image::PlanesResult read = image::read_planes(image.path, image.channel, bytes_left_);
  if (!read.error.empty()) return fail(read.error);
  const std::string file = std::filesystem::path(image.path).filename().string();
  if (read.planes.empty())
    return fail(fmt::format("'{}' has no channel '{}'", file, image.channel),
                fmt::format("it has: {}", fmt::join(read.channels, ", ")));
  std::ptrdiff_t bad = 0;
  for (const image::ReadPlane& plane : read.planes) {
    bad += std::count_if(plane.texels.begin(), plane.texels.end(),
                         [](float value) { return !std::isfinite(value); });
    bytes_left_ -= plane.texels.size() * sizeof(float);
  }
  if (bad > 0)
    run_.diagnostics.warning(image.span, fmt::format("'{}' holds {} values that are not finite", file, bad),
                             "they count as 0");
  std::vector<PlanePointer> planes;
  for (image::ReadPlane& plane : read.planes) planes.push_back(plane_of(read, plane, file));
  if (image.channel.empty()) planes.resize(3, planes[0]);
  return planes;
}

}  // namespace tyndall::resolve
