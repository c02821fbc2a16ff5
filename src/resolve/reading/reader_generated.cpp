// What shapes that are made into meshes take: outlines, alignments, heights.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "resolve/reading/reader.h"

namespace tyndall::resolve {

void Reader::read_value(const FieldInfo& info, const Given& given, Pair<double>& to) {
  const eval::Value value = evaluate(eval::Type::pair, info, given);
  if (!value.is_error()) to = {value.scalars[0].value, value.scalars[1].value};
}

void Reader::read_value(const FieldInfo& info, const Given& given, generate::Outlines& to) {
  const eval::Value list = evaluate(eval::Type::list, info, given);
  if (list.is_error()) return;
  const auto add_point = [&](const eval::Value& written) {
    const eval::Value point = element(eval::Type::pair, info, given, written);
    if (!point.is_error()) to.closed.back().push_back({point.scalars[0].value, point.scalars[1].value});
    return !point.is_error();
  };
  const bool many = !list.as_list().empty() && list.as_list().front().type == eval::Type::list;
  if (!many && !list.as_list().empty()) to.closed.emplace_back();
  for (const eval::Value& written : list.as_list()) {
    if (!many) {
      if (!add_point(written)) return;
      continue;
    }
    const eval::Value outline = element(eval::Type::list, info, given, written);
    if (outline.is_error()) return;
    to.closed.emplace_back();
    for (const eval::Value& point : outline.as_list())
      if (!add_point(point)) return;
  }
}

void Reader::read_value(const FieldInfo& info, const Given& given, generate::Align& to) {
  const std::string_view written = word(given.item->value);
  std::vector<std::string_view> names;
  for (const generate::AlignInfo& row : generate::alignments) {
    if (row.name == written) {
      to = row.value;
      return;
    }
    names.push_back(row.name);
  }
  error(value_span(given), fmt::format("'{}' wants one of {}", info.name, fmt::join(names, ", ")),
        did_you_mean(written, names));
}

namespace {

// The call `height(uv)` of a value, as if it stood where the value does.
struct HeightCall {
  syntax::SyntaxTree tree;
  syntax::ExprId call;
  std::shared_ptr<eval::Scope> scope = std::make_shared<eval::Scope>();

  HeightCall(const eval::Value& function, syntax::SymbolId name, syntax::SymbolId argument, Span span) {
    tree.source = span.source;
    tree.exprs = {{span, syntax::NameExpr{name}},
                  {span, syntax::NameExpr{argument}},
                  {span, syntax::CallExpr{syntax::ExprId(0), {0, 1}}}};
    tree.arguments = {{{}, syntax::ExprId(1)}};
    call = syntax::ExprId(2);
    scope->bindings.push_back({name, function, eval::BindingKind::parameter, span, true});
    scope->bindings.push_back({argument, {}, eval::BindingKind::parameter, span, true});
  }
};

}  // namespace

void Reader::read_value(const FieldInfo& info, const Given& given, generate::HeightFunction& to) {
  const eval::Value function = evaluator_.evaluate(*site_.tree, given.item->value, *site_.scope);
  if (function.is_error()) {
    ok_ = false;
    return;
  }
  const Span span = value_span(given);
  if (function.type != eval::Type::function && function.type != eval::Type::image)
    return error(span,
                 fmt::format("'{}' wants a function of uv or an image, found {}", info.name,
                             eval::describe(function.type)),
                 "define one, def hills(uv) = 0.2 * sin(9 * uv.x), and write its name alone: height: hills");
  const auto call =
      std::make_shared<const HeightCall>(function, symbols_.intern(info.name), symbols_.intern("uv"), span);
  to = [this, call, span, name = info.name](const Pair<double>& uv) -> std::optional<double> {
    call->scope->bindings[1].value = eval::Value::pair(uv.x, uv.y);
    const eval::Value y = evaluator_.evaluate(call->tree, call->call, call->scope);
    if (y.is_error()) {
      ok_ = false;
    } else if (y.type == eval::Type::number &&
               (y.unit == syntax::Unit::none || y.unit == syntax::Unit::length)) {
      return y.as_number();
    } else {
      error(
          span,
          fmt::format("'{}' gives {} at uv ({:.4g}, {:.4g}), wanted a length", name,
                      y.type == eval::Type::number ? unit_name(y.unit) : eval::describe(y.type), uv.x, uv.y),
          y.type == eval::Type::vec ? "name a channel of an image: image(\"hills.png\", \"R\")" : "");
    }
    return std::nullopt;
  };
}

}  // namespace tyndall::resolve
