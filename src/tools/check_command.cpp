// `tyndall check`: everything short of rendering, for any number of scenes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "resolve/resolve.h"
#include "tools/commands.h"
#include "tools/load.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

struct CheckArguments {
  std::vector<std::string> scenes;
  SceneRequest request;  // but for the path
  bool json = false;
};

ExitStatus run_check(const CheckArguments& arguments) {
  bool good = true;
  nlohmann::json results = nlohmann::json::array();
  for (const std::string& path : arguments.scenes) {
    SceneRequest request = arguments.request;
    request.path = path;
    request.may_only_define = true;
    const std::unique_ptr<LoadedScene> loaded = load(request);
    const bool scene_good = !loaded->diagnostics.has_errors();
    good = good && scene_good;
    print_diagnostics(loaded->diagnostics, loaded->sources);
    if (arguments.json) {
      results.push_back({{"scene", path},
                         {"good", scene_good},
                         {"diagnostics", to_json(loaded->diagnostics, loaded->sources)}});
    } else {
      const bool defines = scene_good && resolve::only_defines(loaded->tree);
      print_result(fmt::format("{}: {}\n", path,
                               defines      ? "good: definitions for other scenes"
                               : scene_good ? "good"
                                            : "has errors"));
    }
  }
  if (arguments.json) print_json({{"scenes", results}});
  return good ? ExitStatus::done : ExitStatus::problem;
}

Action check_options(CLI::App& command) {
  const auto arguments = std::make_shared<CheckArguments>();
  command.add_option("scenes", arguments->scenes, "The scenes to check")->required()->option_text("SCENE");
  add_scene_options(command, arguments->request);
  command.add_flag("--json", arguments->json, "Print the problems as JSON on standard output");
  return [arguments] { return run_check(*arguments); };
}

}  // namespace

constinit const Command check_command{"check", "Look for every problem in scenes, without rendering",
                                      check_options};

}  // namespace tyndall::tools
