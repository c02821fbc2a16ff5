// Parameters whose values may be words that stand for a choice, alone or called with arguments: `auto(1%)`.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <type_traits>

#include "base/diagnostics.h"
#include "resolve/reading/reader.h"
#include "vm/program/builtins.h"

namespace tyndall::resolve {

std::string_view Reader::word(syntax::ExprId id) const {
  const auto* name = std::get_if<syntax::NameExpr>(&(*site_.tree)[id].node);
  return name ? symbols_.text(name->symbol) : std::string_view{};
}

bool Reader::is_misspelt(syntax::ExprId written, const std::vector<std::string_view>& choices) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const auto* call = std::get_if<syntax::CallExpr>(&tree[written].node);
  const syntax::ExprId at = call ? call->callee : written;
  const auto* name = std::get_if<syntax::NameExpr>(&tree[at].node);
  if (!name || (*site_.scope)->find(name->symbol) || vm::find_builtin(word(at))) return false;
  const std::string guess = did_you_mean(word(at), choices);
  if (guess.empty()) return false;
  error(tree[at].span, fmt::format("nothing is named '{}' here", word(at)), guess);
  return true;
}

// A length, or a choice: `auto`, or one with its tolerance as if it were called.
void Reader::read_value(const FieldInfo& info, const Given& given, scene::Step& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const syntax::ExprId written = given.item->value;
  const auto* call = std::get_if<syntax::CallExpr>(&tree[written].node);
  const std::string_view choice = word(call ? call->callee : written);
  if (choice == "auto" && !call) {
    to = {};
    return;
  }
  if (choice != "auto" && choice != "adaptive") {
    if (is_misspelt(written, {"auto", "adaptive"})) return;
    const eval::Value value = evaluate(eval::Type::number, info, given);
    if (!value.is_error()) to = value.as_number();
    return;
  }
  const bool proven = choice == "auto";
  const std::string_view help =
      proven ? "`auto(1%)`: what may be added to the light of any ray, above 0% and below 100%"
             : "`adaptive(0.5%)`: what steps may change of the picture, above 0% and below 100%";
  const auto arguments =
      call ? tree.list_of_arguments(call->arguments) : decltype(tree.list_of_arguments({})){};
  if (arguments.size() != 1 || arguments[0].name.span.valid())
    return error(value_span(given), fmt::format("'{}: {}' wants one tolerance", info.name, choice),
                 std::string(help));
  const syntax::ExprId argument = arguments[0].value;
  const eval::Value value =
      evaluator_.evaluate_as(eval::Type::number, tree, argument, *site_.scope, "tolerance");
  if (value.is_error()) {
    ok_ = false;
  } else if (value.unit != syntax::Unit::none) {
    error(tree[argument].span,
          fmt::format("the tolerance of '{}' is a share, found {}", choice, unit_name(value.unit)),
          std::string(help));
  } else if (!(value.as_number() > 0 && value.as_number() < 1)) {
    error(tree[argument].span, fmt::format("the tolerance of '{}' must be above 0% and below 100%, found {}%",
                                           choice, value.as_number() * 100));
  } else {
    to = proven ? scene::Step::proven_within(value.as_number())
                : scene::Step::estimated_within(value.as_number());
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
  if (!ok()) return;
  for (const scene::Problem& problem : scene::validate(to)) {
    const auto field = std::find(names.begin(), names.end(), problem.field);
    error(places[static_cast<std::size_t>(field - names.begin())], problem.message, problem.help);
  }
}

template <class T>
void Reader::read_choice(const FieldInfo& info, const Given& given, std::string_view without,
                         std::string_view example, std::optional<T>& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const syntax::ExprId written = given.item->value;
  const auto* call = std::get_if<syntax::CallExpr>(&tree[written].node);
  const std::string_view choice = word(call ? call->callee : written);
  if (choice == T::keyword) {
    to.emplace();
    if (call) read_arguments(*call, *to);
  } else if (choice == without && !call) {
    to.reset();
  } else {
    const std::string guess = did_you_mean(choice, {without, T::keyword});
    error(value_span(given), fmt::format("'{}' is `{}` or `{}`", info.name, without, T::keyword),
          guess.empty() ? std::string(example) : guess);
  }
}

void Reader::read_value(const FieldInfo& info, const Given& given, scene::MultipleScattering& to) {
  read_choice(info, given, scene::MultipleScattering::full,
              "`approximate(real: 1, orders: 8)` follows one scattering and guesses eight more",
              to.approximate);
}

void Reader::read_value(const FieldInfo& info, const Given& given, scene::ShutterCurve& to) {
  read_choice(info, given, scene::ShutterCurve::box,
              "`trapezoid(opening: 20%, closing: 30%)` opens for a fifth of the shutter's time",
              to.trapezoid);
}

// A number, or the word for none.
void Reader::read_limit(const FieldInfo& info, syntax::ExprId written, double& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  if (word(written) == scene::Clamp::off) {
    to = infinity;
    return;
  }
  if (is_misspelt(written, {scene::Clamp::off})) return;
  const eval::Value value =
      evaluator_.evaluate_as(eval::Type::number, tree, written, *site_.scope, info.name);
  if (value.is_error()) {
    ok_ = false;
  } else if (value.unit != syntax::Unit::none) {
    error(tree[written].span,
          fmt::format("'{}' wants a number without a unit, found {}", info.name, unit_name(value.unit)));
  } else {
    to = value.as_number();
  }
}

// One limit for both, or a pair of them.
void Reader::read_value(const FieldInfo& info, const Given& given, scene::Clamp& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const auto* pair = std::get_if<syntax::TupleExpr>(&tree[given.item->value].node);
  if (!pair) {
    read_limit(info, given.item->value, to.direct);
    to.indirect = to.direct;
    return;
  }
  const auto limits = tree.list_of_exprs(pair->elements);
  if (limits.size() != 2)
    return error(value_span(given),
                 fmt::format("'{}' has a limit for direct light and one for indirect light", info.name),
                 "write `clamp: 4`, or `clamp: (off, 4)`");
  read_limit(info, limits[0], to.direct);
  read_limit(info, limits[1], to.indirect);
}

void Reader::read_end(const FieldInfo& info, const Given& given, syntax::ExprId written, ShutterTime& to) {
  const eval::Value value = evaluator_.evaluate(*site_.tree, written, *site_.scope);
  if (value.is_error()) {
    ok_ = false;
  } else if (value.type == eval::Type::number && value.unit == syntax::Unit::time) {
    to = {value.as_number(), true};
  } else {
    const eval::Value angle = converted(eval::Type::angle, info, given, value, info.name);
    if (!angle.is_error()) to = {angle.scalars[0].value, false};
  }
}

// How long, or a pair of when it opens and when it closes.
void Reader::read_value(const FieldInfo& info, const Given& given, ShutterTimes& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const auto* pair = std::get_if<syntax::TupleExpr>(&tree[given.item->value].node);
  if (!pair) return read_end(info, given, given.item->value, to.closes);
  const auto ends = tree.list_of_exprs(pair->elements);
  if (ends.size() != 2)
    return error(value_span(given),
                 fmt::format("'{}' has a time when it opens and one when it closes", info.name),
                 "write `shutter: 180deg`, or `shutter: (-90deg, 90deg)`");
  read_end(info, given, ends[0], to.opens);
  read_end(info, given, ends[1], to.closes);
}

void Reader::read_value(const FieldInfo& info, const Given& given, std::string& to) {
  const eval::Value value = evaluate(eval::Type::string, info, given);
  if (!value.is_error()) to = value.as_string();
}

// A list of lists of two. Where it is written out its parts are evaluated as what they are to be, so that an
// unnamed `{ … }` is a material.
void Reader::read_value(const FieldInfo& info, const Given& given, MaterialOverrides& to) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const auto* written = std::get_if<syntax::ListExpr>(&tree[given.item->value].node);
  if (!written)
    return error(value_span(given), fmt::format("'{}' wants a list that is written here", info.name),
                 "write [[\"name in the file\", material], …]");
  for (const syntax::ExprId id : tree.list_of_exprs(written->elements)) {
    const auto* pair = std::get_if<syntax::ListExpr>(&tree[id].node);
    if (!pair || pair->elements.count != 2)
      return error(tree[id].span, fmt::format("an element of '{}' has two parts", info.name),
                   "write [\"name in the file\", material]");
    const auto parts = tree.list_of_exprs(pair->elements);
    const eval::Value name =
        evaluator_.evaluate_as(eval::Type::string, tree, parts[0], *site_.scope, "the name of a material");
    const eval::Value material =
        evaluator_.evaluate_as(eval::Type::material, tree, parts[1], *site_.scope, "what stands for it");
    if (name.is_error() || material.is_error()) {
      ok_ = false;
      return;
    }
    to.entries.push_back({name.as_string(), {eval::Type::material, material, tree[parts[1]].span}});
  }
}

}  // namespace tyndall::resolve
