// Numbers on the command line: one table of what each option takes, from which the reader, the help, the
// manual and the tests derive, and one reader for all of them.
//
// Whole numbers are decimal digits, with a minus where the range has any; zeros in front mean nothing, as in
// file names. Other numbers are decimal too, with an exponent where one is wanted.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tyndall::tools {

// Options that take whole numbers. `form` shows each as letters and digits in capitals, with what stands
// between them: "WxH".
struct WholeOption {
  std::string_view name, form;
  std::int64_t least;
  std::uint64_t most;  // included
};

// All of them, those of the scene's `render {}` first.
std::span<const WholeOption> whole_options();

// Options that take a number of any kind that is finite, or several in a form of their own.
struct RealOption {
  std::string_view name, form;
  std::string_view wanted;  // what it takes, for people
  bool takes_zero;
};
std::span<const RealOption> real_options();

// What an option takes, for people: "a whole number from 1 to 4096", "WxH, each a whole number from …".
std::string wanted(const WholeOption& option);
// The table's row of this name; there is one.
const WholeOption& whole_option(std::string_view name);
const RealOption& real_option(std::string_view name);

// The whole text as a decimal number; nothing for anything else, infinite or beyond T.
template <class T>
std::optional<T> read_decimal(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>)
    if (!(value - value == T{})) return std::nullopt;
  return value;
}

// "512MB", "1.5GB": bytes; nothing for anything else, or what is not between 16MB and 1TB.
std::optional<std::uint64_t> read_bytes(std::string_view text);

// The text cut at what stands between an option's numbers; nothing when it has another form.
std::optional<std::vector<std::string_view>> split_as(std::string_view form, std::string_view text);

// Complains that the option wants something else: misuse of the command line.
[[noreturn]] void refuse(std::string_view option, std::string_view wanted, std::string_view text);

// Complains that the option wants one of the names, with the one that is nearest.
[[noreturn]] void refuse_name(std::string_view option, const std::vector<std::string_view>& names,
                              std::string_view text);
// That complaint without the option's name; empty where the text is one of the names: what check() wants.
std::string name_problem(const std::vector<std::string_view>& names, std::string_view text);
// What an option of any name takes: its table's row, or "a value".
std::string wanted_by(std::string_view option);

// The option's `count` numbers, all within its range, or a complaint.
template <class Int, std::size_t count>
std::array<Int, count> read_wholes(const WholeOption& option, const std::string& text) {
  std::array<Int, count> numbers{};
  const auto parts = split_as(option.form, text);
  if (!parts || parts->size() != count) refuse(option.name, wanted(option), text);
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = read_decimal<Int>((*parts)[i]);
    if (!number || std::cmp_less(*number, option.least) || std::cmp_greater(*number, option.most))
      refuse(option.name, wanted(option), text);
    numbers[i] = *number;
  }
  return numbers;
}

// Adds an option that is read from its text when all of the command line is; the help states `form` and,
// with a table's row, the range.
CLI::Option* add_text_option(CLI::App& command, std::string_view name, std::string_view form,
                             const std::string& help, std::function<void(const std::string&)> read);
CLI::Option* add_whole_text_option(CLI::App& command, std::string_view name, const std::string& help,
                                   std::function<void(const std::string&, const WholeOption&)> read);

// Adds a row of whole_options() that goes into `target`: a number, or an optional one.
template <class Target>
CLI::Option* add_whole(CLI::App& command, std::string_view name, Target& target, const std::string& help) {
  return add_whole_text_option(command, name, help,
                               [&target](const std::string& text, const WholeOption& option) {
                                 if constexpr (requires { typename Target::value_type; })
                                   target = read_wholes<typename Target::value_type, 1>(option, text)[0];
                                 else
                                   target = read_wholes<Target, 1>(option, text)[0];
                               });
}
// Adds a row of real_options().
CLI::Option* add_real(CLI::App& command, std::string_view name, std::optional<double>& target,
                      const std::string& help);

}  // namespace tyndall::tools
