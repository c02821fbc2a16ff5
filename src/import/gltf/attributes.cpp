#include "import/gltf/attributes.h"

#include <fmt/format.h>

#include "import/gltf/accessor.h"

namespace tyndall::gltf {

Attributes::Attributes(Document& document, const Element& primitive)
    : document_(document), primitive_(primitive), attributes_(primitive["attributes"]) {
  if (const auto packed = primitive.extension("KHR_draco_mesh_compression"))
    unpacked_ = unpacked_draco(document, *packed);
  if (!has("POSITION")) return;
  points_ = unpacked_ && unpacked_->attributes.contains("POSITION")
                ? unpacked_->attributes.at("POSITION").numbers.size() / 3
                : count_of(document, accessor("POSITION"));
}

bool Attributes::has(const std::string& name) const { return attributes_.find(name).has_value(); }

std::uint32_t Attributes::accessor(const std::string& name) const {
  return attributes_[name].index(document_.count("accessors"), "accessors");
}

std::vector<float> Attributes::read(const std::string& name, int width) {
  if (!has(name)) return {};
  std::vector<float> out;
  if (unpacked_ && unpacked_->attributes.contains(name)) {
    Unpacked::Values& values = unpacked_->attributes.at(name);
    if (values.width != width)
      attributes_[name].fail(fmt::format("has {} numbers where {} are wanted", values.width, width));
    out = std::move(values.numbers);
    unpacked_->attributes.erase(name);
  } else {
    out = read_floats(document_, accessor(name), width);
  }
  if (out.size() != points_ * static_cast<std::size_t>(width))
    attributes_[name].fail(fmt::format("is of {} points, and POSITION of {}",
                                       out.size() / static_cast<std::size_t>(width), points_));
  return out;
}

std::vector<float> Attributes::read_colors() {
  if (!has("COLOR_0")) return {};
  const bool packed = unpacked_ && unpacked_->attributes.contains("COLOR_0");
  const int width =
      packed ? unpacked_->attributes.at("COLOR_0").width : width_of(document_, accessor("COLOR_0"));
  if (width == 4) return read("COLOR_0", 4);
  const std::vector<float> rgb = read("COLOR_0", 3);
  std::vector<float> out(points_ * 4, 1.0f);
  for (std::size_t i = 0; i < points_; ++i)
    for (std::size_t k = 0; k < 3; ++k) out[4 * i + k] = rgb[3 * i + k];
  return out;
}

std::vector<std::uint32_t> Attributes::read_joints(const std::string& name) {
  std::vector<std::uint32_t> out;
  if (unpacked_ && unpacked_->attributes.contains(name)) {
    for (const float f : read(name, 4)) out.push_back(static_cast<std::uint32_t>(f));
    return out;
  }
  out = read_counts(document_, accessor(name), 4);
  if (out.size() != 4 * points_)
    attributes_[name].fail(fmt::format("is of {} points, and POSITION of {}", out.size() / 4, points_));
  return out;
}

std::optional<std::vector<std::uint32_t>> Attributes::indices() {
  if (unpacked_) return std::move(unpacked_->indices);
  const auto index = document_.index(primitive_, "indices", "accessors");
  if (!index) return std::nullopt;
  return read_counts(document_, *index);
}

}  // namespace tyndall::gltf
