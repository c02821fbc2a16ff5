// Templates called as statements.
#include <fmt/format.h>

#include "eval/printing.h"
#include "resolve/expansion_notes.h"
#include "resolve/foreseen_rounds.h"
#include "resolve/resolve_context.h"
#include "syntax/foreign_words.h"

namespace tyndall::resolve {

namespace {

void report_no_template(Run& run, const Site& site, const syntax::NameExpr& name, Span span) {
  const std::string_view word = run.symbols.text(name.symbol);
  if (const eval::BuiltinEntry* builtin = run.evaluator.names().builtin(name.symbol))
    return run.diagnostics.error(span, fmt::format("'{}' gives a value and places nothing", word),
                                 builtin->row->result.starts_with("transform")
                                     ? "it goes in transform: …, and several are joined with '*': "
                                       "translate((0, 1, 0)) * rotate_y(30deg)"
                                     : "use it in an expression: `let a = …`");
  if (run.statements.find(name.symbol, {}))
    return run.diagnostics.error(span, fmt::format("'{}' takes its parameters in braces", word),
                                 fmt::format("write `{} {{ … }}`", word));
  std::vector<std::string_view> templates;
  for (const eval::Scope* scope = site.scope.get(); scope; scope = scope->parent.get())
    for (const eval::Binding& binding : scope->bindings)
      if (binding.value.type == eval::Type::function) templates.push_back(run.symbols.text(binding.symbol));
  const std::string_view foreign = syntax::help_for_foreign_word(syntax::ForeignUse::statement, word);
  report_undefined(run, name.symbol, span, fmt::format("no template '{}'", word),
                   foreign.empty() ? did_you_mean(word, templates) : std::string(foreign));
}

// The value that is called; an error value after reporting that there is none.
eval::Value callee_of(Run& run, const Site& site, syntax::ExprId callee) {
  const syntax::Expr& expr = (*site.tree)[callee];
  const auto* name = std::get_if<syntax::NameExpr>(&expr.node);
  if (!name) return run.evaluator.evaluate(*site.tree, callee, site.scope);
  if (const eval::Binding* binding = site.scope->find(name->symbol)) return binding->value;
  report_no_template(run, site, *name, expr.span);
  return {};
}

}  // namespace

void run_call(Run& run, const Site& site, const syntax::CallItem& item) {
  const syntax::Expr& expr = (*site.tree)[item.call];
  const auto* call = std::get_if<syntax::CallExpr>(&expr.node);
  if (!call) return;  // an expression that could not be read
  if (eval::ran_print(run.evaluator, *site.tree, item, site.scope)) return;
  const eval::Value callee = callee_of(run, site, call->callee);
  if (callee.is_error()) return;
  const Span callee_span = (*site.tree)[call->callee].span;
  const std::string_view name = run.sources.text(callee_span);
  const auto* function = callee.get<eval::Function>();
  const auto* definition = function ? std::get_if<syntax::TemplateItem>(&function->item->node) : nullptr;
  if (!definition)
    return run.diagnostics.error(
        callee_span,
        function ? fmt::format("'{}' gives a value and places nothing", name)
                 : fmt::format("'{}' is {}, not a template", name, eval::describe(callee.type)),
        callee.type == eval::Type::object
            ? fmt::format("an object is placed: place {} {{ transform: … }}", name)
            : std::string("a template is `def name(…) { … }`"));
  // Those in it are foreseen with the outermost call.
  if (run.template_depth == 0 && !run.may_foresee(foreseen_rounds(run, *function), expr.span)) return;
  if (!run.may_repeat(1, expr.span)) return;
  const auto scope = run.evaluator.bind_arguments(*function->tree, definition->parameters, function->scope,
                                                  *site.tree, call->arguments, site.scope, name, expr.span);
  if (!scope) return;
  const Nested nested(run, expr.span);
  if (!nested.entered()) return;
  Site inside = site;
  inside.tree = function->tree;
  inside.scope = scope;
  std::unordered_set<std::string> included;
  inside.included = &included;
  run_block(run, inside, definition->body);
  report_unused(run, *scope);
}

}  // namespace tyndall::resolve
