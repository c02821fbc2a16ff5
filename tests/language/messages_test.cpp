// Every message that the code can give of a scene is provoked by a scene of this folder. The messages are
// read from the sources: the texts in the message's place at each call that reports, and those of the tables
// of mistakes. So a new message without a case fails here.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "cases.h"

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The end of the quoted text, 'c' or "…", that begins at `at`.
std::size_t quote_end(const std::string& code, std::size_t at) {
  const char quote = code[at];
  for (++at; at < code.size() && code[at] != quote; ++at)
    if (code[at] == '\\') ++at;
  return std::min(at + 1, code.size());
}

// The parts of a bracketed list that opens at `at`, parted by its commas; empty where it does not close.
Texts parts_of_list(const std::string& code, std::size_t at) {
  Texts parts(1);
  int depth = 0;
  while (at < code.size()) {
    const char c = code[at];
    if (c == '"' || c == '\'') {
      const std::size_t end = quote_end(code, at);
      parts.back() += code.substr(at, end - at);
      at = end;
      continue;
    }
    const bool opens = c == '(' || c == '[' || c == '{', closes = c == ')' || c == ']' || c == '}';
    if (closes && --depth == 0) return parts;
    if (opens && ++depth == 1) {
    } else if (c == ',' && depth == 1) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
    ++at;
  }
  return {};
}

// The literals of a piece of code, neighbours joined, escapes resolved. Words that are put into messages have
// no blank: they are none themselves.
Texts sentences(const std::string& code) {
  Texts found;
  bool joined = false;
  for (std::size_t at = 0; at < code.size();) {
    if (code[at] != '"') {
      if (code[at] == '\'') {
        at = quote_end(code, at);
        joined = false;
        continue;
      }
      joined = joined && std::isspace(static_cast<unsigned char>(code[at]));
      ++at;
      continue;
    }
    const std::size_t end = quote_end(code, at);
    std::string text;
    for (std::size_t i = at + 1; i + 1 < end; ++i) text += code[i] == '\\' ? code[++i] : code[i];
    if (joined)
      found.back() += text;
    else
      found.push_back(text);
    joined = true;
    at = end;
  }
  std::erase_if(found, [](const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos || text.find(' ', first) == std::string::npos;
  });
  return found;
}

struct Message {
  std::string file, text;
};

// Messages that are not written where they are reported, but elsewhere in the same layer.
const std::map<std::string, std::string> written_elsewhere{
    {"no_parameter(name, keyword)", "no parameter '{}' in '{}'"},
    {"no_parameter(name, keyword_)", "no parameter '{}' in '{}'"},
    {"no_parameter(symbols_.text(given.item->name.symbol), keyword_)", "no parameter '{}' in '{}'"},
    {"message", "expected '{{' after {}, found {}"},
    {"std::string(mistake.message)", ""},   // rows of a table, read as such
    {"std::string(message) + places", ""},  // habits, read where they are reported
    {"describe(m, name)", ""},              // of importers
    {"describe(m, open->name)", ""},
    {"problem.message", ""},  // of scene/validate.cpp
    {"d.message", ""},        // of a later run
    {"list.error", ""},       // of files of grids: tests/import
    {"result.error", ""},
    {"std::string message", ""},  // declarations and passing on
    {"std::move(message)", ""},
};

void read_reports(const fs::path& path, std::vector<Message>& messages) {
  const std::string code = file_text(path);
  static const std::regex report(
      R"(\b(error|error_once|warning|fail|note_mistake|report|report_undefined)\s*\()");
  for (std::sregex_iterator it(code.begin(), code.end(), report), end; it != end; ++it) {
    const Texts arguments = parts_of_list(code, static_cast<std::size_t>(it->position() + it->length()) - 1);
    const std::size_t place = (*it)[1] == "report_undefined" ? 3 : 1;
    if (arguments.size() <= place) continue;
    std::string argument = arguments[place];
    const std::size_t first = argument.find_first_not_of(" \n");
    if (first == std::string::npos) continue;
    argument = argument.substr(first);
    const Texts texts = sentences(argument);
    for (const std::string& text : texts) messages.push_back({path.filename().string(), text});
    if (!texts.empty()) continue;
    const auto elsewhere = written_elsewhere.find(argument);
    EXPECT_NE(elsewhere, written_elsewhere.end()) << path << ": where is the text of " << argument << "?";
    if (elsewhere == written_elsewhere.end() || elsewhere->second.empty()) continue;
    messages.push_back({path.filename().string(), elsewhere->second});
  }
}

