// Numbers and their units.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "syntax/lexer.h"

namespace tyndall::syntax {

namespace {

// `value` of the unit is `value * factor / divisor` in base units; the division keeps 5cm at the double next
// to 0.05.
struct UnitRow {
  std::string_view name;
  Unit unit;
  double factor, divisor;
};
constexpr UnitRow unit_table[] = {
    {"deg", Unit::angle, std::numbers::pi, 180},
    {"rad", Unit::angle, 1, 1},
    {"mm", Unit::length, 1, 1000},
    {"cm", Unit::length, 1, 100},
    {"km", Unit::length, 1000, 1},
    {"ms", Unit::time, 1, 1000},
    {"m", Unit::length, 1, 1},
    {"s", Unit::time, 1, 1},
    {"K", Unit::temperature, 1, 1},
    {"%", Unit::none, 1, 100},
};

std::string unit_help(std::string_view suffix) {
  std::vector<std::string_view> names;
  for (const UnitRow& row : unit_table) names.push_back(row.name);
  if (const std::string_view near = nearest(suffix, names); !near.empty() && suffix.size() > 1)
    return fmt::format("did you mean '{}'?", near);
  return fmt::format("the units are {}; a product is written with '*'", fmt::join(names, " "));
}

}  // namespace

void Lexer::number() {
  const std::uint32_t begin = at_;
  while (is_digit(peek())) ++at_;
  if (peek() == '.' && is_digit(peek(1))) {
    ++at_;
    while (is_digit(peek())) ++at_;
  } else if (peek() == '.' && peek(1) != '.' && !is_word_begin(peek(1))) {
    ++at_;
    const std::string_view digits = text_.substr(begin, at_ - begin - 1);
    return fail(begin, "a dot belongs to a number only before a digit",
                digits.size() < 40 ? fmt::format("write {0} or {0}.0", digits) : "");
  }
  if (peek() == 'e' || peek() == 'E') {
    const std::uint32_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
    if (is_digit(peek(1 + sign))) {
      at_ += 1 + sign;
      while (is_digit(peek())) ++at_;
    }
  }
  double value = 0;
  const auto [end, problem] = std::from_chars(text_.data() + begin, text_.data() + at_, value);
  const std::uint32_t unit_begin = at_;
  if (peek() == '%')
    ++at_;
  else
    while (is_word_part(peek())) ++at_;
  if (problem != std::errc()) return fail(begin, "this number is too large or too small to be represented");

  const std::string_view suffix = text_.substr(unit_begin, at_ - unit_begin);
  Unit unit = Unit::none;
  if (!suffix.empty()) {
    const UnitRow* found = nullptr;
    for (const UnitRow& row : unit_table)
      if (row.name == suffix) found = &row;
    if (found == nullptr) {
      const std::string_view shown = suffix.substr(0, 40);
      diagnostics_.error({source_, unit_begin, at_}, fmt::format("'{}' is not a unit", shown),
                         unit_help(suffix));
      emit(TokenKind::error, begin);
      return;
    }
    unit = found->unit;
    value = value * found->factor / found->divisor;
    if (!std::isfinite(value)) return fail(begin, "this number is too large or too small to be represented");
  }
  Token& token = emit(TokenKind::number, begin);
  token.number = value;
  token.unit = unit;
}

}  // namespace tyndall::syntax
