// What README and docs say is true: every command in them runs, every scene in them is read, every option is
// there.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "cli/run_program.h"
#include "tools/commands.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
const fs::path root = TYNDALL_SOURCE_DIR;

// A fenced block of a document: ```language … ```.
struct CodeBlock {
  std::string language, text;
};

std::vector<CodeBlock> code_blocks(const fs::path& document) {
  std::vector<CodeBlock> blocks;
  std::istringstream lines(read_file(document.string()));
  std::string line;
  bool inside = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("```")) {
      if (!inside) blocks.push_back({line.substr(3), {}});
      inside = !inside;
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  EXPECT_FALSE(inside) << document << ": a block is not closed";
  return blocks;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> list{root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") list.push_back(entry.path());
  return list;
}

// The program's arguments of a documented command line; renderings and measurements are made tiny.
std::vector<std::string> arguments_of(const std::string& line) {
  std::istringstream words(line);
  std::vector<std::string> arguments;
  std::string word;
  words >> word;  // scripts/tyndall
  while (words >> word) arguments.push_back(word);
  if (arguments[0] == "measure") {
    for (const std::string option : {"--resolution", "--budget"}) {
      const auto at = std::find(arguments.begin(), arguments.end(), option);
      if (at != arguments.end()) arguments.erase(at, at + 2);
      arguments.insert(arguments.end(), {option, option == "--budget" ? "1s" : "16x9"});
    }
  }
  if (arguments[0] != "render") return arguments;
  const bool replay = line.find("--pixel") != std::string::npos;  // whose pixel wants the whole picture
  for (const std::string option : {"--resolution", "--samples"}) {
    if (option == "--samples" && line.find("--sample-range") != std::string::npos) continue;
    const auto at = std::find(arguments.begin(), arguments.end(), option);
    if (at != arguments.end()) arguments.erase(at, at + 2);
    if (option == "--resolution" && replay) continue;
    const std::string samples = line.find("--denoise") != std::string::npos ? "4" : "1";
    arguments.insert(arguments.end(), {option, option == "--samples" ? samples : "16x9"});
  }
  return arguments;
}

using Documents = CliTest;

TEST_F(Documents, EveryCommandRuns) {
  fs::create_directory_symlink(root / "scenes", path("scenes"));
  const fs::path before = fs::current_path();
  fs::current_path(path(""));
  std::size_t commands = 0;
  for (const fs::path& document : documents()) {
    for (const CodeBlock& block : code_blocks(document)) {
      std::istringstream lines(block.text);
      std::string line;
      if (block.language == "tyn") {  // its first line is `// name.tyn: …`
        std::getline(lines, line);
        std::smatch name;
        ASSERT_TRUE(std::regex_search(line, name, std::regex(R"(^// (\w+\.tyn): )")))
            << document << ": " << line;
        file(name[1], block.text);
      }
      if (block.language != "sh") continue;
      while (std::getline(lines, line)) {
        if (line.starts_with("scripts/test")) continue;  // that is us
        ASSERT_TRUE(line.starts_with("scripts/tyndall ")) << document << ": " << line;
        const std::size_t redirection = line.find(" > ");
        const Outcome outcome = tyndall(arguments_of(line.substr(0, redirection)));
        EXPECT_EQ(outcome.status, 0) << document << ": " << line << "\n" << outcome.err;
        if (redirection != std::string::npos) file(line.substr(redirection + 3), outcome.out);
        ++commands;
      }
    }
  }
  fs::current_path(before);
  EXPECT_GE(commands, 8u);
}

TEST_F(Documents, EveryLinkLeadsSomewhere) {
  const std::regex link(R"(\]\(([^)#:]+)\))");
  for (const fs::path& document : documents()) {
    const std::string text = read_file(document.string());
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it)
      EXPECT_TRUE(fs::exists(document.parent_path() / (*it)[1].str())) << document << ": " << (*it)[1];
  }
}

// The rows of the table of options under a command's heading of docs/cli.md.
std::string table_of(const std::string& text, const std::string& heading) {
  const std::size_t begin = text.find("\n## " + heading + "\n");
  if (begin == std::string::npos) return {};
  std::istringstream lines(text.substr(begin, text.find("\n## ", begin + 1) - begin));
  std::string line, rows;
  while (std::getline(lines, line))
    if (line.starts_with("| `")) rows += line + "\n";
  return rows;
}

