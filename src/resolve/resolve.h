// Tree to Scene at a frame: names, scopes, units, templates, loops, includes.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
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

// A file, or a part of one, that a scene holds in memory.
struct Asset {
  std::string path;
  std::string kind;  // "grid", "image", "image in a temporary file", "texture", "mesh", "font"
  std::string part;  // of the file: a grid's name, an image's channel; may be empty
  auto operator<=>(const Asset&) const = default;
};
using AssetBytes = std::map<Asset, std::uint64_t>;

class Kept;

struct Options {
  std::optional<int> frame;                                    // default: the first of `animation`
  bool warns_of_frame = true;                                  // outside of those of `animation`
  std::vector<std::pair<std::string, std::string>> overrides;  // --set NAME=EXPR
  std::vector<std::string> include_directories;
  bool allow_outside = false;  // files that are neither in the main file's folder nor in one of those
  shader::Options shader;
  bool may_only_define = false;  // a file of nothing but definitions, for other scenes, is good
  std::set<std::string>* files_read = nullptr;            // gets the paths of includes and pictures
  AssetBytes* assets = nullptr;                           // gets what is kept of files
  std::uint64_t texture_memory = std::uint64_t{4} << 30;  // of all images of the scene [bytes]
  Kept* kept = nullptr;  // what is kept between frames of one text (kept.h); not longer than `files_read`
  // Puts the settings of the command line in place of the scene's: warnings are of what will be rendered.
  // What is given back keeps the scene's own.
  std::function<void(scene::RenderSettings&)> amend_settings;
  bool strict = false;                              // numbers of media that are out of their range are errors
  long max_repetitions = resolve::max_repetitions;  // tests and fuzzers take fewer
};

// Whether a file holds definitions and includes alone: there is nothing in it to render.
bool only_defines(const syntax::SyntaxTree& tree);

// The scene that the tree describes, as far as it could be read; look at the diagnostics before using it.
// Overrides and included files are added to `sources`. With Options::kept they, symbols and the tree are
// those of the frames before.
scene::Scene resolve(const syntax::SyntaxTree& tree, Sources& sources, syntax::Symbols& symbols,
                     const Options& options, Diagnostics& diagnostics);

// What `animation` says, without a word of complaint; nothing when there is none that can be read.
std::optional<scene::Animation> animation_of(const syntax::SyntaxTree& tree, Sources& sources,
                                             syntax::Symbols& symbols, const Options& options);

}  // namespace tyndall::resolve
