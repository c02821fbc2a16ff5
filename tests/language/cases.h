// The scenes of this folder, read and resolved: what its tests share. A line `// set: NAME = EXPR` in a scene
// is what
// `--set` is on the command line; comments in EXPR count.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "resolve/resolve.h"
#include "syntax/parser.h"

namespace tyndall {

inline constexpr std::string_view set_mark = "// set: ";

struct Case {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
};

// What is said of a scene's text.
inline void run_text(const std::string& path, const std::string& text, Case& c) {
  resolve::Options options;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with(set_mark) && equals != std::string::npos)
      options.overrides.emplace_back(line.substr(set_mark.size(), equals - set_mark.size()),
                                     line.substr(equals + 3));
  }
  const SourceId source = c.sources.add(path, text);
  const syntax::TokenList tokens = syntax::lex(c.sources, source, c.diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(c.sources, source, tokens, c.symbols, c.diagnostics);
  if (!c.diagnostics.full()) resolve::resolve(tree, c.sources, c.symbols, options, c.diagnostics);
}

// What is said of the scene in a file.
inline void run_case(const std::string& path, Case& c) {
  std::ifstream file(path, std::ios::binary);
  run_text(path, {std::istreambuf_iterator<char>(file), {}}, c);
}

// Everything that a message says.
inline std::string text_of(const Diagnostic& d) {
  std::string text = d.message + " | " + d.help;
  for (const Diagnostic::Note& note : d.notes) text += " | " + note.message;
  return text;
}

inline std::vector<std::string> case_files() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(TYNDALL_SOURCE_DIR "/tests/language"))
    if (entry.path().extension() == ".tyn") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace tyndall
