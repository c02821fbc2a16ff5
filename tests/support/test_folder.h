// A folder for the files of a test.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace tyndall {

// A folder that no other process has, gone with the object, unless the environment has
// TYNDALL_KEEP_TEST_FILES.
class ProcessFolder {
 public:
  ProcessFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tyndall-test-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder can be made: " + pattern);
    path_ = pattern;
  }
  ~ProcessFolder() {
    std::error_code ignored;
    if (std::getenv("TYNDALL_KEEP_TEST_FILES") == nullptr) std::filesystem::remove_all(path_, ignored);
  }
  ProcessFolder(const ProcessFolder&) = delete;
  ProcessFolder& operator=(const ProcessFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The folder of the test that runs. Tests run side by side, in processes of their own, so names below the
// folder for temporary files that do not hold the process are shared by two of them.
inline std::filesystem::path test_folder() {
  static const ProcessFolder root;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  for (char& c : name)
    if (c == '/') c = '-';
  std::filesystem::path folder = root.path() / name;
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace tyndall
