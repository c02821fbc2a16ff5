#include "tools/load.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <new>

#include "tools/numbers.h"
#include "tools/scene_text.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {
namespace {

void add_override(SceneRequest& request, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw CLI::ValidationError("--set", fmt::format("wants NAME=EXPR, not '{}'", text));
  request.overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
}

void read_texture_memory(SceneRequest& request, const std::string& text) {
  const auto bytes = read_bytes(text);
  if (!bytes) refuse("--texture-memory", "a size from 16MB to 1TB, for instance 512MB or 4GB", text);
  request.texture_memory = *bytes;
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
      ->check([](const std::string& directory) {
        std::error_code ignored;
        return std::filesystem::is_directory(directory, ignored)
                   ? std::string{}
                   : fmt::format("wants a directory that is there, not '{}'", directory);
      })
      ->option_text("DIR");
  command.add_flag("--allow-outside", request.allow_outside,
                   "Let the scene name files outside of its folder and those of --include");
  add_text_option(command, "--texture-memory", "SIZE",
                  "Memory of all images, for instance 512MB (default: 4GB); those that take more than an "
                  "eighth of it are kept in a temporary file",
                  [&request](const std::string& text) { read_texture_memory(request, text); });
}

static void read_text(const SceneRequest& request, Stage last, LoadedScene& loaded) {
  Stopwatch watch;
  std::string text;
  const std::string problem = read_scene_text(request.path, text);
  if (!problem.empty()) return loaded.diagnostics.error({}, problem);
  if (request.keep_text) loaded.text = text;
  loaded.source = loaded.sources.add(request.path, std::move(text));
  loaded.seconds.read = watch.lap();

  loaded.tokens = syntax::lex(loaded.sources, loaded.source, loaded.diagnostics);
  if (last == Stage::tokens) return;
  loaded.tree =
      syntax::parse(loaded.sources, loaded.source, loaded.tokens, loaded.symbols, loaded.diagnostics);
  loaded.seconds.parse = watch.lap();
}

static void resolve_scene(const SceneRequest& request, Keeps keeps, LoadedScene& loaded) {
  Stopwatch watch;
  const resolve::Options options{.frame = request.frame,
                                 .warns_of_frame = request.warns_of_frame,
                                 .overrides = request.overrides,
                                 .include_directories = request.include_directories,
                                 .allow_outside = request.allow_outside,
                                 .shader = {.watch = request.watch},
                                 .may_only_define = request.may_only_define,
                                 .files_read = &loaded.files_read,
                                 .assets = &loaded.assets,
                                 .texture_memory = request.texture_memory,
                                 .kept = keeps == Keeps::for_other_frames ? &loaded.kept : nullptr,
                                 .amend_settings = request.amend_settings,
                                 .strict = request.strict};
  loaded.scene = resolve::resolve(loaded.tree, loaded.sources, loaded.symbols, options, loaded.diagnostics);
  loaded.seconds.resolve = watch.lap();
}

// Does the work; memory that runs out is one of the scene's problems, and gives false.
template <class Work>
static bool or_out_of_memory(const SceneRequest& request, std::string_view doing, LoadedScene& loaded,
                             Work&& work) {
  try {
    work();
    return true;
  } catch (const std::bad_alloc&) {
    loaded.diagnostics.error({}, fmt::format("there is not enough memory to {} '{}'", doing, request.path));
    return false;
  }
}

void load_scene(const SceneRequest& request, LoadedScene& loaded, Keeps keeps) {
  loaded.diagnostics = loaded.of_text;
  loaded.files_read.clear();
  loaded.assets.clear();
  or_out_of_memory(request, "build the scene of", loaded, [&] { resolve_scene(request, keeps, loaded); });
}

std::unique_ptr<LoadedScene> load(const SceneRequest& request, Stage last) {
  auto loaded = std::make_unique<LoadedScene>();
  const bool read = or_out_of_memory(request, "read", *loaded, [&] { read_text(request, last, *loaded); });
  loaded->of_text = loaded->diagnostics;
  if (read && last == Stage::scene && loaded->source.valid() && !loaded->diagnostics.full())
    load_scene(request, *loaded);
  return loaded;
}

}  // namespace tyndall::tools