std::set<std::string> options_in(const std::string& text) {
  const std::regex option(R"(--[a-z][a-z-]*)");
  std::set<std::string> options;
  for (std::sregex_iterator it(text.begin(), text.end(), option), end; it != end; ++it)
    options.insert(it->str());
  options.erase("--help");
  return options;
}

TEST_F(Documents, CliPageHasExactlyTheOptionsOfTheProgram) {
  const std::string page = read_file((root / "docs/cli.md").string());
  for (const tools::Command* row : tools::commands) {
    const std::string command(row->name);
    const std::string help = tyndall({command, "--help"}).out;
    EXPECT_EQ(options_in(help).empty(), command == "help") << help;
    std::set<std::string> told = options_in(table_of(page, command));
    if (command == "plan")  // the options of `render` go to each task
      for (const std::string& option : options_in(table_of(page, "render")))
        if (options_in(help).contains(option)) told.insert(option);
    EXPECT_EQ(options_in(help), told) << command;
  }
}

// The string literals of a source file, without its comments.
std::string literals_of(const std::string& source) {
  std::string text = std::regex_replace(source, std::regex("//[^\n]*"), ""), literals;
  const std::regex literal(R"re("((?:[^"\\\n]|\\.)*)")re");
  for (std::sregex_iterator it(text.begin(), text.end(), literal), end; it != end; ++it)
    literals += (*it)[1].str() + "\n";
  return literals;
}

// Help, messages and documents name no option and no command that does not exist.
TEST_F(Documents, WhatIsNamedExists) {
  std::set<std::string> commands, options{"--help", "--all" /* of scripts/test */};
  for (const tools::Command* row : tools::commands) commands.emplace(row->name);
  // Of sbatch, for the job scripts that `plan` writes.
  options.merge(std::set<std::string>{"--account", "--constraint", "--cpus-per-task", "--dependency",
                                      "--exclusive", "--mem", "--open-mode", "--requeue", "--signal"});
  options.merge(options_in(tyndall({"--help"}).out));
  for (const std::string& command : commands) options.merge(options_in(tyndall({command, "--help"}).out));

  std::vector<std::pair<std::string, std::string>> texts;
  for (const fs::path& document : documents())
    texts.emplace_back(document.string(), read_file(document.string()));
  for (const auto& entry : fs::recursive_directory_iterator(root / "src"))
    if (entry.is_regular_file() && entry.path().extension() != ".txt")
      texts.emplace_back(entry.path().string(), literals_of(read_file(entry.path().string())));
  EXPECT_GT(texts.size(), 100u);
  for (const auto& [name, text] : texts) {
    for (const std::string& option : options_in(text))
      EXPECT_TRUE(options.contains(option)) << name << ": " << option;
    if (!name.ends_with(".md")) continue;
    const std::regex call(R"(`(?:scripts/)?tyndall ([a-z]+))");
    for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it)
      EXPECT_TRUE(commands.contains((*it)[1])) << name << ": " << it->str();
  }
}

// Those that are compared with other renderers' too.
TEST_F(Documents, EverySceneIsGoodAndSaysItsPurpose) {
  std::size_t scenes = 0;
  std::vector<fs::directory_entry> entries;
  for (const char* folder : {"scenes", "tests/peers"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) entries.push_back(entry);
  for (const auto& entry : entries) {
    if (entry.path().extension() != ".tyn") continue;
    ++scenes;
    const std::string text = read_file(entry.path().string());
    EXPECT_TRUE(text.starts_with("// ")) << entry.path();
    if (text.find("\ncamera ") == std::string::npos) {  // definitions for other scenes
      EXPECT_NE(text.find("include \"lib/" + entry.path().filename().string()), std::string::npos)
          << entry.path();
      const Outcome checked = tyndall({"check", entry.path().string()});
      EXPECT_EQ(checked.out, entry.path().string() + ": good: definitions for other scenes\n");
      EXPECT_EQ(checked.err, "");
      continue;
    }
    const Outcome outcome = tyndall({"render", entry.path().string(), "-o", path("a.png"), "--resolution",
                                     "24x16", "--samples", "1", "--strict"});
    EXPECT_EQ(outcome.status, 0) << entry.path() << "\n" << outcome.err;
    // Scenes may leave out bounces for the sake of their time, which is told.
    const std::string others =
        std::regex_replace(outcome.err, std::regex("warning: `bounces: [0-9]+` (will leave|left) out"), "");
    EXPECT_EQ(others.find("warning"), std::string::npos) << outcome.err;
  }
  EXPECT_GE(scenes, 16u);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
