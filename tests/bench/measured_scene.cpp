#include "measured_scene.h"

#include <fmt/format.h>

#include "compile/compiled_scene.h"
#include "resolve/resolve.h"
#include "syntax/parser.h"

namespace tyndall {

std::optional<Cost> cost_of_scene(const std::string& name, const std::string& text, Until until) {
  return measured_in_child([&](Laps& laps) {
    Sources sources;
    Diagnostics diagnostics;
    syntax::Symbols symbols;
    const SourceId source = sources.add(name, text);
    laps.mark();
    const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
    laps.mark();
    const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
    laps.mark();
    laps.measure_memory();
    std::optional<compile::CompiledScene> world;
    std::optional<scene::Scene> scene;
    if (until != Until::parsed) {
      scene = resolve::resolve(tree, sources, symbols, {}, diagnostics);
      laps.mark();
      laps.measure_memory();
    }
    if (diagnostics.has_errors()) {
      fmt::print(stderr, "{}", render_text(diagnostics, sources, false));
      return false;
    }
    if (until == Until::compiled) {
      world.emplace(compile::compile(std::move(*scene)));
      laps.mark();
      laps.measure_memory();
    }
    return true;
  });
}

bool print_target(std::string_view what, double found, std::string_view unit, double target, bool at_most) {
  const bool met = at_most ? found <= target : found >= target;
  fmt::print("  {:<44}{:>10.2f} {:<5} {} {:g}: {}\n", what, found, unit, at_most ? "at most" : "at least",
             target, met ? "met" : "MISSED");
  return met;
}

}  // namespace tyndall
