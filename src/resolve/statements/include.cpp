// Other files' items, brought in where the `include` stands.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "resolve/kept_parts.h"
#include "syntax/parser.h"

namespace tyndall::resolve {

namespace {

namespace fs = std::filesystem;

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
  if (KeptParts* kept = kept_parts(run)) {
    const auto before = kept->trees.find(key);
    run.options.kept->files.count(before != kept->trees.end());
    if (before != kept->trees.end()) {
      known->second = before->second;
      note_unread(run, *known->second);
      return known->second.get();
    }
  }
  std::optional<std::string> text = read_file(run, path, span);
  if (!text) return nullptr;
  const SourceId source = run.sources.add(path.string(), std::move(*text));
  Diagnostics found;
  const syntax::TokenList tokens = syntax::lex(run.sources, source, found);
  auto tree =
      std::make_unique<syntax::SyntaxTree>(syntax::parse(run.sources, source, tokens, run.symbols, found));
  if (found.has_errors() && fs::path(key).extension() != ".tyn") {
    // Perhaps no scene at all, and nobody else's business: nothing of it is shown.
    run.diagnostics.error(span, fmt::format("'{}' is not a scene", path.string()),
                          "if it is meant to be one, its name ends in .tyn: then its mistakes are shown");
    return nullptr;
  }
  for (const Diagnostic& d : found.all())
    if (d.severity == Severity::error)
      run.diagnostics.error(d.span, d.message, d.help, d.notes);
    else
      run.diagnostics.warning(d.span, d.message, d.help, d.notes);
  known->second = std::move(tree);
  note_unread(run, *known->second);
  return known->second.get();
}

}  // namespace

std::string main_file_key(const Run& run) {
  return canonical_path(run.sources[run.main->source].name()).string();
}

void run_include(Run& run, const Site& site, const syntax::IncludeItem& include) {
  const Span span = (*site.tree)[include.file].span;
  const eval::Value name =
      run.evaluator.evaluate_as(eval::Type::string, *site.tree, include.file, site.scope, "include");
  // Names that nothing defines may be in a file that could not be read.
  if (name.is_error()) return void(run.context.unread.file = true);
  const auto path = find_file(run, "file", name.as_string(), span);
  run.context.unread.file |= !path;
  if (!path) return;
  const std::string key = canonical_path(*path).string();
  if (std::find(run.includes.open.begin(), run.includes.open.end(), key) != run.includes.open.end())
    return run.diagnostics.error(span, fmt::format("'{}' includes itself", name.as_string()),
                                 "take out one of the includes in the circle");
  if (site.included->contains(key)) return;
  if (run.includes.open.size() > max_include_depth)
    return run.diagnostics.error(span, fmt::format("files included more than {} deep", max_include_depth));
  site.included->insert(key);
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
