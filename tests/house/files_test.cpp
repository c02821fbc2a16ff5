// Files that tests write: each process has its own.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

// Tests run side by side, in processes of their own. A fixed name in a shared folder is one that two of them
// write.
TEST(Files, OfTestsAreInFoldersOfTheirProcess) {
  std::size_t users = 0;
  for (const auto& entry : fs::recursive_directory_iterator(TYNDALL_SOURCE_DIR "/tests")) {
    const fs::path& path = entry.path();
    const bool is_source = path.extension() == ".cpp" || path.extension() == ".h";
    if (!is_source || path.filename() == "files_test.cpp") continue;
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.find("test_folder()") != std::string::npos) ++users;
    const bool makes_unique = text.find("mkstemp") != std::string::npos ||
                              text.find("mkdtemp") != std::string::npos ||
                              text.find("getpid()") != std::string::npos;
    for (const char* shared : {"temp_directory_path", "TempDir()", "TYNDALL_BINARY_DIR"})
      EXPECT_TRUE(text.find(shared) == std::string::npos || makes_unique)
          << path << " uses " << shared << "; support/test_folder.h has a folder for it";
  }
  EXPECT_GT(users, 10u);
}

}  // namespace UNNAMED
}  // namespace tyndall
