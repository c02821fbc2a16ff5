// Evaluates pieces of scene text for the tests of this folder.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "eval/evaluator.h"
#include "eval/operators.h"
#include "syntax/parser.h"
#include "vm/run/machine.h"

namespace tyndall::eval {

// Reads a text of definitions and evaluates its items in order; the value asked for is the let named
// `result`.
class SceneText {
 public:
  explicit SceneText(std::string text, double time = 0, double frame = 0) {
    const SourceId source = sources.add("test.tyn", std::move(text));
    context.sources = &sources;
    context.symbols = &symbols;
    context.diagnostics = &diagnostics;
    context.time = time;
    context.frame = frame;
    tree = syntax::parse(sources, source, syntax::lex(sources, source, diagnostics), symbols, diagnostics);
    parsed = !diagnostics.has_errors();
  }

  // Evaluates every definition in scene code, or as the steps of a body.
  Value scene() {
    Evaluator evaluator(context);
    for (const syntax::ItemId id : tree.list_of_items(tree[tree.file].items))
      evaluator.define(tree, tree[id], scope);
    const Binding* binding = scope->find_here(symbols.intern("result"));
    return binding ? binding->value : Value{};
  }

  // The first error with its help, or nothing.
  std::string first_error() const {
    for (const Diagnostic& d : diagnostics.all())
      if (d.severity == Severity::error) return d.message + " | " + d.help;
    return {};
  }
  std::string_view first_error_text() const {
    for (const Diagnostic& d : diagnostics.all())
      if (d.severity == Severity::error) return sources.text(d.span);
    return {};
  }
  std::string all_messages() const { return render_text(diagnostics, sources, false); }

  Sources sources;
  syntax::Symbols symbols;
  Diagnostics diagnostics;
  Context context;
  syntax::SyntaxTree tree;
  std::shared_ptr<Scope> scope = std::make_shared<Scope>();
  bool parsed = false;
};

}  // namespace tyndall::eval
