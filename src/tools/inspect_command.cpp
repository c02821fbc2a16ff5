// `tyndall inspect`: what a scene became at a stage on its way to the renderer.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>

#include "compile/compiled_scene.h"
#include "render/emission_field.h"
#include "tools/commands.h"
#include "tools/load.h"
#include "tools/look.h"
#include "tools/medium_features.h"
#include "tools/report.h"
#include "vm/program.h"

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
  const compile::Features& features = world.features;
  const std::pair<std::string_view, bool> list[] = {
      {"volumes", features.volumes},
      {"surfaces", features.surfaces},
      {"overlapping volumes", features.overlap},
      {"motion while the shutter is open", features.motion},
      {"media that vary in space", features.heterogeneous},
      {"extinction that differs in colour", features.chromatic},
      {"media that emit", features.medium_emission},
      {"media sampled as lights", features.medium_emission && render::EmissionField::of(world) != nullptr},
      {"lights without size", features.delta_lights},
      {"lights with size", features.area_lights},
      {"environment", features.environment},
  };
  std::string text;
  for (const auto& [name, used] : list) text += fmt::format("{:<36}{}\n", name, yes_no(used));
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
};

ExitStatus run_inspect(const InspectArguments& arguments) {
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

}  // namespace

void add_inspect_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("inspect", "Print what a scene became at a stage of its way");
  const auto arguments = std::make_shared<InspectArguments>();
  command->add_option("scene", arguments->request.path, "The scene to look into")
      ->required()
      ->option_text("SCENE");
  add_scene_options(*command, arguments->request);
  std::vector<std::string> names;
  for (const StagePrinter& stage : stages) names.emplace_back(stage.name);
  command->add_option("--stage", arguments->stage, "What to print (default: scene)")
      ->check(CLI::IsMember(names))
      ->option_text("tokens|tree|scene|bytecode|features");
  add_look_options(*command, arguments->look);
  command->callback([arguments, &action] { action = [arguments] { return run_inspect(*arguments); }; });
}

}  // namespace tyndall::tools
