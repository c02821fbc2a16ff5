// From a scene's path to its tokens, tree and Scene, with every problem met on the way and the time of each
// stage.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "resolve/kept.h"
#include "resolve/resolve.h"
#include "scene/scene.h"
#include "syntax/parser.h"
#include "syntax/token.h"
#include "syntax/tree.h"

namespace CLI {
class App;
}

namespace tyndall::tools {

// Which scene, and what the command line says about reading it.
struct SceneRequest {
  std::string path;
  std::optional<int> frame;
  std::vector<std::pair<std::string, std::string>> overrides;  // --set NAME=EXPR
  std::vector<std::string> include_directories;
  bool allow_outside = false;  // files outside of the folders of the scene and of --include
  std::uint64_t texture_memory = resolve::Options{}.texture_memory;
  bool keep_text = false;
  bool may_only_define = false;  // a file of definitions for other scenes is good
  bool warns_of_frame = true;    // outside of `animation`'s
  // As of resolve::Options.
  std::function<void(scene::RenderSettings&)> amend_settings;
  bool strict = false;
  std::string watch;  // a name of media's bodies whose value is wanted as well (scene::Watched)
};

// Adds --frame, --set and --include to a command.
void add_scene_options(CLI::App& command, SceneRequest& request);

enum class Stage : std::uint8_t { tokens, tree, scene };

// All that is known of a scene file. Later stages are empty when `last` of load() came before them.
struct LoadedScene {
  Sources sources;
  syntax::Symbols symbols;
  Diagnostics of_text;      // of the file's words and tree
  Diagnostics diagnostics;  // those and the scene's
  std::string text;         // the file as it is, where that is asked for
  SourceId source;
  syntax::TokenList tokens;
  syntax::SyntaxTree tree;
  std::set<std::string> files_read;  // includes and pictures
  resolve::AssetBytes assets;        // what is kept of them
  resolve::Kept kept;                // for other frames
  scene::Scene scene;                // fit for use only when the diagnostics have no errors
  struct Seconds {
    double read = 0, parse = 0, resolve = 0;
  } seconds;
};

// Reads the scene through the stages up to `last`; problems are in its diagnostics.
std::unique_ptr<LoadedScene> load(const SceneRequest& request, Stage last = Stage::scene);
// The last stage alone, of what was loaded up to the tree, for as many frames as are wanted: the scene, its
// diagnostics, files and assets take the place of those of the frame before.
enum class Keeps : bool { nothing, for_other_frames };
void load_scene(const SceneRequest& request, LoadedScene& loaded, Keeps keeps = Keeps::nothing);

}  // namespace tyndall::tools
