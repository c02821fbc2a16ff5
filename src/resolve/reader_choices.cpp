// Parameters whose values may be words that stand for a choice, alone or called with arguments: `auto(1%)`.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <type_traits>

#include "base/diagnostics.h"
#include "resolve/reader.h"

namespace tyndall::resolve {

std::string_view Reader::word(syntax::ExprId id) const {
  const auto* name = std::get_if<syntax::NameExpr>(&(*site_.tree)[id].node);
  return name ? symbols_.text(name->symbol) : std::string_view{};
}

// A length, or the choice `auto`: alone, or with its tolerance as if it were called.
void Reader::read_value(const FieldInfo& info, const Given& given, scene::Step& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const auto is_auto = [&](syntax::ExprId id) { return word(id) == "auto"; };
  const syntax::ExprId written = given.item->value;
  if (is_auto(written)) {
    to = scene::Step::automatic_unproven();
    return;
  }
  const auto* call = std::get_if<syntax::CallExpr>(&tree[written].node);
  if (!call || !is_auto(call->callee)) {
    const eval::Value value = evaluate(eval::Type::number, info, given);
    if (!value.is_error()) to = value.as_number();
    return;
  }
  const auto arguments = tree.list_of_arguments(call->arguments);
  constexpr std::string_view help =
      "`auto(1%)`: what may be added to the light of any ray, above 0% and below 100%";
  if (arguments.size() != 1 || arguments[0].name.span.valid())
    return error(value_span(given), fmt::format("'{}: auto' wants one tolerance", info.name),
                 std::string(help));
  const syntax::ExprId argument = arguments[0].value;
  const eval::Value value =
      evaluator_.evaluate_as(eval::Type::number, tree, argument, *site_.scope, "tolerance");
  if (value.is_error()) {
    ok_ = false;
  } else if (value.unit != syntax::Unit::none) {
    error(tree[argument].span,
          fmt::format("the tolerance of 'auto' is a share, found {}", unit_name(value.unit)),
          std::string(help));
  } else if (!(value.as_number() > 0 && value.as_number() < 1)) {
    error(tree[argument].span,
          fmt::format("the tolerance of 'auto' must be above 0% and below 100%, found {}%",
                      value.as_number() * 100));
  } else {
    to = scene::Step::automatic_within(value.as_number());
  }
}

template <class T>
void Reader::read_arguments(const syntax::CallExpr& call, T& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  std::vector<std::string_view> names;
  list_names<T>(names);
  std::vector<Span> places(names.size());
  std::size_t position = 0;
  for (const syntax::Argument& argument : tree.list_of_arguments(call.arguments)) {
    const bool named = argument.name.symbol.valid();
    const Span span = named ? argument.name.span : tree[argument.value].span;
    const auto wanted = named
                            ? std::find(names.begin(), names.end(), symbols_.text(argument.name.symbol))
                            : names.begin() + static_cast<std::ptrdiff_t>(std::min(position++, names.size()));
    if (wanted == names.end()) {
      const std::string listed = fmt::format("it takes {}", fmt::join(names, ", "));
      if (!named) {
        error(span, fmt::format("too many arguments for '{}'", T::keyword), listed);
        continue;
      }
      const std::string guess = did_you_mean(symbols_.text(argument.name.symbol), names);
      error(span, fmt::format("'{}' has no parameter '{}'", T::keyword, symbols_.text(argument.name.symbol)),
            guess.empty() ? listed : guess);
      evaluator_.check_names(tree, argument.value, *site_.scope);
      continue;
    }
    const auto index = static_cast<std::size_t>(wanted - names.begin());
    if (places[index].valid()) {
      error(span, fmt::format("'{}' is given twice", *wanted));
      continue;
    }
    places[index] = tree[argument.value].span;
    const eval::Value value =
        evaluator_.evaluate_as(eval::Type::number, tree, argument.value, *site_.scope, *wanted);
    if (value.is_error()) {
      ok_ = false;
      continue;
    }
    if (value.unit != syntax::Unit::none) {
      error(places[index],
            fmt::format("'{}' wants a number without a unit, found {}", *wanted, unit_name(value.unit)));
      continue;
    }
    std::size_t i = 0;
    T::fields([&](auto member, const FieldInfo& info) {
      if (i++ != index) return;
      using Field = std::remove_reference_t<decltype(to.*member)>;
      if constexpr (std::is_same_v<Field, int>) {
        if (!to_whole(info.name, value.as_number(), places[index], std::numeric_limits<int>::min(),
                      std::numeric_limits<int>::max()))
          return;
      }
      to.*member = static_cast<Field>(value.as_number());
    });
  }
  if (!ok_) return;
  for (const scene::Problem& problem : scene::validate(to)) {
    const auto field = std::find(names.begin(), names.end(), problem.field);
    error(places[static_cast<std::size_t>(field - names.begin())], problem.message, problem.help);
  }
}

void Reader::read_value(const FieldInfo& info, const Given& given, scene::MultipleScattering& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const syntax::ExprId written = given.item->value;
  const auto* call = std::get_if<syntax::CallExpr>(&tree[written].node);
  const std::string_view choice = word(call ? call->callee : written);
  if (choice == scene::ApproximateScattering::keyword) {
    to.approximate.emplace();
    if (call) read_arguments(*call, *to.approximate);
  } else if (choice == scene::MultipleScattering::full && !call) {
    to.approximate.reset();
  } else {
    const std::string guess =
        did_you_mean(choice, {scene::MultipleScattering::full, scene::ApproximateScattering::keyword});
    error(value_span(given), fmt::format("'{}' is `full` or `approximate`", info.name),
          !guess.empty() ? guess
                         : "`approximate(real: 1, orders: 8)` follows one scattering and guesses eight more");
  }
}

}  // namespace tyndall::resolve
