// A file has one job and a function fits a screen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

const fs::path source_root = fs::path(TYNDALL_SOURCE_DIR) / "src";
constexpr std::ptrdiff_t most_lines_of_files = 400, most_lines_of_functions = 60;

struct SourceFile {
  std::string name, text;
};

std::vector<SourceFile> source_files() {
  std::vector<SourceFile> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files.push_back(
        {fs::relative(entry.path(), source_root).string(), {std::istreambuf_iterator<char>(file), {}}});
  }
  return files;
}

std::ptrdiff_t lines_in(std::string_view text) { return std::count(text.begin(), text.end(), '\n'); }

// The text with comments, literals and lines for the preprocessor blanked, line for line.
std::string code_of(const std::string& text) {
  static const std::regex no_code(
      R"re(//[^\n]*|R"\(([^)]|\)[^"])*\)"|"(\\.|[^"\\\n])*"|'(\\.|[^'\\\n])'|\n#[^\n]*)re");
  std::string code = text;
  for (std::sregex_iterator it(text.begin(), text.end(), no_code), end; it != end; ++it)
    for (auto i = it->position(); i < it->position() + it->length(); ++i)
      if (char& c = code[static_cast<std::size_t>(i)]; c != '\n') c = ' ';
  return code;
}

struct Function {
  std::size_t begin, open, end;  // of its head, its brace, behind its last brace
};

// The outermost blocks whose heads hold a parenthesis and name no type: clang-format leaves nothing else of
// that shape in our code.
std::vector<Function> functions_in(const std::string& code) {
  static const std::regex type_head(R"(^\s*(template\s*<[^;{}]*>\s*)?(namespace|struct|class|enum|union)\b)");
  std::vector<Function> functions;
  std::vector<bool> is_function;  // of the blocks that are open
  std::size_t head = 0;           // behind the last brace or semicolon
  bool inside = false;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '{') {
      const std::string words = code.substr(head, i - head);
      const bool begins =
          !inside && words.find('(') != std::string::npos && !std::regex_search(words, type_head);
      if (begins) functions.push_back({code.find_first_not_of(" \n", head), i, i});
      is_function.push_back(begins);
      inside = inside || begins;
    } else if (c == '}' && !is_function.empty()) {
      if (is_function.back()) {
        functions.back().end = i + 1;
        inside = false;
      }
      is_function.pop_back();
    }
    if (c == '{' || c == '}' || c == ';') head = i + 1;
  }
  return functions;
}

TEST(Size, FilesHaveOneJob) {
  const std::vector<SourceFile> files = source_files();
  EXPECT_GT(files.size(), 200u);
  for (const SourceFile& file : files) EXPECT_LE(lines_in(file.text), most_lines_of_files) << file.name;
}

// But for one flat switch.
TEST(Size, FunctionsFitAScreen) {
  std::size_t functions = 0;
  for (const SourceFile& file : source_files()) {
    const std::string code = code_of(file.text);
    for (const Function& f : functions_in(code)) {
      ++functions;
      const std::string_view body = std::string_view(code).substr(f.open + 1, f.end - f.open - 1);
      const std::size_t first = body.find_first_not_of(" \n");
      if (first != std::string_view::npos && body.substr(first).starts_with("switch (")) continue;
      EXPECT_LE(lines_in(std::string_view(code).substr(f.begin, f.end - f.begin)) + 1,
                most_lines_of_functions)
          << file.name << ":" << lines_in(std::string_view(code).substr(0, f.begin)) + 1;
    }
  }
  EXPECT_GT(functions, 1500u);
}

TEST(Size, FindsFunctions) {
  const std::string code = code_of(R"(
namespace a {
struct B {
  B() : x(1) {}
  int f(int y) const {  // a { in a comment
    if (y > 0) { return '{'; }
    return 0;
  }
  int x = 0;
};
template <class T>
void g(T) {
  const auto h = [] { return "}"; };
}
}
)");
  std::vector<std::ptrdiff_t> lines;
  for (const Function& f : functions_in(code))
    lines.push_back(lines_in(code.substr(f.begin, f.end - f.begin)) + 1);
  EXPECT_EQ(lines, (std::vector<std::ptrdiff_t>{1, 4, 4}));
}

}  // namespace
}  // namespace tyndall
