#include "scene_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "image/compare.h"
#include "resolve/resolve.h"
#include "syntax/parser.h"

namespace tyndall {

std::optional<scene::Scene> read_scene(const std::string& name, std::string text,
                                       std::vector<std::pair<std::string, std::string>> overrides) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add(name, std::move(text));
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  resolve::Options options;
  options.overrides = std::move(overrides);
  scene::Scene scene = resolve::resolve(tree, sources, symbols, options, diagnostics);
  if (!diagnostics.has_errors()) return scene;
  fmt::print(stderr, "{}", render_text(diagnostics, sources, false));
  return std::nullopt;
}

std::optional<scene::Scene> load_scene(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return read_scene(path, {std::istreambuf_iterator<char>(file), {}});
}

Cost cost_of(const compile::CompiledScene& world, const render::RenderOptions& options,
             const image::Image& reference) {
  const render::RenderResult result = render::render(world, options);
  return {result.statistics.seconds, image::compare(result.film.image(), reference).relative_mse};
}

}  // namespace tyndall
