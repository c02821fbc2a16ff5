// The files that a scene names, and which of them it may.
#include <fmt/format.h>

#include <algorithm>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

namespace fs = std::filesystem;

// Whether a path, free of links, lies below one of the folders.
bool is_below(const fs::path& path, const std::vector<fs::path>& folders) {
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
  });
}

fs::path folder_of(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

}  // namespace

fs::path canonical_path(const fs::path& path) {
  std::error_code failed;
  const fs::path absolute = fs::absolute(path, failed);
  if (failed) return path.lexically_normal();
  const fs::path result = fs::weakly_canonical(absolute, failed);
  return failed ? path.lexically_normal() : result;
}

void note_asset(Run& run, const Asset& asset, std::uint64_t bytes) {
  if (run.options.assets != nullptr && !run.structure.later()) run.options.assets->emplace(asset, bytes);
}

std::optional<fs::path> find_file(Run& run, std::string_view noun, const std::string& name, Span span) {
  if (name.empty()) {
    run.diagnostics.error(span, "the name of a file is empty", "write the file's name");
    return std::nullopt;
  }
  // The system would read up to there: another file than is checked.
  if (name.find('\0') != std::string::npos) {
    run.diagnostics.error(span, "the name of a file cannot hold NUL", "leave \\u{0} out");
    return std::nullopt;
  }
  const std::vector<std::string>& directories = run.options.include_directories;
  const fs::path beside = folder_of(run.sources[span.source].name());
  const std::string key = fmt::format("{}\n{}", beside.string(), name);
  if (const auto found = run.files.found.find(key); found != run.files.found.end()) return found->second;
  std::vector<fs::path>& folders = run.files.folders;
  if (folders.empty()) {
    folders.push_back(canonical_path(folder_of(run.sources[run.main->source].name())));
    for (const std::string& directory : directories) folders.push_back(canonical_path(directory));
  }
  std::vector<fs::path> places = {beside == "." ? fs::path() : beside};
  for (const std::string& directory : directories) places.emplace_back(directory);
  bool is_outside = false;
  for (const fs::path& place : places) {
    const fs::path path = place / name;
    std::error_code failed;
    if (!run.options.allow_outside && !is_below(canonical_path(path), folders))
      is_outside = true;
    else if (fs::exists(path, failed)) {
      if (run.options.files_read != nullptr) run.options.files_read->insert(path.string());
      return run.files.found.emplace(key, path).first->second;
    }
  }
  if (is_outside)
    run.diagnostics.error(span, fmt::format("'{}' is outside of the scene's folder", name),
                          "--include DIR opens a folder to it, --allow-outside all there are");
  else if (directories.empty())
    run.diagnostics.error(span, fmt::format("no {} '{}'", noun, name),
                          "looked beside the file that names it; --include adds directories");
  else
    run.diagnostics.error(
        span, fmt::format("no {} '{}'", noun, name),
        fmt::format("looked beside the file that names it and in: {}", fmt::join(directories, ", ")));
  return std::nullopt;
}

std::optional<NamedFile> named_file(Run& run, const syntax::SyntaxTree& tree, syntax::ExprId file,
                                    const std::shared_ptr<const eval::Scope>& scope) {
  const Span span = tree[file].span;
  const auto below = std::make_shared<eval::Scope>();
  below->parent = scope;
  const eval::Value name =
      run.evaluator.evaluate_as(eval::Type::string, tree, file, below, "the file's name");
  if (name.is_error()) return std::nullopt;
  const auto path = find_file(run, "file", name.as_string(), span);
  if (!path) return std::nullopt;
  return NamedFile{*path, name.as_string(), span};
}

std::optional<fs::path> find_beside(const Options& options, const fs::path& file, const std::string& name,
                                    std::string& why) {
  const fs::path folder = folder_of(file.string()), path = folder / name;
  if (!options.allow_outside && !is_below(canonical_path(path), {canonical_path(folder)})) {
    why = fmt::format("names '{}', outside of the file's folder; --allow-outside opens all there are", name);
    return std::nullopt;
  }
  std::error_code failed;
  if (!fs::exists(path, failed)) {
    why = fmt::format("names '{}', and there is no such file", name);
    return std::nullopt;
  }
  if (options.files_read != nullptr) options.files_read->insert(path.string());
  return path;
}

}  // namespace tyndall::resolve
