// `tyndall format`: gives scene files the canonical layout.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <span>

#include "base/check.h"
#include "base/line_ends.h"
#include "image/files.h"
#include "syntax/format.h"
#include "tools/commands.h"
#include "tools/load.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

struct FormatArguments {
  std::vector<std::string> scenes;
  bool check = false;
};

// The tree as text: what formatting must keep.
std::string meaning_of(const std::string& name, const std::string& text) {
  LoadedScene scene;
  const SourceId source = scene.sources.add(name, text);
  scene.tokens = syntax::lex(scene.sources, source, scene.diagnostics);
  scene.tree = syntax::parse(scene.sources, source, scene.tokens, scene.symbols, scene.diagnostics);
  return syntax::print(scene.tree, scene.symbols);
}

// The text with the byte order mark and the line ends that the file had; of several kinds the most frequent.
std::string as_written_before(const std::string& formatted, const std::string& before) {
  const std::string_view mark = before.starts_with(byte_order_mark) ? byte_order_mark : "";
  return std::string(mark) + with_line_ends(formatted, line_ends_of(before).usual());
}

// Formats one file, or only looks whether it is formatted; true unless there is a problem.
bool format_file(const std::string& path, bool check) {
  if (!check && !image::appears_whole(path)) {
    print_error(fmt::format("cannot format '{}': it is no plain file", path));
    return false;
  }
  SceneRequest request;
  request.path = path;
  request.keep_text = true;
  const std::unique_ptr<LoadedScene> scene = load(request, Stage::tree);
  print_diagnostics(scene->diagnostics, scene->sources);
  if (scene->diagnostics.has_errors()) return false;
  const std::string formatted = syntax::format(scene->sources, scene->source, scene->tokens, scene->tree);
  const std::string after = as_written_before(formatted, scene->text);
  if (after == scene->text) return true;
  if (check) {
    print_result(fmt::format("{}: would be formatted\n", path));
    return false;
  }
  CHECK_EQ(meaning_of(path, after), syntax::print(scene->tree, scene->symbols));
  if (const std::string problem = image::write_file_whole(path, std::as_bytes(std::span(after)));
      !problem.empty()) {
    print_error(problem);
    return false;
  }
  print_result(fmt::format("{}: formatted\n", path));
  return true;
}

ExitStatus run_format(const FormatArguments& arguments) {
  bool good = true;
  for (const std::string& path : arguments.scenes) good = format_file(path, arguments.check) && good;
  return good ? ExitStatus::done : ExitStatus::problem;
}

Action format_options(CLI::App& command) {
  const auto arguments = std::make_shared<FormatArguments>();
  command.add_option("scenes", arguments->scenes, "The scenes to format")->required()->option_text("SCENE");
  command.add_flag("--check", arguments->check, "Change nothing; name the files that would change");
  return [arguments] { return run_format(*arguments); };
}

}  // namespace

constinit const Command format_command{"format", "Give scene files the canonical layout", format_options};

}  // namespace tyndall::tools
