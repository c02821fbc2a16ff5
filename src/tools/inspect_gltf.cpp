#include "tools/inspect_gltf.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "import/file_bytes.h"
#include "import/gltf/summary.h"
#include "import/malformed.h"
#include "tools/report.h"

namespace tyndall::tools {

namespace {

using nlohmann::ordered_json;

// "materials: Paint, Glass", one line; nothing where there are none.
std::string line_of(const ordered_json& summary, const char* list) {
  std::vector<std::string> names;
  for (const ordered_json& name : summary[list]) names.push_back(name.get<std::string>());
  return names.empty() ? "" : fmt::format("{}: {}\n", list, fmt::join(names, ", "));
}

std::string text_of(const ordered_json& summary) {
  std::string out = fmt::format("generator: {}\n", summary["generator"].get<std::string>());
  out += fmt::format("nodes: {}\n", summary["nodes"].size());
  for (const ordered_json& node : summary["nodes"]) {
    out += fmt::format("  {}", node["name"].get<std::string>());
    for (const char* const held : {"mesh", "skin", "camera"})
      if (node.contains(held)) out += fmt::format("  {} {}", held, node[held].get<std::uint64_t>());
    if (node.contains("children")) out += fmt::format("  {} below", node["children"].size());
    out += '\n';
  }
  out += fmt::format("meshes: {}\n", summary["meshes"].size());
  for (const ordered_json& mesh : summary["meshes"])
    out += fmt::format("  {}  primitives {}, points {}, corners {}\n", mesh["name"].get<std::string>(),
                       mesh["primitives"].get<std::size_t>(), mesh["points"].get<std::size_t>(),
                       mesh["corners"].get<std::size_t>());
  out += line_of(summary, "materials");
  for (const ordered_json& animation : summary["animations"])
    out += fmt::format("animation: {}, {:.4g} s\n", animation["name"].get<std::string>(),
                       animation["seconds"].get<double>());
  out += line_of(summary, "cameras");
  out += fmt::format("images: {}\n", summary["images"].get<std::size_t>());
  return out + line_of(summary, "extensions");
}

}  // namespace

bool is_gltf(const std::string& path) { return path.ends_with(".glb") || path.ends_with(".gltf"); }

ExitStatus inspect_gltf(const std::string& path, bool as_json) {
  try {
    gltf::File file(read_file_bytes(path), [&](const std::string& name, std::string&) {
      return std::optional(std::filesystem::path(path).parent_path() / name);
    });
    const ordered_json summary = gltf::summary(file);
    print_result(as_json ? summary.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n"
                         : text_of(summary));
    return ExitStatus::done;
  } catch (const Malformed& m) {
    print_error(describe(m, path));
    return ExitStatus::problem;
  }
}

}  // namespace tyndall::tools
