// `tyndall format`: gives scene files the canonical layout.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/check.h"
#include "base/line_ends.h"
#include "syntax/format.h"
#include "tools/commands.h"
#include "tools/load.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

namespace fs = std::filesystem;

struct FormatArguments {
  std::vector<std::string> scenes;
  bool check = false;
};

// Replaces a file's text, whole or not at all; an error message when that failed.
std::string replace_file(const std::string& path, const std::string& text) {
  std::error_code error;
  const fs::path target = fs::canonical(path, error);  // a link stays a link
  if (error) return error.message();
  fs::path part = target;
  part += ".part";
  std::FILE* file = std::fopen(part.c_str(), "wbx");
  if (file == nullptr) return std::generic_category().message(errno);
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) error.assign(errno, std::generic_category());
  if (!error) fs::permissions(part, fs::status(target).permissions(), error);
  if (!error) fs::rename(part, target, error);
  std::error_code ignored;
  if (error) fs::remove(part, ignored);
  return error ? error.message() : std::string();
}

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
  const std::string problem = replace_file(path, after);
  if (!problem.empty()) {
    print_error(fmt::format("cannot write '{}': {}", path, problem));
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

}  // namespace

void add_format_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("format", "Give scene files the canonical layout");
  const auto arguments = std::make_shared<FormatArguments>();
  command->add_option("scenes", arguments->scenes, "The scenes to format")->required()->option_text("SCENE");
  command->add_flag("--check", arguments->check, "Change nothing; name the files that would change");
  command->callback([arguments, &action] { action = [arguments] { return run_format(*arguments); }; });
}

}  // namespace tyndall::tools
