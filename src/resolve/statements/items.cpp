// The items of scene code, in order: definitions, variables, conditions, loops, statements.
#include <fmt/format.h>

#include <new>

#include "base/overloaded.h"
#include "resolve/foreseen_rounds.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// Sets a `var` of this scope or one around it.
void run_assign(Run& run, const Site& site, const syntax::AssignItem& assign) {
  const eval::Binding* binding = nullptr;
  for (const eval::Scope* scope = site.scope.get(); scope && !binding; scope = scope->parent.get()) {
    binding = scope->find_here(assign.name.symbol);
    if (scope->assignments_end_here) break;
    if (!binding && run.building && scope == run.building->scope) run.building->sets_variable = true;
  }
  const std::string_view name = run.symbols.text(assign.name.symbol);
  if (!binding) {
    std::vector<std::string_view> variables;
    for (const eval::Scope* scope = site.scope.get(); scope; scope = scope->parent.get())
      for (const eval::Binding& b : scope->bindings)
        if (b.kind == eval::BindingKind::variable) variables.push_back(run.symbols.text(b.symbol));
    std::string help = did_you_mean(name, variables);
    if (help.empty())
      help = fmt::format("write `let {} = …`, or `var {} = …` for one that changes", name, name);
    run.context.unread.definitions.push_back(assign.name.symbol);  // its uses are no mistakes
    return run.diagnostics.error(assign.name.span, fmt::format("no variable '{}' to set", name),
                                 std::move(help));
  }
  if (binding->kind != eval::BindingKind::variable)
    return run.diagnostics.error(assign.name.span, fmt::format("'{}' cannot be set: it is not a `var`", name),
                                 fmt::format("define it with `var {} = …`", name),
                                 {{binding->definition, "defined here"}});
  // The evaluation may add bindings nowhere but in new scopes, so `binding` stays where it is.
  binding->value = run.evaluator.evaluate_variable(*site.tree, assign.value, site.scope, &binding->value);
}

void run_if(Run& run, const Site& site, const syntax::IfItem& item) {
  const eval::Value condition = run.evaluator.evaluate_as(eval::Type::boolean, *site.tree, item.condition,
                                                          site.scope, "the condition of `if`");
  if (condition.is_error()) return;
  const bool is_true = run.structure.settled(condition.as_bool());
  const syntax::BlockId taken = is_true ? item.then_block : item.else_block;
  const syntax::BlockId other = is_true ? item.else_block : item.then_block;
  if (taken.valid()) run_inner_block(run, site, taken);
  if (other.valid()) pass_over(run, site, other);
}

void run_definition(Run& run, const Site& site, const syntax::Item& item) {
  run.evaluator.define(*site.tree, item, site.scope);
  if (const auto* body = std::get_if<syntax::BodyItem>(&item.node))
    if (const eval::Binding* binding = site.scope->find_here(body->name.symbol))
      note_definition(run, *site.tree, *body, binding->value);
}

// A scope below another.
std::shared_ptr<eval::Scope> below(const std::shared_ptr<eval::Scope>& scope) {
  auto inner = std::make_shared<eval::Scope>();
  inner->parent = scope;
  return inner;
}

}  // namespace

bool Run::may_repeat(double rounds, Span span) {
  if (!may_foresee(rounds, span)) return false;
  repetitions += static_cast<long>(rounds);
  return true;
}

bool Run::may_foresee(double rounds, Span span) {
  if (static_cast<double>(repetitions) + rounds <= static_cast<double>(options.max_repetitions)) return true;
  if (!stopped)
    diagnostics.error(span,
                      fmt::format("more than {} rounds of loops and calls of templates, and facets of shapes",
                                  options.max_repetitions),
                      "a scene may have that many in all");
  stopped = true;
  return false;
}

void report_undefined(Run& run, syntax::SymbolId symbol, Span span, std::string message, std::string help) {
  if (run.context.unread.may_define(symbol)) return;
  std::vector<Diagnostic::Note> notes;
  if (const auto elsewhere = run.context.defined_elsewhere(symbol, span)) {
    help = elsewhere->help;
    notes.push_back({elsewhere->place, fmt::format("'{}' is defined here", run.symbols.text(symbol))});
  }
  run.diagnostics.error_once(span, std::move(message), std::move(help), std::move(notes));
}

void run_block(Run& run, const Site& site, syntax::BlockId block, Parameters parameters) {
  const syntax::Block& b = (*site.tree)[block];
  if (run.block_depth >= max_block_depth) {
    run.diagnostics.error(b.span, fmt::format("blocks nested more than {} deep", max_block_depth));
    run.stopped = true;
    return;
  }
  ++run.block_depth;
  if (site.tree == run.main) run.blocks_run[block.index] = true;
  for (const syntax::ItemId id : site.tree->list_of_items(b.items)) {
    if (run.finished()) break;
    const syntax::Item& item = (*site.tree)[id];
    if (parameters == Parameters::read && std::holds_alternative<syntax::ParameterItem>(item.node)) continue;
    try {
      run_item(run, site, item);
    } catch (const std::bad_alloc&) {  // what the item had taken is free again
      run.stopped = true;
      run.diagnostics.error(item.span, "there is not enough memory for what this makes",
                            "make less of it, or use a machine with more");
    }
  }
  --run.block_depth;
}