// Problems of scene/validate.cpp: push_back({field, message, help}).
void read_problems(const fs::path& path, std::vector<Message>& messages) {
  const std::string code = file_text(path);
  for (std::size_t at = code.find("push_back("); at != std::string::npos;
       at = code.find("push_back(", at + 1)) {
    const Texts parts = parts_of_list(code, code.find('{', at));
    ASSERT_GE(parts.size(), 2u);
    for (const std::string& text : sentences(parts[1])) messages.push_back({path.filename().string(), text});
  }
}

// Tables of what other languages write: the rows that name the token that was meant.
void read_rows(const fs::path& path, std::vector<Message>& messages) {
  const std::string code = file_text(path);
  static const std::regex row(R"(\{("[^"]*"|0x[0-9a-f]+), TokenKind::\w+,)");
  for (std::sregex_iterator it(code.begin(), code.end(), row), end; it != end; ++it) {
    const Texts parts = parts_of_list(code, static_cast<std::size_t>(it->position()));
    for (std::size_t i = 2; i < parts.size(); ++i)
      for (const std::string& text : sentences(parts[i]))
        messages.push_back({path.filename().string(), text});
  }
}

std::vector<Message> all_messages() {
  const fs::path root = TYNDALL_SOURCE_DIR "/src";
  std::vector<Message> messages;
  for (const char* layer : {"syntax", "eval", "shader", "resolve"})
    for (const auto& entry : fs::recursive_directory_iterator(root / layer))
      if (entry.is_regular_file()) read_reports(entry.path(), messages);
  read_problems(root / "scene/validate.cpp", messages);
  read_rows(root / "syntax/lex_mistakes.cpp", messages);
  return messages;
}

// A message's text as a pattern: what is put in for `{}` is any text.
std::regex pattern(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if ((c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c) {
      out += std::string("\\") + c;
      ++i;
      continue;
    }
    std::smatch placeholder;
    static const std::regex braces(R"(^\{[0-9]*(:[^}]*)?\})");
    const std::string rest = text.substr(i);
    if (c == '{' && std::regex_search(rest, placeholder, braces)) {
      out += "[^]*";
      i += static_cast<std::size_t>(placeholder.length()) - 1;
      continue;
    }
    if (std::string("^$\\.*+?()[]{}|").find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return std::regex(out);
}

// What no single scene text can bring about, and where it is tested instead.
const std::set<std::string> not_from_a_scene{
    "files included more than {} deep",        // wants as many files: tests/resolve/limits_test.cpp
    "a list of more than {} entries",          // wants as many entries: the same
    "it is larger than {} MB",                 // wants such a file: the same
    "more than {} words, marks and comments",  // wants as many words: tests/syntax/lexer_test.cpp
    "more than {} objects, each with a body of its own",  // wants as many: tests/resolve/limits_test.cpp
    "more than {} {} in a scene",                         // the same
    "more than {} points of curves",                   // wants as many entries: tests/resolve/limits_test.cpp
    "there is not enough memory for what this makes",  // wants a small machine: tests/cli/memory_test.cpp
    "--frame {} is outside of these frames, {} to {}",  // wants an option: tests/cli/commands_test.cpp
    "turns too often or moves too unevenly while the shutter is open: between {} moments it is off its way "
    "by up to {:.2g} "
    "times "
    "what would be seen",            // takes seconds: tests/resolve/motion_test.cpp
    "pictures cannot be read here",  // wants a run without a reader of files
    "grids cannot be read here",     // the same
    // Wants a grid of thousands of velocities: tests/import/grid_velocity_test.cpp
    "grid '{}' has {} velocit{} far beyond the others, up to {:.4g} m/s",
};

TEST(Messages, AreEachProvokedByACase) {
  std::set<std::string> said;
  for (const std::string& path : case_files()) {
    Case c;
    run_case(path, c);
    for (const Diagnostic& d : c.diagnostics.all()) said.insert(d.message + " | " + d.help);
  }
  const std::vector<Message> messages = all_messages();
  EXPECT_GT(messages.size(), 300u);
  for (const Message& message : messages) {
    if (not_from_a_scene.contains(message.text)) continue;
    const std::regex wanted = pattern(message.text);
    EXPECT_TRUE(std::any_of(said.begin(), said.end(),
                            [&](const std::string& text) { return std::regex_search(text, wanted); }))
        << message.file << ": no case in tests/language provokes: " << message.text;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
