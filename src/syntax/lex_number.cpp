// Numbers and their units.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "syntax/foreign_words.h"
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

// Digits read as a whole number, and how many of them follow the point. Up to 15 digits both the number and
// the power of ten are exact doubles, so that their quotient is the double next to what is written (Clinger,
// "How to Read Floating Point Numbers Accurately", PLDI 1990).
struct Decimal {
  static constexpr std::uint32_t max_exact_digits = 15;
  std::uint64_t whole = 0;
  std::uint32_t digits = 0, places = 0;
  bool has_exponent = false;

  void add(char digit) {
    whole = whole * 10 + static_cast<std::uint64_t>(digit - '0');  // wraps where it is not used
    ++digits;
  }
  bool exact() const { return digits <= max_exact_digits && !has_exponent; }
  double value() const {
    static constexpr std::array<double, max_exact_digits + 1> powers_of_ten{
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    return exact() ? static_cast<double>(whole) / powers_of_ten[places] : 0;
  }
};

std::string unit_help(std::string_view digits, std::string_view suffix) {
  const auto is_hex = [](char c) {
    return std::string_view("0123456789abcdefABCDEF").find(c) != std::string_view::npos;
  };
  if (digits == "0" && suffix.size() > 1 && suffix[0] == 'x' &&
      std::all_of(suffix.begin() + 1, suffix.end(), is_hex))
    return suffix.size() == 7 ? fmt::format("a colour is written #{}", suffix.substr(1))
                              : "numbers are decimal";
  if (const std::string_view help = help_for_foreign_word(ForeignUse::unit, suffix); !help.empty())
    return std::string(help);
  const auto only_digits = [](std::string_view text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || c == '_'; });
  };
  if (suffix[0] == 'x' && only_digits(suffix.substr(1)))
    return fmt::format("a pair is written ({0}, {1}), a product {0} * {1}", digits, suffix.substr(1));
  if (suffix[0] == '_' && only_digits(suffix)) {
    std::string joined(digits);
    std::copy_if(suffix.begin(), suffix.end(), std::back_inserter(joined), [](char c) { return c != '_'; });
    return fmt::format("digits stand together: write {}", joined);
  }
  std::vector<std::string_view> names;
  for (const UnitRow& row : unit_table) names.push_back(row.name);
  if (const std::string_view near = nearest(suffix, names); !near.empty() && suffix.size() > 1)
    return fmt::format("did you mean '{}'?", near);
  return fmt::format("the units are {}; a product is written {} * {}", fmt::join(names, " "), digits, suffix);
}

const UnitRow* find_unit(std::string_view name) {
  const auto* row = std::find_if(std::begin(unit_table), std::end(unit_table),
                                 [&](const UnitRow& r) { return r.name == name; });
  return row == std::end(unit_table) ? nullptr : row;
}

}  // namespace

Unit with_unit(std::string_view name, double& value) {
  const UnitRow* row = find_unit(name);
  if (row != nullptr) value = value * row->factor / row->divisor;
  return row != nullptr ? row->unit : Unit::none;
}

void Lexer::number() {
  const std::uint32_t begin = at_;
  Decimal decimal;
  while (is_digit(peek())) decimal.add(text_[at_++]);
  if (peek() == '.' && is_digit(peek(1))) {
    const std::uint32_t fraction = ++at_;
    while (is_digit(peek())) decimal.add(text_[at_++]);
    decimal.places = at_ - fraction;
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
      decimal.has_exponent = true;
    }
  }
  double value = decimal.value();
  std::errc problem{};
  if (!decimal.exact()) problem = std::from_chars(text_.data() + begin, text_.data() + at_, value).ec;
  const std::uint32_t unit_begin = at_;
  if (peek() == '%')
    ++at_;
  else
    while (is_word_part(peek())) ++at_;
  if (problem != std::errc()) return fail(begin, "this number is too large or too small to be represented");

  const std::string_view suffix = text_.substr(unit_begin, at_ - unit_begin);
  Unit unit = Unit::none;
  if (!suffix.empty()) {
    const UnitRow* found = find_unit(suffix);
    if (found == nullptr) {
      const std::string_view shown = suffix.substr(0, 40);
      diagnostics_.error({source_, unit_begin, at_}, fmt::format("'{}' is not a unit", shown),
                         unit_help(text_.substr(begin, unit_begin - begin), suffix));
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
