// KHR_draco_mesh_compression. The one file that knows Draco.
#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>

#include "import/gltf/attributes.h"
#include "import/malformed.h"

namespace tyndall::gltf {

namespace {

std::unique_ptr<draco::Mesh> decoded(const Element& extension, Bytes bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  try {
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok())
      extension.fail(fmt::format("cannot be unpacked by Draco: {}", result.status().error_msg_string()));
    return std::move(result).value();
  } catch (const std::exception& e) {  // lengths that no memory holds
    extension.fail(fmt::format("cannot be unpacked by Draco: {}", e.what()));
  }
}

Unpacked::Values values_of(const Element& place, const draco::PointAttribute& attribute, std::size_t points) {
  const int width = attribute.num_components();
  if (width < 1 || width > 4) place.fail(fmt::format("has {} numbers a point", width));
  Unpacked::Values out{width, std::vector<float>(points * static_cast<std::size_t>(width))};
  for (std::size_t i = 0; i < points; ++i) {
    const draco::AttributeValueIndex value =
        attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    float* const to = out.numbers.data() + i * static_cast<std::size_t>(width);
    if (value.value() >= attribute.size() ||
        !attribute.ConvertValue<float>(value, static_cast<std::int8_t>(width), to))
      place.fail(fmt::format("has no value of point {}", i));
    for (int k = 0; k < width; ++k)
      if (!std::isfinite(to[k])) place.fail(fmt::format("holds {} in point {}", to[k], i));
  }
  return out;
}

}  // namespace

Unpacked unpacked_draco(Document& document, const Element& extension) {
  const std::uint32_t view = extension["bufferView"].index(document.count("bufferViews"), "bufferViews");
  const auto mesh = decoded(extension, document.view(view));
  const std::size_t points = mesh->num_points(), faces = mesh->num_faces();
  const Element attributes = extension["attributes"];
  Unpacked out;
  for (const auto& [name, id] : attributes.json().items()) {
    const Element place = attributes[name];
    const draco::PointAttribute* const attribute =
        mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(place.count()));
    if (attribute == nullptr)
      place.fail(fmt::format("is {}, which the packed mesh does not have", place.count()));
    document.take(place, static_cast<double>(points) * 16);
    out.attributes.emplace(name, values_of(place, *attribute, points));
  }
  document.take(extension, static_cast<double>(faces) * 12);
  out.indices.reserve(faces * 3);
  for (std::size_t i = 0; i < faces; ++i)
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(static_cast<std::uint32_t>(i))))
      out.indices.push_back(corner.value());
  return out;
}

}  // namespace tyndall::gltf
