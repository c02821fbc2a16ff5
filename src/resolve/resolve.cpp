// Tree to Scene: the order of things.
#include "resolve/resolve.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/overloaded.h"
#include "resolve/checks/scene_checks.h"
#include "resolve/checks/unreached_code.h"
#include "resolve/kept_parts.h"
#include "resolve/motion_keys.h"
#include "resolve/resolve_context.h"
#include "resolve/statements/animation.h"
#include "syntax/parser.h"

namespace tyndall::resolve {

namespace {

// Reads the --set options' expressions, each as a source of its own.
void read_overrides(Run& run) {
  if (KeptParts* kept = kept_parts(run); kept && !kept->overrides.empty()) {
    run.overrides = kept->overrides;
    for (Override& override : run.overrides) override.used = false;
    return;
  }
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
  run.context.frame = run.scene.frame;
  run.context.frame_time = run.foreseen ? run.scene.frame / run.foreseen->fps : 0;
  run.scene.time = run.foreseen ? scene::opening_time(*run.foreseen, run.scene.frame) : 0;
  run.context.time = run.scene.time;
  run.context.shutter_open = run.foreseen && run.foreseen->shutter.open();
  run.context.opened = run.scene.time;
  run.context.shutter_seconds = run.foreseen ? scene::shutter_seconds(*run.foreseen) : 0;
  run.structure.keep(run.context.shutter_open);
}

void run_main_file(Run& run) {
  run.file_scope = std::make_shared<eval::Scope>();
  std::unordered_set<std::string> included;
  run.includes.open.push_back(main_file_key(run));
  run_block(run, Site{run.main, run.file_scope, &included}, run.main->file);
  run.includes.open.pop_back();
}

std::optional<SceneThen> scene_at(Run& first, double fraction) {
  Diagnostics diagnostics;
  Run run(*first.main, first.sources, first.symbols, first.options, diagnostics, &first.structure);
  // Text, pictures and grids are read once.
  run.overrides = first.overrides;
  run.includes.trees = first.includes.trees;
  for (const auto& [key, tree] : run.includes.trees)
    if (tree) note_unread(run, *tree);
  run.images.share(first.images);
  run.imported.share(first.imported);
  run.grids.share(first.grids);
  run.foreseen = first.foreseen;
  run.scene.frame = first.scene.frame;
  run.scene.time = first.scene.time;
  run.context.frame = first.scene.frame;
  run.context.opened = first.context.opened;
  run.context.frame_time = first.context.frame_time;
  run.context.shutter_seconds = first.context.shutter_seconds;
  run.context.time = first.scene.time + fraction * first.context.shutter_seconds;
  run_main_file(run);
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::error) {
      const std::string when =
          fmt::format("so it is {:.4g} s after the shutter opens", run.context.time - first.scene.time);
      std::vector<Diagnostic::Note> notes = d.notes;
      notes.push_back({d.span, when});
      first.diagnostics.error(d.span, d.message, d.help, std::move(notes));
      return std::nullopt;
    }
  return SceneThen{std::move(run.scene), std::move(run.written)};
}

}  // namespace

Run::Run(const syntax::SyntaxTree& tree, Sources& sources_, syntax::Symbols& symbols_,
         const Options& options_, Diagnostics& diagnostics_, const Structure* earlier)
    : sources(sources_),
      symbols(symbols_),
      options(options_),
      diagnostics(diagnostics_),
      main(&tree),
      images(*this),
      grids(*this),
      context{.sources = &sources_,
              .symbols = &symbols_,
              .diagnostics = &diagnostics_,
              .main_source = tree.source,
              .images = &images,
              .grids = &grids},
      evaluator(context),
      schemas(symbols_),
      statements(all_statements(), symbols_),
      structure(earlier),
      blocks_run(tree.blocks.size()) {
  note_unread(*this, tree);
}

eval::RangeValue Structure::settled(const eval::RangeValue& now) {
  if (!earlier_) {
    if (keeps_) kept_.push_back(now);
    return now;
  }
  // A run that goes another way than the first is refused when its things are compared.
  return place_ < earlier_->kept_.size() ? earlier_->kept_[place_++] : now;
}

bool only_defines(const syntax::SyntaxTree& tree) {
  const auto items = tree.list_of_items(tree[tree.file].items);
  return !items.empty() && std::all_of(items.begin(), items.end(), [&](syntax::ItemId id) {
    return std::visit(
        Overloaded{
            [](const syntax::LetItem&) { return true; }, [](const syntax::FunctionItem&) { return true; },
            [](const syntax::TemplateItem&) { return true; }, [](const syntax::BodyItem&) { return true; },
            [](const syntax::ObjectItem&) { return true; }, [](const syntax::IncludeItem&) { return true; },
            [](const auto&) { return false; }},
        tree[id].node);
  });
}

void note_unread(Run& run, const syntax::SyntaxTree& tree) {
  eval::Unread& unread = run.context.unread;
  unread.definitions.insert(unread.definitions.end(), tree.unread_definitions.begin(),
                            tree.unread_definitions.end());
  unread.file = unread.file || tree.gave_up;
  run.context.trees.push_back(&tree);
}

scene::Scene resolve(const syntax::SyntaxTree& tree, Sources& sources, syntax::Symbols& symbols,
                     const Options& options, Diagnostics& diagnostics) {
  Run run(tree, sources, symbols, options, diagnostics);
  if (options.kept) options.kept->files = {};
  read_overrides(run);
  settle_time(run);
  run_main_file(run);
  if (!run.finished()) {
    check_never_run(run);
    check_overrides(run);
    if (options.may_only_define && only_defines(tree)) return std::move(run.scene);
    check_unused_bodies(run);
    report_unused(run, *run.file_scope);
    check_scene(run);
    if (run.context.shutter_open && run.context.time_reads > 0 && !run.diagnostics.has_errors())
      find_motion(run, scene_at);
  }
  keep_parts(run);
  return std::move(run.scene);
}

std::optional<scene::Animation> animation_of(const syntax::SyntaxTree& tree, Sources& sources,
                                             syntax::Symbols& symbols, const Options& options) {
  Diagnostics told_when_it_is_read;
  Run run(tree, sources, symbols, options, told_when_it_is_read);
  read_overrides(run);
  return foresee_animation(run);
}

}  // namespace tyndall::resolve
