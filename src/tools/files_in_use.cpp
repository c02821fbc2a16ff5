#include "tools/files_in_use.h"

#include <fmt/format.h>

#include <utility>

#include "image/files.h"

namespace tyndall::tools {

std::string FilesInUse::add(const std::string& path, const std::string& what, bool is_output) {
  File file{image::file_identity(path), path, what, is_output};
  if (file.identity.empty()) return {};
  for (const File& other : files_) {
    if (other.identity != file.identity || !(is_output || other.is_output)) continue;
    const bool this_overwrites = is_output;
    const File &output = this_overwrites ? file : other, &kept = this_overwrites ? other : file;
    return fmt::format("{} '{}' would overwrite {} '{}': write to another file", output.what, output.path,
                       kept.what, kept.path);
  }
  files_.push_back(std::move(file));
  return {};
}

std::string FilesInUse::read_by_scene(const std::set<std::string>& paths) {
  for (const std::string& path : paths)
    if (std::string problem = read(path, "a file of the scene,"); !problem.empty()) return problem;
  return {};
}

}  // namespace tyndall::tools
