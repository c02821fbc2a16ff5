#include "tools/load.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>

#include "resolve/resolve.h"
#include "tools/numbers.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {
namespace {

// The file's bytes; an error message fit for the user when there are none to be had.
std::string read_text(const std::string& path, std::string& text) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return fmt::format("cannot read '{}': it is a directory", path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return fmt::format("cannot read '{}': {}", path, std::generic_category().message(errno));
  constexpr std::size_t chunk = 1 << 16;
  std::size_t got = 0;
  do {
    const std::size_t end = text.size();
    text.resize(end + chunk);
    got = std::fread(text.data() + end, 1, chunk, file.get());
    text.resize(end + got);
    if (text.size() > resolve::max_file_bytes)
      return fmt::format("cannot read '{}': it is larger than {} MB", path, resolve::max_file_bytes >> 20);
  } while (got > 0);
  if (std::ferror(file.get()))
    return fmt::format("cannot read '{}': {}", path, std::generic_category().message(errno));
  return {};
}

void add_override(SceneRequest& request, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw CLI::ValidationError("--set", fmt::format("wants NAME=EXPR, not '{}'", text));
  request.overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
}

}  // namespace

void add_scene_options(CLI::App& command, SceneRequest& request) {
  add_whole(command, "--frame", request.frame, "The frame to read, in place of the first of `animation`");
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&request](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) add_override(request, text);
          },
          "Override a top-level `let`; may be repeated")
      ->allow_extra_args(false)
      ->option_text("NAME=EXPR");
  command
      .add_option("--include", request.include_directories,
                  "Also look for included files here; may be repeated")
      ->allow_extra_args(false)
      ->option_text("DIR");
  command.add_flag("--allow-outside", request.allow_outside,
                   "Let the scene name files outside of its folder and those of --include");
}

static void read_stages(const SceneRequest& request, Stage last, LoadedScene& loaded,
                        std::string_view& doing) {
  Stopwatch watch;
  std::string text;
  const std::string problem = read_text(request.path, text);
  if (!problem.empty()) return loaded.diagnostics.error({}, problem);
  if (request.keep_text) loaded.text = text;
  loaded.source = loaded.sources.add(request.path, std::move(text));
  loaded.seconds.read = watch.lap();

  loaded.tokens = syntax::lex(loaded.sources, loaded.source, loaded.diagnostics);
  if (last == Stage::tokens) return;
  loaded.tree =
      syntax::parse(loaded.sources, loaded.source, loaded.tokens, loaded.symbols, loaded.diagnostics);
  loaded.seconds.parse = watch.lap();
  if (last == Stage::tree || loaded.diagnostics.full()) return;

  doing = "build the scene of";
  const resolve::Options options{.frame = request.frame,
                                 .overrides = request.overrides,
                                 .include_directories = request.include_directories,
                                 .allow_outside = request.allow_outside,
                                 .shader = {.watch = request.watch},
                                 .may_only_define = request.may_only_define,
                                 .files_read = &loaded.files_read};
  loaded.scene = resolve::resolve(loaded.tree, loaded.sources, loaded.symbols, options, loaded.diagnostics);
  loaded.seconds.resolve = watch.lap();
}

std::unique_ptr<LoadedScene> load(const SceneRequest& request, Stage last) {
  auto loaded = std::make_unique<LoadedScene>();
  std::string_view doing = "read";
  try {
    read_stages(request, last, *loaded, doing);
  } catch (const std::bad_alloc&) {
    loaded->diagnostics.error({}, fmt::format("there is not enough memory to {} '{}'", doing, request.path));
  }
  return loaded;
}

}  // namespace tyndall::tools
