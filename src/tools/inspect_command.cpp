// `tyndall inspect`: what a scene became at a stage on its way to the renderer.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>

#include "compile/compiled_scene.h"
#include "tools/commands.h"
#include "tools/inspect_gltf.h"
#include "tools/inspect_grids.h"
#include "tools/inspect_picture.h"
#include "tools/load.h"
#include "tools/look.h"
#include "tools/medium_features.h"
#include "tools/numbers.h"
#include "tools/report.h"
#include "tools/scene_features.h"
#include "vm/program/program.h"

namespace tyndall::tools {
namespace {

std::string tokens_text(LoadedScene& loaded) { return syntax::print(loaded.tokens, loaded.sources); }
std::string tree_text(LoadedScene& loaded) { return syntax::print(loaded.tree, loaded.symbols); }
std::string scene_text(LoadedScene& loaded) { return scene::print(loaded.scene); }

std::string bytecode_text(LoadedScene& loaded) {
  std::string text;
  for (const scene::Medium& medium : loaded.scene.media) {
    text += fmt::format("medium {}: all outputs\n{}", medium.name, vm::print(medium.full, &loaded.sources));
    text += fmt::format("\nmedium {}: extinction alone\n{}\n", medium.name,
                        vm::print(medium.extinction, &loaded.sources));
  }
  for (const scene::Material& material : loaded.scene.materials)
    text += fmt::format("material {}\n{}\n", material.name, vm::print(material.program, &loaded.sources));
  return text;
}

std::string_view yes_no(bool value) { return value ? "yes" : "no"; }

std::string features_text(LoadedScene& loaded) {
  const compile::CompiledScene world = compile::compile(std::move(loaded.scene));
  std::string text;
  for (const auto& [name, used] : scene_features(world))
    text += fmt::format("{:<36}{}\n", name, yes_no(used));
  text += medium_features(world);
  return text;
}

struct StagePrinter {
  std::string_view name;
  Stage last;        // how far the scene must be read
  bool needs_scene;  // nothing to print when the scene has errors
  std::string (*text)(LoadedScene&);
};
constexpr StagePrinter stages[] = {
    {"tokens", Stage::tokens, false, tokens_text},   {"tree", Stage::tree, false, tree_text},
    {"scene", Stage::scene, true, scene_text},       {"bytecode", Stage::scene, true, bytecode_text},
    {"features", Stage::scene, true, features_text},
};

struct InspectArguments {
  SceneRequest request;
  std::string stage = "scene";
  LookArguments look;
  bool json = false;
};

ExitStatus run_inspect(const InspectArguments& arguments) {
  const std::string& path = arguments.request.path;
  if (is_gltf(path)) return inspect_gltf(path, arguments.json);
  if (is_grid_file(path)) return inspect_grids(path, arguments.json);
  if (is_picture(path)) return inspect_picture(path, arguments.json);
  if (arguments.json) {
    print_error("--json is for .glb, .gltf and .vdb files and pictures: a scene is printed as text");
    return ExitStatus::misuse;
  }
  if (arguments.look.wanted()) return look(arguments.request, arguments.look);
  const StagePrinter& stage =
      *std::find_if(std::begin(stages), std::end(stages),
                    [&](const StagePrinter& candidate) { return candidate.name == arguments.stage; });
  const std::unique_ptr<LoadedScene> loaded = load(arguments.request, stage.last);
  print_diagnostics(loaded->diagnostics, loaded->sources);
  const bool good = !loaded->diagnostics.has_errors();
  if (loaded->source.valid() && (good || !stage.needs_scene)) print_result(stage.text(*loaded));
  return good ? ExitStatus::done : ExitStatus::problem;
}

Action inspect_options(CLI::App& command) {
  const auto arguments = std::make_shared<InspectArguments>();
  command
      .add_option("scene", arguments->request.path, "The scene, picture, glTF or OpenVDB file to look into")
      ->required()
      ->option_text("SCENE");
  add_scene_options(command, arguments->request);
  std::vector<std::string_view> names;
  for (const StagePrinter& stage : stages) names.push_back(stage.name);
  command.add_option("--stage", arguments->stage, "What to print (default: scene)")
      ->check([names](const std::string& text) { return name_problem(names, text); })
      ->option_text(fmt::format("{}", fmt::join(names, "|")));
  command.add_flag("--json", arguments->json, "Print what a picture, glTF or OpenVDB file holds as JSON");
  add_look_options(command, arguments->look);
  return [arguments] { return run_inspect(*arguments); };
}

}  // namespace

constinit const Command inspect_command{"inspect", "Print what a scene became at a stage of its way",
                                        inspect_options};

}  // namespace tyndall::tools
