#include "import/gltf/summary.h"

#include <nlohmann/json.hpp>

#include "import/gltf/accessor.h"
#include "import/gltf/animation.h"

namespace tyndall::gltf {

namespace {

using nlohmann::ordered_json;

// The points of a primitive, and the corners of its triangles or lines.
ordered_json counts_of(const Document& document, const Element& mesh) {
  std::size_t points = 0, corners = 0;
  const Element primitives = mesh["primitives"];
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const Element primitive = primitives.at(i);
    const auto position = document.index(primitive["attributes"], "POSITION", "accessors");
    const auto indices = document.index(primitive, "indices", "accessors");
    const std::size_t own = position ? count_of(document, *position) : 0;
    points += own;
    corners += indices ? count_of(document, *indices) : own;
  }
  return {
      {"name", name_of(mesh)}, {"primitives", primitives.size()}, {"points", points}, {"corners", corners}};
}

ordered_json nodes_of(const Document& document) {
  ordered_json out = ordered_json::array();
  for (std::size_t i = 0; i < document.count("nodes"); ++i) {
    const Element node = document.item("nodes", i);
    ordered_json row{{"name", name_of(node)}};
    for (const char* const list : {"mesh", "skin", "camera"})
      if (const auto held = node.find(list)) row[list] = held->count();
    if (const auto children = node.find("children")) row["children"] = children->json();
    out.push_back(std::move(row));
  }
  return out;
}

ordered_json names_of(const Document& document, const char* list) {
  ordered_json out = ordered_json::array();
  for (std::size_t i = 0; i < document.count(list); ++i) out.push_back(name_of(document.item(list, i)));
  return out;
}

}  // namespace

ordered_json summary(File& file) {
  Document& document = file.document();
  ordered_json out;
  out["generator"] = document.root()["asset"].text("generator");
  out["nodes"] = nodes_of(document);
  out["meshes"] = ordered_json::array();
  for (std::size_t i = 0; i < document.count("meshes"); ++i)
    out["meshes"].push_back(counts_of(document, document.item("meshes", i)));
  out["materials"] = names_of(document, "materials");
  out["animations"] = ordered_json::array();
  for (std::uint32_t i = 0; i < document.count("animations"); ++i)
    out["animations"].push_back(
        {{"name", name_of(document.item("animations", i))}, {"seconds", Animation(document, i).duration()}});
  out["cameras"] = names_of(document, "cameras");
  out["images"] = document.count("images");
  out["extensions"] = ordered_json::array();
  if (const auto used = document.root().find("extensionsUsed")) out["extensions"] = used->json();
  return out;
}

}  // namespace tyndall::gltf
