// print(…): tells values while the scene is read.
#include <algorithm>

#include "eval/calls.h"
#include "eval/printing.h"

namespace tyndall::eval {

static Value print(CallSite& site) {
  constexpr std::size_t most_bytes = 1000;
  std::string text;
  Value last;
  bool failed = false;
  for (const syntax::Argument& argument : site.written()) {
    const Span place = site.tree[argument.value].span;
    last = site.ev.evaluate(site.tree, argument.value, site.scope);
    failed |= last.is_error();
    if (argument.name.symbol.valid()) {
      site.ev.error(argument.name.span, "the arguments of 'print' have no names",
                    "write print(\"radius\", radius)");
      failed = true;
    } else if (!last.is_error() && !last.known()) {
      site.ev.error(place, "'print' can tell only what is known when the scene is read",
                    "this differs from place to place: look at it with `tyndall inspect … --medium … --slice "
                    "z=0 --show …`");
      failed = true;
    }
    if (failed) continue;
    if (!text.empty()) text += ' ';
    const std::size_t room = most_bytes - std::min(text.size(), most_bytes);
    std::string shown;
    if (!append_text(shown, last, room)) shown.resize(std::min(shown.size(), room)), shown += "…";
    text += shown;
  }
  if (failed) return {};
  if (site.written().empty())
    return site.ev.error(site.span, "'print' wants an argument", "write print(\"radius\", radius)");
  site.ev.context().diagnostics->note(site.span, std::move(text));
  return last;
}

bool ran_print(Evaluator& ev, const syntax::SyntaxTree& tree, const syntax::CallItem& item,
               const std::shared_ptr<Scope>& scope) {
  const auto* call = std::get_if<syntax::CallExpr>(&tree[item.call].node);
  const auto* name = call ? std::get_if<syntax::NameExpr>(&tree[call->callee].node) : nullptr;
  if (!name || scope->find(name->symbol)) return false;
  const BuiltinEntry* builtin = ev.names().builtin(name->symbol);
  if (!builtin || builtin->free != print) return false;
  ev.evaluate(tree, item.call, scope);
  return true;
}
bool ran_print(Evaluator& ev, const syntax::SyntaxTree& tree, const syntax::Item& item,
               const std::shared_ptr<Scope>& scope) {
  const auto* call = std::get_if<syntax::CallItem>(&item.node);
  return call && ran_print(ev, tree, *call, scope);
}

Handlers print_handler(std::string_view name) {
  if (name == "print") return {nullptr, print};
  return {};
}

}  // namespace tyndall::eval
