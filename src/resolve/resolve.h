// Tree to Scene at a frame: names, scopes, units, templates, loops, includes.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "resolve/limits.h"
#include "scene/scene.h"
#include "shader/compile_body.h"
#include "syntax/tree.h"

namespace tyndall::resolve {

struct Options {
  std::optional<int> frame;                                    // default: the first of `animation`
  std::vector<std::pair<std::string, std::string>> overrides;  // --set NAME=EXPR
  std::vector<std::string> include_directories;
  bool allow_outside = false;  // files that are neither in the main file's folder nor in one of those
  shader::Options shader;
  bool may_only_define = false;  // a file of nothing but definitions, for other scenes, is good
  std::set<std::string>* files_read = nullptr;      // gets the paths of includes and pictures
  long max_repetitions = resolve::max_repetitions;  // tests and fuzzers take fewer
};

// Whether a file holds definitions and includes alone: there is nothing in it to render.
bool only_defines(const syntax::SyntaxTree& tree);

// The scene that the tree describes, as far as it could be read; look at the diagnostics before using it.
// Overrides and included files are added to `sources`.
scene::Scene resolve(const syntax::SyntaxTree& tree, Sources& sources, syntax::Symbols& symbols,
                     const Options& options, Diagnostics& diagnostics);

}  // namespace tyndall::resolve
