// How a camera's picture is shown: its exposure and tone curve.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/diagnostics.h"
#include "resolve/reading/reader.h"

namespace tyndall::resolve {

// Stops, or the choice `auto`: alone, or with stops beside the metered ones as if it were called.
void Reader::read_value(const FieldInfo& info, const Given& given, image::Exposure& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const syntax::ExprId written = given.item->value;
  if (word(written) == "auto") {
    to = {0, true};
    return;
  }
  const auto* call = std::get_if<syntax::CallExpr>(&tree[written].node);
  if (!call || word(call->callee) != "auto") {
    if (is_misspelt(written, {"auto"})) return;
    const eval::Value value = evaluate(eval::Type::number, info, given);
    if (!value.is_error()) to = {value.as_number(), false};
    return;
  }
  const auto arguments = tree.list_of_arguments(call->arguments);
  constexpr std::string_view help = "`auto(1)` is a stop brighter than what is metered";
  if (arguments.size() != 1 || arguments[0].name.span.valid())
    return error(value_span(given), fmt::format("'{}: auto' wants one number of stops", info.name),
                 std::string(help));
  const syntax::ExprId argument = arguments[0].value;
  const eval::Value value =
      evaluator_.evaluate_as(eval::Type::number, tree, argument, *site_.scope, "the stops of 'auto'");
  if (value.is_error()) {
    ok_ = false;
  } else if (value.unit != syntax::Unit::none) {
    error(tree[argument].span,
          fmt::format("the stops of 'auto' are a number without a unit, found {}", unit_name(value.unit)),
          std::string(help));
  } else {
    to = {value.as_number(), true};
  }
}

void Reader::read_value(const FieldInfo& info, const Given& given, image::Tonemap& to) {
  const std::string_view written = word(given.item->value);
  if (const auto tonemap = image::read_tonemap(written)) {
    to = *tonemap;
    return;
  }
  std::vector<std::string_view> names;
  for (const image::TonemapInfo& row : image::tonemaps) names.push_back(row.name);
  error(value_span(given), fmt::format("'{}' wants one of {}", info.name, fmt::join(names, ", ")),
        did_you_mean(written, names));
}

}  // namespace tyndall::resolve
