// Parts of documents that are made from the code: compared with the files, or with TYNDALL_UPDATE=1 in the
// environment written into them.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace tyndall::docs {

inline const std::filesystem::path root = TYNDALL_SOURCE_DIR;

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Expects a file to have this text.
inline void expect_file(const std::filesystem::path& path, const std::string& text) {
  if (std::getenv("TYNDALL_UPDATE") != nullptr) std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(read_file(path), text) << path << " is not current: run this test with TYNDALL_UPDATE=1";
}

// Expects this text between the lines that hold `generated: name` and `generated end`.
inline void expect_part(const std::filesystem::path& path, const std::string& name, const std::string& text) {
  const std::string whole = read_file(path);
  const std::size_t mark = whole.find("generated: " + name);
  ASSERT_NE(mark, std::string::npos) << path << " has no place for " << name;
  const std::size_t begin = whole.find('\n', mark) + 1, end_mark = whole.find("generated end", begin);
  ASSERT_NE(end_mark, std::string::npos) << path;
  const std::size_t end = whole.rfind('\n', end_mark) + 1;
  expect_file(path, whole.substr(0, begin) + text + whole.substr(end));
}

}  // namespace tyndall::docs
