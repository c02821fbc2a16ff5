// Small glTF files made by code, for tests with known answers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace tyndall {

using nlohmann::json;

inline std::filesystem::path write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

enum ComponentType { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };
template <class T>
constexpr ComponentType component_type() {
  if constexpr (std::is_same_v<T, std::int8_t>) return int8;
  if constexpr (std::is_same_v<T, std::uint8_t>) return uint8;
  if constexpr (std::is_same_v<T, std::int16_t>) return int16;
  if constexpr (std::is_same_v<T, std::uint16_t>) return uint16;
  if constexpr (std::is_same_v<T, std::uint32_t>) return uint32;
  return float32;
}

struct GltfWriter {
  json root = {{"asset", {{"version", "2.0"}}}};
  std::string binary;

  // The index of a new element of a list.
  std::size_t add(const char* list, json element) {
    root[list].push_back(std::move(element));
    return root[list].size() - 1;
  }
  template <class T>
  std::size_t view(const std::vector<T>& numbers) {
    while (binary.size() % 4 != 0) binary += '\0';
    const std::size_t offset = binary.size();
    binary.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    return add("bufferViews",
               {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", numbers.size() * sizeof(T)}});
  }
  template <class T>
  std::size_t accessor(const std::vector<T>& numbers, const std::string& type) {
    const std::size_t width = type == "SCALAR" ? 1
                              : type == "MAT4" ? 16
                                               : static_cast<std::size_t>(type[3] - '0');
    json out = {{"bufferView", view(numbers)},
                {"componentType", component_type<T>()},
                {"count", numbers.size() / width},
                {"type", type}};
    // Points and times must have their range.
    if (component_type<T>() == float32 && (type == "VEC3" || type == "SCALAR") && !numbers.empty())
      for (std::size_t k = 0; k < width; ++k) {
        T least = numbers[k], most = numbers[k];
        for (std::size_t i = k; i < numbers.size(); i += width) {
          least = std::min(least, numbers[i]);
          most = std::max(most, numbers[i]);
        }
        out["min"].push_back(least);
        out["max"].push_back(most);
      }
    return add("accessors", std::move(out));
  }
  // A primitive of these points, in order.
  json primitive(const std::vector<float>& points) {
    return {{"attributes", {{"POSITION", accessor(points, "VEC3")}}}};
  }
  std::size_t mesh(json primitive) {
    return add("meshes", {{"primitives", json::array({std::move(primitive)})}});
  }
  // A triangle (0, 0, 0) (1, 0, 0) (0, 1, 0).
  std::size_t triangle() { return mesh(primitive({0, 0, 0, 1, 0, 0, 0, 1, 0})); }
  std::size_t node(json node) { return add("nodes", std::move(node)); }

  static void note_extensions(const json& value, std::set<std::string>& used) {
    if (!value.is_structured()) return;
    for (const auto& [key, inner] : value.items()) {
      if (key == "extensions" && inner.is_object())
        for (const auto& [name, extension] : inner.items()) used.insert(name);
      note_extensions(inner, used);
    }
  }
  json finished() const {
    json out = root;
    if (!binary.empty() && !out.contains("buffers"))
      out["buffers"].push_back({{"byteLength", binary.size()}});
    std::set<std::string> used;
    note_extensions(out, used);
    if (!used.empty() && !out.contains("extensionsUsed")) out["extensionsUsed"] = used;
    return out;
  }
  std::string glb() const {
    std::string text = finished().dump(), bytes = binary;
    while (text.size() % 4 != 0) text += ' ';
    while (bytes.size() % 4 != 0) bytes += '\0';
    const auto word = [](std::size_t n) {
      const auto w = static_cast<std::uint32_t>(n);
      return std::string(reinterpret_cast<const char*>(&w), 4);
    };
    std::string out = "glTF" + word(2) + word(12 + 8 + text.size() + 8 + bytes.size());
    out += word(text.size()) + "JSON" + text;
    out += word(bytes.size()) + std::string("BIN\0", 4) + bytes;
    return out;
  }
  std::filesystem::path save(const std::filesystem::path& folder,
                             const std::string& name = "test.glb") const {
    return write_bytes(folder / name, glb());
  }
};

}  // namespace tyndall
