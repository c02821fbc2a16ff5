// The values of parameters: types, units, and messages. See reader.h.
#include "resolve/reading/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>

#include "base/overloaded.h"
#include "resolve/limits.h"

namespace tyndall::resolve {

namespace {

// Whether a number written with `unit` can be a `quantity`; bare numbers fit everything but angles, which
// have a type of their own.
bool fits(Quantity quantity, syntax::Unit unit) {
  if (unit == syntax::Unit::none) return true;
  switch (quantity) {
    case Quantity::plain:
    case Quantity::color:
      return false;
    case Quantity::length:
    case Quantity::position:
    case Quantity::direction:
      return unit == syntax::Unit::length;
    case Quantity::time:
      return unit == syntax::Unit::time;
    case Quantity::angle:
      return unit == syntax::Unit::angle;
  }
  return false;
}

std::string_view wanted(Quantity quantity) {
  switch (quantity) {
    case Quantity::plain:
      return "a number without a unit";
    case Quantity::color:
      return "a number or colour without a unit";
    case Quantity::length:
    case Quantity::position:
    case Quantity::direction:
      return "a length";
    case Quantity::time:
      return "a time";
    case Quantity::angle:
      return "an angle";
  }
  return {};
}

}  // namespace

std::string_view unit_name(syntax::Unit unit) {
  switch (unit) {
    case syntax::Unit::none:
      return "a bare number";
    case syntax::Unit::length:
      return "a length";
    case syntax::Unit::time:
      return "a time";
    case syntax::Unit::temperature:
      return "a temperature";
    case syntax::Unit::angle:
      return "an angle";
  }
  return {};
}

std::string no_parameter(std::string_view name, std::string_view keyword) {
  return fmt::format("no parameter '{}' in '{}'", name, keyword);
}

Reader::Reader(eval::Evaluator& evaluator, const Schemas& schemas, ReaderSite site, syntax::BlockId block,
               std::string_view keyword, Span header, Others others)
    : evaluator_(evaluator),
      schemas_(schemas),
      diagnostics_(*evaluator.context().diagnostics),
      symbols_(*evaluator.context().symbols),
      site_(site),
      keyword_(keyword),
      header_(header) {
  const syntax::SyntaxTree& tree = *site_.tree;
  const auto items = tree.list_of_items(tree[block].items);
  given_.reserve(items.size());
  for (const syntax::ItemId id : items) {
    const syntax::Item& item = tree[id];
    if (const auto* parameter = std::get_if<syntax::ParameterItem>(&item.node)) {
      if (const Given* earlier = find(parameter->name.symbol)) {
        ok_ = false;
        const std::string_view name = symbols_.text(parameter->name.symbol);
        diagnostics_.error(parameter->name.span, fmt::format("'{}' is given twice", name),
                           name == "transform" ? "join them with '*', of which the last applies first" : "",
                           {{earlier->item->name.span, "first given here"}});
      } else {
        given_.push_back({parameter, false});
      }
    } else if (const auto* assign = std::get_if<syntax::AssignItem>(&item.node)) {
      if (others == Others::allowed) continue;
      error(assign->name.span, fmt::format("a parameter of '{}' is given with ':', not '='", keyword_),
            fmt::format("write `{}: …`", symbols_.text(assign->name.symbol)));
      meant_.push_back(assign->name.symbol);
    } else if (others == Others::allowed) {
      continue;
    } else {
      ok_ = false;
      others_.push_back(&item);
    }
  }
}

void Reader::error(Span span, std::string message, std::string help) {
  ok_ = false;
  diagnostics_.error(span, std::move(message), std::move(help));
}

Span Reader::place(std::string_view field) const {
  for (const Given& given : given_)
    if (symbols_.text(given.item->name.symbol) == field) return value_span(given);
  return header_;
}

void Reader::report(const scene::Problems& problems) {
  for (const scene::Problem& problem : problems) error(place(problem.field), problem.message, problem.help);
}

void Reader::report_missing(const Missing& missing) {
  if (missing.names.size() == 1)
    return error(header_, fmt::format("'{}' needs '{}'", keyword_, missing.names[0]),
                 fmt::format("add `{}: …`: {}", missing.names[0], missing.documentation));
  error(header_, fmt::format("{}: give exactly one for '{}'", fmt::join(missing.names, " and "), keyword_));
}

void Reader::report_one_of(const std::vector<std::string_view>& names) {
  const std::string list = fmt::format("{}", fmt::join(names, " and "));
  Span first, last;
  for (const std::string_view name : names) {
    const Given* given = find(symbols_.intern(name));
    if (!given) continue;
    if (!first.valid()) first = given->item->name.span;
    last = given->item->name.span;
  }
  ok_ = false;
  diagnostics_.error(last, fmt::format("{}: give exactly one for '{}'", list, keyword_), {},
                     {{first, "the other is given here"}});
}

void Reader::report_unknown(const Given& given, std::string_view hint, Reader* outer) {
  // Many more of them would be looked for in vain.
  if (diagnostics_.full())
    return error(given.item->name.span, no_parameter(symbols_.text(given.item->name.symbol), keyword_));
  // Those that are missing first, then those not given yet.
  std::vector<std::string_view> candidates;
  const std::vector<std::string_view> known = known_names();
  for (const Missing& missing : missing_)
    candidates.insert(candidates.end(), missing.names.begin(), missing.names.end());
  const auto is_given = [&](std::string_view name) { return find(symbols_.intern(name)) != nullptr; };
  std::copy_if(known.begin(), known.end(), std::back_inserter(candidates), std::not_fn(is_given));
  std::copy_if(known.begin(), known.end(), std::back_inserter(candidates), is_given);
  const std::string_view name = symbols_.text(given.item->name.symbol);
  std::string help = help_for_output(name);
  if (!help.empty() && std::exchange(outputs_told_, true)) return void(ok_ = false);
  if (help.empty()) help = help_elsewhere(name, outer);
  const std::string_view meant = help.empty() ? nearest(name, candidates) : std::string_view{};
  std::erase_if(missing_, [&](const Missing& missing) {
    return std::find(missing.names.begin(), missing.names.end(), meant) != missing.names.end();
  });
  if (!meant.empty()) help = fmt::format("did you mean '{}'?", meant);
  if (help.empty()) help = help_of_others(name);
  if (help.empty()) help = hint;
  if (help.empty() && !known.empty()) help = fmt::format("it has: {}", fmt::join(known, ", "));
  error(given.item->name.span, no_parameter(name, keyword_), std::move(help));
  check_names_of_unknown(given.item->value);
}

void Reader::settle(std::string_view name) {
  std::erase_if(missing_, [&](const Missing& missing) {
    return missing.names.size() == 1 && missing.names[0] == name;
  });
}

void Reader::finish(std::string_view hint, Reader* outer) {
  for (const syntax::Item* item : others_) report_other(*item);
  for (const Given& given : given_)
    if (!given.taken) report_unknown(given, hint, outer);
  std::erase_if(missing_, [&](const Missing& missing) {
    return std::any_of(meant_.begin(), meant_.end(), [&](syntax::SymbolId name) {
      return std::find(missing.names.begin(), missing.names.end(), symbols_.text(name)) !=
             missing.names.end();
    });
  });
  for (const Missing& missing : missing_) report_missing(missing);
  if (ok()) report(problems_);
}

void Reader::error_unit(const FieldInfo& info, const eval::Value& value, Span span) {
  error(span,
        fmt::format("'{}' wants {}, found {}", info.name, wanted(info.quantity), unit_name(value.unit)));
}

eval::Value Reader::evaluate(eval::Type type, const FieldInfo& info, const Given& given) {
  eval::Value value = evaluator_.evaluate_as(type, *site_.tree, given.item->value, *site_.scope, info.name);
  if (value.is_error()) {
    ok_ = false;
  } else if (!fits(info.quantity, value.unit)) {
    error_unit(info, value, value_span(given));
    return {};
  }
  return value;
}

void Reader::read_value(const FieldInfo& info, const Given& given, double& to) {
  const eval::Value value = evaluate(eval::Type::number, info, given);
  if (!value.is_error()) to = value.as_number();
}

// Reports a number that is not whole or not in [least, greatest].
bool Reader::to_whole(std::string_view name, double number, Span span, double least, double greatest) {
  if (number != std::floor(number)) {
    error(span, fmt::format("'{}' must be a whole number, found {}", name, number));
    return false;
  }
  if (number < least || number > greatest) {
    error(span, fmt::format("'{}' must be from {} to {}, found {}", name, least, greatest, number));
    return false;
  }
  return true;
}

void Reader::read_value(const FieldInfo& info, const Given& given, int& to) {
  const eval::Value value = evaluate(eval::Type::number, info, given);
  if (value.is_error()) return;
  const double number = value.as_number();
  if (to_whole(info.name, number, value_span(given), std::numeric_limits<int>::min(),
               std::numeric_limits<int>::max()))
    to = static_cast<int>(number);
}

void Reader::read_value(const FieldInfo& info, const Given& given, std::uint64_t& to) {
  const eval::Value value = evaluate(eval::Type::number, info, given);
  if (value.is_error()) return;
  const double number = value.as_number();
  constexpr double exact_whole_numbers = 9007199254740992.0;  // 2^53: all of them are doubles below it
  if (to_whole(info.name, number, value_span(given), 0, exact_whole_numbers))
    to = static_cast<std::uint64_t>(number);
}

void Reader::read_value(const FieldInfo& info, const Given& given, bool& to) {
  const eval::Value value = evaluate(eval::Type::boolean, info, given);
  if (!value.is_error()) to = value.as_bool();
}

void Reader::read_value(const FieldInfo& info, const Given& given, Angle& to) {
  const eval::Value value = evaluate(eval::Type::angle, info, given);
  if (!value.is_error()) to.radians = value.scalars[0].value;
}

void Reader::read_value(const FieldInfo& info, const Given& given, Vec3d& to) {
  const eval::Value value = evaluate(eval::Type::vec, info, given);
  if (!value.is_error()) to = value.as_vec();
}

// The number or colour that a value is.
void Reader::to_color(const FieldInfo& info, const eval::Value& value, Span span,
                      std::string_view wanted_type, Rgb& to) {
  if (value.is_error()) {
    ok_ = false;
  } else if (value.type != eval::Type::number && value.type != eval::Type::vec) {
    error(span, fmt::format("'{}' wants {}, found {}", info.name, wanted_type, eval::describe(value.type)),
          eval::help_for_color(value));
  } else if (!fits(info.quantity, value.unit)) {
    error_unit(info, value, span);
  } else {
    to = value.type == eval::Type::number ? Rgb(static_cast<float>(value.as_number())) : Rgb(value.as_vec());
  }
}

void Reader::read_value(const FieldInfo& info, const Given& given, Rgb& to) {
  to_color(info, evaluator_.evaluate(*site_.tree, given.item->value, *site_.scope), value_span(given),
           "a number or a colour", to);
}

void Reader::read_value(const FieldInfo& info, const Given& given, scene::Resolution& to) {
  const eval::Value value = evaluate(eval::Type::pair, info, given);
  if (value.is_error()) return;
  const double x = value.scalars[0].value, y = value.scalars[1].value;
  constexpr double least = std::numeric_limits<int>::min(), greatest = std::numeric_limits<int>::max();
  const Span span = value_span(given);
  if (to_whole(info.name, x, span, least, greatest) && to_whole(info.name, y, span, least, greatest))
    to = {static_cast<int>(x), static_cast<int>(y)};
}

void Reader::read_value(const FieldInfo& info, const Given& given, Transform& to) {
  const eval::Value value = evaluate(eval::Type::transform, info, given);
  if (value.is_error()) return;
  to = value.as_transform();
  if (!to.inverse())
    error(value_span(given), fmt::format("'{}' flattens space: it cannot be undone", info.name),
          "scale by numbers other than 0");
}

void Reader::read_value(const FieldInfo& info, const Given& given, eval::RangeValue& to) {
  const eval::Value value = evaluate(eval::Type::range, info, given);
  if (!value.is_error()) to = std::get<eval::RangeValue>(*value.heavy);
}

eval::Value Reader::element(eval::Type type, const FieldInfo& info, const Given& given,
                            const eval::Value& value) {
  return converted(type, info, given, value, fmt::format("an element of '{}'", info.name));
}

eval::Value Reader::converted(eval::Type type, const FieldInfo& info, const Given& given,
                              const eval::Value& value, std::string_view what) {
  eval::Value out = evaluator_.convert(type, value, value_span(given), what, false);
  if (out.is_error()) {
    ok_ = false;
  } else if (!fits(info.quantity, value.unit)) {
    error_unit(info, value, value_span(given));
    out = {};
  }
  return out;
}

std::vector<eval::Value> Reader::read_list(eval::Type type, const FieldInfo& info, const Given& given) {
  const eval::Value list = evaluate(eval::Type::list, info, given);
  std::vector<eval::Value> elements;
  if (list.is_error()) return elements;
  for (const eval::Value& value : list.as_list()) {
    elements.push_back(element(type, info, given, value));
    if (elements.back().is_error()) return {};
  }
  return elements;
}

void Reader::read_value(const FieldInfo& info, const Given& given, StrandPoints& to) {
  const eval::Value list = evaluate(eval::Type::list, info, given);
  if (list.is_error()) return;
  const bool many = !list.as_list().empty() && list.as_list().front().type == eval::Type::list;
  if (!many) to.strands.emplace_back();
  std::size_t points = 0;
  for (const eval::Value& value : list.as_list()) {
    if (!many) {
      const eval::Value point = element(eval::Type::vec, info, given, value);
      if (point.is_error()) return;
      to.strands.back().push_back(point.as_vec());
      continue;
    }
    const eval::Value strand = element(eval::Type::list, info, given, value);
    if (strand.is_error()) return;
    points += strand.as_list().size();
    if (points > max_curve_points)
      return error(value_span(given), fmt::format("more than {} points of curves", max_curve_points),
                   "give them to several `curves`");
    to.strands.emplace_back();
    for (const eval::Value& inner : strand.as_list()) {
      const eval::Value point = element(eval::Type::vec, info, given, inner);
      if (point.is_error()) return;
      to.strands.back().push_back(point.as_vec());
    }
  }
}

void Reader::read_value(const FieldInfo& info, const Given& given, generate::Radii& to) {
  const eval::Value written = evaluator_.evaluate(*site_.tree, given.item->value, *site_.scope);
  ok_ = ok_ && !written.is_error();
  if (written.is_error()) return;
  if (written.type != eval::Type::list) {
    const eval::Value number = converted(eval::Type::number, info, given, written, info.name);
    if (!number.is_error()) to.values.push_back(number.as_number());
    return;
  }
  for (const eval::Value& value : written.as_list()) {
    const eval::Value number = element(eval::Type::number, info, given, value);
    if (number.is_error()) return;
    to.values.push_back(number.as_number());
  }
}

void Reader::read_value(const FieldInfo& info, const Given& given, std::vector<Vec3d>& to) {
  for (const eval::Value& element : read_list(eval::Type::vec, info, given)) to.push_back(element.as_vec());
}

void Reader::read_value(const FieldInfo& info, const Given& given, std::vector<Pair<double>>& to) {
  for (const eval::Value& element : read_list(eval::Type::pair, info, given))
    to.push_back({element.scalars[0].value, element.scalars[1].value});
}

void Reader::read_value(const FieldInfo& info, const Given& given, Thing& to) {
  to.span = value_span(given);
  to.value = evaluate(to.wanted, info, given);
}

}  // namespace tyndall::resolve
