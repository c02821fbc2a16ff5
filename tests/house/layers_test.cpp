// The layers of the house, read from the very lines of the build that state them: no #include goes upwards,
// and each big library is known to one file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

const fs::path source_root = fs::path(TYNDALL_SOURCE_DIR) / "src";

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Each layer with the layers that it may use.
std::map<std::string, std::set<std::string>> read_layers() {
  std::map<std::string, std::set<std::string>> layers;
  const std::string build =
      std::regex_replace(read(source_root / "CMakeLists.txt"), std::regex("#[^\n]*"), "");
  const std::regex call(R"(tyndall_layer\(([^)]*)\))");
  for (std::sregex_iterator it(build.begin(), build.end(), call), end; it != end; ++it) {
    std::istringstream words((*it)[1]);
    std::string name, word;
    words >> name;
    std::set<std::string> uses{name};
    bool in_uses = false;
    while (words >> word) {
      if (word == "MAY_USE" || word == "LIBRARIES" || word == "PRECOMPILED") {
        in_uses = word == "MAY_USE";
      } else if (in_uses) {
        uses.insert(word);
      }
    }
    if (name != "name") layers[name] = uses;
  }
  return layers;
}

struct Include {
  std::string file;    // relative to src
  std::string target;  // as written between quotes or angle brackets
  bool quoted = false;
};

std::vector<Include> read_includes() {
  std::vector<Include> includes;
  const std::regex line_with_include(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  for (const auto& entry : fs::recursive_directory_iterator(source_root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::istringstream text(read(entry.path()));
    std::string line;
    std::smatch match;
    while (std::getline(text, line))
      if (std::regex_search(line, match, line_with_include))
        includes.push_back({fs::relative(entry.path(), source_root).string(), match[2], match[1] == "\""});
  }
  return includes;
}

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

TEST(Layers, TheBuildNamesEveryFolder) {
  const auto layers = read_layers();
  std::size_t folders = 0;
  for (const auto& entry : fs::directory_iterator(source_root)) {
    if (!entry.is_directory()) continue;
    ++folders;
    EXPECT_TRUE(layers.contains(entry.path().filename().string())) << entry.path().filename();
  }
  EXPECT_GT(folders, 5u);
  EXPECT_EQ(layers.size(), folders);
}

TEST(Layers, ALayerIsStatedAfterThoseItUses) {
  const std::string build = read(source_root / "CMakeLists.txt");
  for (const auto& [name, uses] : read_layers())
    for (const std::string& other : uses)
      EXPECT_LE(build.find("tyndall_layer(" + other), build.find("tyndall_layer(" + name))
          << name << " uses " << other;
}

TEST(Layers, NoIncludeBreaksThem) {
  const auto layers = read_layers();
  std::size_t inner = 0;
  for (const Include& include : read_includes()) {
    // Highway's own idiom quotes its headers.
    if (!include.quoted || include.target.starts_with("hwy/")) continue;
    ++inner;
    EXPECT_TRUE(fs::exists(source_root / include.target))
        << include.file << " includes \"" << include.target
        << "\": quotes are for files under src, by their whole path";
    const auto layer = layers.find(first_folder(include.file));
    ASSERT_NE(layer, layers.end()) << include.file;
    EXPECT_TRUE(layer->second.contains(first_folder(include.target)))
        << include.file << " includes \"" << include.target << "\", but " << layer->first
        << " may not use it";
  }
  EXPECT_GT(inner, 50u);
}

// The rooms of a layer are its folders. The build states some layers' rooms, lowest first: each may include
// those before it, and files of the layer that stand in no room.
TEST(Layers, NoIncludeBreaksTheOrderOfRooms) {
  const std::string build = read(source_root / "CMakeLists.txt");
  const std::regex statement(R"(tyndall_rooms\((\w+) ([^)]*)\))");
  std::map<std::string, std::vector<std::string>> rooms;
  for (std::sregex_iterator it(build.begin(), build.end(), statement), end; it != end; ++it) {
    std::istringstream words((*it)[2]);
    for (std::string room; words >> room;) rooms[(*it)[1]].push_back((*it)[1].str() + "/" + room);
  }
  EXPECT_GE(rooms.size(), 3u);
  const auto place = [&](const std::string& file) -> std::optional<std::ptrdiff_t> {
    const auto layer = rooms.find(first_folder(file));
    const std::string folder = fs::path(file).parent_path().string();
    if (layer == rooms.end() || folder == layer->first) return std::nullopt;
    const auto found = std::find(layer->second.begin(), layer->second.end(), folder);
    EXPECT_NE(found, layer->second.end()) << folder << " is not among the rooms that the build states";
    return found - layer->second.begin();
  };
  std::size_t between = 0;
  for (const Include& include : read_includes()) {
    if (!include.quoted || first_folder(include.file) != first_folder(include.target)) continue;
    const auto from = place(include.file), to = place(include.target);
    if (!from || !to) continue;
    ++between;
    EXPECT_LE(*to, *from) << include.file << " includes \"" << include.target << "\" of a later room";
  }
  EXPECT_GT(between, 100u);
}

// Libraries whose headers stay behind one .cpp, so that each can be replaced by changing one file.
TEST(Layers, EachBigLibraryIsKnownToOneFile) {
  const std::pair<std::string, std::regex> libraries[] = {
      {"Embree", std::regex("^embree[0-9]*/.*")},
      {"OpenImageIO", std::regex("^OpenImageIO/.*")},
      {"OpenEXR", std::regex("^OpenEXR/.*")},
      {"libpng", std::regex("^png.h$")},
      {"OpenVDB", std::regex("^openvdb/.*")},
  };
  const auto includes = read_includes();
  for (const auto& [library, header] : libraries) {
    std::set<std::string> files;
    for (const Include& include : includes)
      if (std::regex_match(include.target, header)) files.insert(include.file);
    std::string list;
    for (const std::string& file : files) list += file + " ";
    EXPECT_EQ(files.size(), 1u) << library << " in: " << list;
    for (const std::string& file : files) EXPECT_TRUE(file.ends_with(".cpp")) << library << " in " << file;
  }
}

TEST(Layers, OnlyTheProgramPrintsOrExits) {
  const std::regex printing(R"((std::(cout|cerr|printf|puts|exit|_Exit)|fmt::print|fprintf|\bputs)\b)");
  for (const auto& entry : fs::recursive_directory_iterator(source_root)) {
    if (!entry.is_regular_file()) continue;
    const std::string file = fs::relative(entry.path(), source_root).string();
    // check.cpp reports defects of the program itself.
    if (first_folder(file) == "tools" || file == "base/check.cpp" || file == "CMakeLists.txt") continue;
    std::smatch match;
    const std::string text = std::regex_replace(read(entry.path()), std::regex("//[^\n]*"), "");
    EXPECT_FALSE(std::regex_search(text, match, printing)) << file << ": " << match.str();
  }
}

}  // namespace
}  // namespace tyndall
