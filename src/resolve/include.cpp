// Other files' items, brought in where the `include` stands.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "resolve/run.h"
#include "syntax/parser.h"

namespace tyndall::resolve {

namespace {

namespace fs = std::filesystem;

// One name for a file however it is spelt; the path itself when the system knows none.
std::string canonical_name(const fs::path& path) {
  std::error_code failed;
  const fs::path result = fs::weakly_canonical(path, failed);
  return failed ? path.lexically_normal().string() : result.string();
}

// The whole file, or nothing after an error at `span`.
std::optional<std::string> read_file(Run& run, const fs::path& path, Span span) {
  std::error_code failed;
  const auto fail = [&](std::string why, std::string help = {}) {
    run.diagnostics.error(span, fmt::format("cannot read '{}': {}", path.string(), why), std::move(help));
    return std::nullopt;
  };
  if (!fs::is_regular_file(path, failed)) return fail("it is not a file");
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed) return fail(failed.message());
  if (size > max_file_bytes) return fail(fmt::format("it is larger than {} MB", max_file_bytes >> 20));
  std::ifstream file(path, std::ios::binary);
  std::string text(size, '\0');
  if (!file || !file.read(text.data(), static_cast<std::streamsize>(size))) return fail(std::strerror(errno));
  return text;
}

// The file's tree, read at its first inclusion; null when it cannot be read.
const syntax::SyntaxTree* tree_of(Run& run, const fs::path& path, const std::string& key, Span span) {
  const auto [known, is_new] = run.includes.trees.try_emplace(key);
  if (!is_new) return known->second.get();
  std::optional<std::string> text = read_file(run, path, span);
  if (!text) return nullptr;
  const SourceId source = run.sources.add(path.string(), std::move(*text));
  const syntax::TokenList tokens = syntax::lex(run.sources, source, run.diagnostics);
  known->second = std::make_shared<const syntax::SyntaxTree>(
      syntax::parse(run.sources, source, tokens, run.symbols, run.diagnostics));
  note_unread(run, *known->second);
  return known->second.get();
}

}  // namespace

std::optional<fs::path> find_file(const Run& run, const std::string& including, const std::string& name) {
  std::vector<fs::path> places = {fs::path(including).parent_path()};
  for (const std::string& directory : run.options.include_directories) places.emplace_back(directory);
  std::error_code failed;
  for (const fs::path& place : places) {
    if (!fs::exists(place / name, failed)) continue;
    if (run.options.files_read != nullptr) run.options.files_read->insert((place / name).string());
    return place / name;
  }
  return std::nullopt;
}

std::string main_file_key(const Run& run) { return canonical_name(run.sources[run.main->source].name()); }

void run_include(Run& run, const Site& site, const syntax::IncludeItem& include) {
  const Span span = (*site.tree)[include.file].span;
  const eval::Value name =
      run.evaluator.evaluate_as(eval::Type::string, *site.tree, include.file, site.scope, "include");
  // Names that nothing defines may be in a file that could not be read.
  if (name.is_error()) return void(run.context.unread.file = true);
  const auto path = find_file(run, run.sources[site.tree->source].name(), name.as_string());
  run.context.unread.file |= !path;
  if (!path)
    return run.diagnostics.error(span, fmt::format("no file '{}'", name.as_string()),
                                 run.options.include_directories.empty()
                                     ? "looked beside the including file; --include adds directories"
                                     : fmt::format("looked beside the including file and in: {}",
                                                   fmt::join(run.options.include_directories, ", ")));
  const std::string key = canonical_name(*path);
  if (std::find(run.includes.open.begin(), run.includes.open.end(), key) != run.includes.open.end())
    return run.diagnostics.error(span, fmt::format("'{}' includes itself", name.as_string()),
                                 "take out one of the includes in the circle");
  if (std::find(site.included->begin(), site.included->end(), key) != site.included->end()) return;
  if (run.includes.open.size() > max_include_depth)
    return run.diagnostics.error(span, fmt::format("files included more than {} deep", max_include_depth));
  site.included->push_back(key);
  run.diagnostics.push_context(span, "included from here");
  if (const syntax::SyntaxTree* tree = tree_of(run, *path, key, span)) {
    run.includes.open.push_back(key);
    Site inside = site;
    inside.tree = tree;
    run_block(run, inside, tree->file);
    run.includes.open.pop_back();
  } else {
    run.context.unread.file = true;
  }
  run.diagnostics.pop_context();
}

}  // namespace tyndall::resolve