void run_inner_block(Run& run, const Site& site, syntax::BlockId block, Parameters parameters) {
  Site inside = site;
  inside.scope = below(site.scope);
  std::unordered_set<std::string> included;
  inside.included = &included;
  run_block(run, inside, block, parameters);
  report_unused(run, *inside.scope);
}

void define_file_let(Run& run, eval::Evaluator& evaluator, const syntax::SyntaxTree& tree,
                     const syntax::Item& item, const syntax::LetItem& let,
                     const std::shared_ptr<eval::Scope>& scope) {
  for (Override& o : run.overrides) {
    if (o.symbol != let.name.symbol) continue;
    o.used = true;
    const eval::Value value = evaluator.evaluate(o.parsed.tree, o.parsed.expr, scope);
    return evaluator.bind(scope, {let.name.symbol, value, eval::BindingKind::constant, let.name.span});
  }
  evaluator.define(tree, item, scope);
}

void run_for(Run& run, const Site& site, const syntax::ForItem& loop) {
  const Span span = (*site.tree)[loop.range].span;
  const eval::Value values = run.evaluator.evaluate(*site.tree, loop.range, site.scope);
  if (values.is_error()) return;
  const auto* range = values.get<eval::RangeValue>();
  const auto* list = values.get<std::vector<eval::Value>>();
  if (!range && !list)
    return run.diagnostics.error(
        span, fmt::format("`for` goes over a range or a list, found {}", eval::describe(values.type)),
        "write `for i in 0..<8 { … }`");
  const eval::RangeValue over = range ? run.structure.settled(*range) : eval::RangeValue{};
  const std::int64_t rounds =
      range ? eval::count(over) : static_cast<std::int64_t>(run.structure.settled(list->size()));
  if (list && static_cast<std::size_t>(rounds) > list->size())
    return run.diagnostics.error(span, "the list has another length later while the shutter is open",
                                 "only numbers may depend on `time`, not how many there are");
  if (!run.may_repeat(static_cast<double>(rounds), span)) return;
  if (site.scope == run.file_scope &&
      !run.may_foresee(static_cast<double>(rounds) * foreseen_rounds(run, *site.tree, loop.body), span))
    return;
  // A round with an error ends the loop: the next ones would repeat it.
  const int errors = run.diagnostics.error_count();
  Site inside = site;
  for (std::int64_t i = 0; i < rounds && !run.finished() && run.diagnostics.error_count() == errors; ++i) {
    inside.scope = below(site.scope);
    std::unordered_set<std::string> included;
    inside.included = &included;
    const eval::Value value =
        range ? eval::Value::number(eval::at(over, i)) : (*list)[static_cast<std::size_t>(i)];
    run.evaluator.bind(inside.scope, {loop.name.symbol, value, eval::BindingKind::parameter, loop.name.span});
    run_block(run, inside, loop.body);
    if (i == 0) report_unused(run, *inside.scope);
  }
  if (rounds == 0) pass_over(run, site, loop.body, {}, loop.name.symbol);
}

void run_item(Run& run, const Site& site, const syntax::Item& item) {
  std::visit(Overloaded{
                 [&](const syntax::LetItem& let) {
                   if (site.scope != run.file_scope) return run_definition(run, site, item);
                   run.file_lets.push_back(let.name.symbol);
                   define_file_let(run, run.evaluator, *site.tree, item, let, site.scope);
                 },
                 [&](const syntax::VarItem&) { run_definition(run, site, item); },
                 [&](const syntax::FunctionItem&) { run_definition(run, site, item); },
                 [&](const syntax::TemplateItem& form) {
                   pass_over(run, site, form.body, form.parameters);
                   run_definition(run, site, item);
                 },
                 [&](const syntax::BodyItem&) { run_definition(run, site, item); },
                 [&](const syntax::ObjectItem& object) {
                   pass_over(run, site, object.body, object.parameters);
                   run_definition(run, site, item);
                 },
                 [&](const syntax::AssignItem& assign) { run_assign(run, site, assign); },
                 [&](const syntax::IncludeItem& include) { run_include(run, site, include); },
                 [&](const syntax::ForItem& loop) { run_for(run, site, loop); },
                 [&](const syntax::IfItem& condition) { run_if(run, site, condition); },
                 [&](const syntax::PlaceItem& place) { run_place(run, site, place); },
                 [&](const syntax::CallItem& call) { run_call(run, site, call); },
                 [&](const syntax::ThingItem& thing) { run_thing(run, site, thing); },
                 [&](const syntax::ReturnItem&) {
                   run.diagnostics.error(item.span, "`return` belongs in a function",
                                         "a function is `def f(x) = { … }`");
                 },
                 [&](const syntax::ParameterItem& parameter) {
                   const std::string_view name = run.symbols.text(parameter.name.symbol);
                   run.diagnostics.error(parameter.name.span,
                                         fmt::format("'{}: …' belongs in the braces of a thing", name),
                                         fmt::format("write `let {} = …` to name a value", name));
                 },
             },
             item.node);
}

}  // namespace tyndall::resolve
