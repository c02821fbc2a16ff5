// EXT_mesh_gpu_instancing: a mesh in many places.
#include <fmt/format.h>

#include <string_view>

#include "import/gltf/accessor.h"
#include "import/gltf/file.h"

namespace tyndall::gltf {

std::vector<Transform> instances_of(Document& document, const Element& node) {
  const auto extension = node.extension("EXT_mesh_gpu_instancing");
  if (!extension) return {Transform{}};
  const Element attributes = (*extension)["attributes"];
  std::optional<std::size_t> count;
  const auto read = [&](std::string_view name, int width) -> std::vector<float> {
    const auto accessor = document.index(attributes, name, "accessors");
    if (!accessor) return {};
    std::vector<float> out = read_floats(document, *accessor, width);
    const std::size_t own = out.size() / static_cast<std::size_t>(width);
    if (count && own != *count)
      attributes[name].fail(fmt::format("is of {} instances, others of {}", own, *count));
    count = own;
    return out;
  };
  const std::vector<float> translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
                           scales = read("SCALE", 3);
  std::vector<Transform> out(count.value_or(1));
  document.take(*extension, static_cast<double>(out.size() * sizeof(Transform)));
  const auto vec = [](const std::vector<float>& list, std::size_t i) {
    return Vec3d(Vec3f(list[3 * i], list[3 * i + 1], list[3 * i + 2]));
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    NodePose pose;
    if (!translations.empty()) pose.translation = vec(translations, i);
    if (!scales.empty()) pose.scale = vec(scales, i);
    if (!rotations.empty()) {
      const std::array<double, 4> q{double{rotations[4 * i]}, double{rotations[4 * i + 1]},
                                    double{rotations[4 * i + 2]}, double{rotations[4 * i + 3]}};
      pose.rotation = normalized(quaternion_of(q.data()));
    }
    out[i] = pose.parent_from_node();
  }
  return out;
}

}  // namespace tyndall::gltf
