// Tree to Scene: the order of things.
#include "resolve/resolve.h"

#include <fmt/format.h>

#include <algorithm>

#include "resolve/animation.h"
#include "resolve/checks.h"
#include "resolve/never_run.h"
#include "resolve/run.h"
#include "syntax/parser.h"

namespace tyndall::resolve {

namespace {

// Reads the --set options' expressions, each as a source of its own.
void read_overrides(Run& run) {
  for (const auto& [name, text] : run.options.overrides) {
    const SourceId source = run.sources.add(fmt::format("<--set {}>", name), text);
    const Span span{source, 0, static_cast<std::uint32_t>(text.size())};
    const syntax::SymbolId symbol = run.symbols.intern(name);
    if (std::any_of(run.overrides.begin(), run.overrides.end(),
                    [&](const Override& o) { return o.symbol == symbol; })) {
      run.diagnostics.error(span, fmt::format("'{}' is set twice", name), "give --set once for each name");
      continue;
    }
    const syntax::TokenList tokens = syntax::lex(run.sources, source, run.diagnostics);
    run.overrides.push_back(
        {symbol, syntax::parse_expression(run.sources, source, tokens, run.symbols, run.diagnostics), span});
  }
}

// Settles `frame` and `time` for all that follows.
void settle_time(Run& run) {
  run.foreseen = foresee_animation(run);
  run.scene.frame = run.options.frame.value_or(run.foreseen ? run.foreseen->first_frame : 0);
  run.scene.time = run.foreseen ? run.scene.frame / run.foreseen->fps : 0;
  run.context.frame = run.scene.frame;
  run.context.time = run.scene.time;
}

void run_main_file(Run& run) {
  run.file_scope = std::make_shared<eval::Scope>();
  std::vector<std::string> included;
  run.includes.open.push_back(main_file_key(run));
  run_block(run, Site{run.main, run.file_scope, &included}, run.main->file);
  run.includes.open.pop_back();
}

}  // namespace

Run::Run(const syntax::SyntaxTree& tree, Sources& sources_, syntax::Symbols& symbols_,
         const Options& options_, Diagnostics& diagnostics_)
    : sources(sources_),
      symbols(symbols_),
      options(options_),
      diagnostics(diagnostics_),
      main(&tree),
      images(*this),
      context{.sources = &sources_,
              .symbols = &symbols_,
              .diagnostics = &diagnostics_,
              .main_source = tree.source,
              .images = &images},
      evaluator(context),
      schemas(symbols_),
      statements(symbols_),
      blocks_run(tree.blocks.size()) {
  note_unread(*this, tree);
}

void note_unread(Run& run, const syntax::SyntaxTree& tree) {
  eval::Unread& unread = run.context.unread;
  unread.definitions.insert(unread.definitions.end(), tree.unread_definitions.begin(),
                            tree.unread_definitions.end());
  unread.file = unread.file || tree.gave_up;
}

scene::Scene resolve(const syntax::SyntaxTree& tree, Sources& sources, syntax::Symbols& symbols,
                     const Options& options, Diagnostics& diagnostics) {
  Run run(tree, sources, symbols, options, diagnostics);
  read_overrides(run);
  settle_time(run);
  run_main_file(run);
  if (!run.finished()) {
    check_never_run(run);
    check_unused_bodies(run);
    report_unused(run, *run.file_scope);
    check_overrides(run);
    check_scene(run);
  }
  return std::move(run.scene);
}

}  // namespace tyndall::resolve
