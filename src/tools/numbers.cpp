#include "tools/numbers.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/check.h"

namespace tyndall::tools {
namespace {

template <class Row, std::size_t count>
const Row& row_of(const Row (&table)[count], std::string_view name) {
  const auto* row =
      std::find_if(std::begin(table), std::end(table), [&](const Row& r) { return r.name == name; });
  CHECK(row != std::end(table));
  return *row;
}

bool stands_for_a_number(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

}  // namespace

const WholeOption& whole_option(std::string_view name) { return row_of(whole_options, name); }
const RealOption& real_option(std::string_view name) { return row_of(real_options, name); }

std::string wanted(const WholeOption& option) {
  const bool one = std::all_of(option.form.begin(), option.form.end(), stands_for_a_number);
  return fmt::format("{}a whole number from {} to {}", one ? "" : fmt::format("{}, each ", option.form),
                     option.least, option.most);
}

std::string wanted(const RealOption& option) {
  if (option.name == "--step") return "a length in metres above 0, auto, or a tolerance: auto(1%)";
  if (option.name == "--slice") return "a coordinate of p in metres, for instance z=0";
  return option.takes_zero ? "a number from 0" : "a number above 0";
}

std::optional<std::vector<std::string_view>> split_as(std::string_view form, std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    form.remove_prefix(std::min<std::size_t>(
        static_cast<std::size_t>(std::find_if_not(form.begin(), form.end(), stands_for_a_number) -
                                 form.begin()),
        form.size()));
    if (form.empty()) {
      parts.push_back(text);
      return parts;
    }
    const auto between_size =
        static_cast<std::size_t>(std::find_if(form.begin(), form.end(), stands_for_a_number) - form.begin());
    const std::size_t at = text.find(form.substr(0, between_size));
    if (at == std::string_view::npos) return std::nullopt;
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + between_size);
    form.remove_prefix(between_size);
  }
}

void refuse(std::string_view option, std::string_view wanted, std::string_view text) {
  throw CLI::ValidationError(std::string(option), fmt::format("wants {}, not '{}'", wanted, text));
}

CLI::Option* add_text_option(CLI::App& command, std::string_view name, std::string_view form,
                             const std::string& help, std::function<void(const std::string&)> read) {
  return command.add_option_function<std::string>(std::string(name), std::move(read), help)
      ->option_text(std::string(form));
}

CLI::Option* add_whole_text_option(CLI::App& command, std::string_view name, const std::string& help,
                                   std::function<void(const std::string&, const WholeOption&)> read) {
  const WholeOption& option = whole_option(name);
  return add_text_option(command, name, option.form,
                         fmt::format("{} ({} to {})", help, option.least, option.most),
                         [&option, read = std::move(read)](const std::string& text) { read(text, option); });
}

CLI::Option* add_real(CLI::App& command, std::string_view name, std::optional<double>& target,
                      const std::string& help) {
  const RealOption& option = real_option(name);
  return add_text_option(command, name, option.form, help, [&option, &target](const std::string& text) {
    const auto number = read_decimal<double>(text);
    if (!number || *number < 0 || (*number == 0 && !option.takes_zero))
      refuse(option.name, wanted(option), text);
    target = *number;
  });
}

}  // namespace tyndall::tools
