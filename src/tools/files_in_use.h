// Which files a command reads and writes: no output may be an input or another output.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace tyndall::tools {

class FilesInUse {
 public:
  // Each gives a message when an output is the same file as another one that is in use, by whatever path or
  // link; empty otherwise. `what` names the file's part in the command: "the scene", "--stats".
  std::string read(const std::string& path, const std::string& what) { return add(path, what, false); }
  std::string write(const std::string& path, const std::string& what) { return add(path, what, true); }
  // Includes and pictures.
  std::string read_by_scene(const std::set<std::string>& paths);

 private:
  struct File {
    std::string identity, path, what;
    bool is_output;
  };
  std::string add(const std::string& path, const std::string& what, bool is_output);

  std::vector<File> files_;
};

}  // namespace tyndall::tools
