#include "tools/misuse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "tools/numbers.h"

namespace tyndall::tools {
namespace {

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

// "--samples", "-o": every spelling of every option of a command.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string likely_meant(std::string_view word, const std::vector<std::string>& known) {
  const std::string help = did_you_mean(word, {known.begin(), known.end()});
  return help.empty() ? help : ": " + help;
}

std::string unknown_command(const CLI::App& program, const std::string& word) {
  const std::vector<std::string> names = command_names(program);
  return fmt::format("there is no command '{}'{}\nthe commands are: {}", word, likely_meant(word, names),
                     fmt::join(names, ", "));
}

std::string unknown_option(const CLI::App& program, const CLI::App& command, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  const std::string where = &command == &program ? "before a command there is no option"
                                                 : fmt::format("{} has no option", command.get_name());
  const std::string message = fmt::format("{} '{}'", where, name);
  std::vector<std::string> owners;
  for (const CLI::App* other : program.get_subcommands([](const CLI::App*) { return true; })) {
    const std::vector<std::string> names = option_names(*other);
    if (std::find(names.begin(), names.end(), name) != names.end()) owners.push_back(other->get_name());
  }
  if (!owners.empty()) return fmt::format("{}: it belongs to {}", message, fmt::join(owners, ", "));
  return message + likely_meant(name, option_names(command));
}

std::string help_line(const CLI::App& program, const CLI::App& command) {
  return fmt::format("\ntyndall {}--help tells more", &command == &program ? "" : command.get_name() + " ");
}

// What is written for people on an option's value, "FILE.json"; the option is named as the parser names it.
std::string value_missing(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  const std::string form = option == nullptr ? std::string{} : option->get_option_text();
  return fmt::format("{} wants a value{}", name, form.empty() ? form : fmt::format(": {} {}", name, form));
}

}  // namespace

void refuse_empty_values(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    for (CLI::Option* option : command->get_options()) {
      if (option->get_items_expected_max() == 0) continue;
      // Else the parser would take the brackets of '[a]' off.
      if (!option->get_positional()) option->allow_extra_args(false);
      option->check([name = option->get_name()](const std::string& value) {
        return value.empty() ? fmt::format("wants {}, not ''", wanted_by(name)) : std::string{};
      });
    }
}

std::vector<std::string> words_of(const CLI::App& program, std::span<char* const> arguments) {
  std::vector<std::string> words;
  const CLI::App* command = nullptr;
  bool is_value = false;
  for (std::string word : arguments) {
    const bool in_brackets = word.size() > 1 && word.front() == '[' && word.back() == ']';
    if (command == nullptr) {
      for (const CLI::App* one : program.get_subcommands([](const CLI::App*) { return true; }))
        if (one->get_name() == word) command = one;
    } else if (!is_value) {
      const CLI::Option* option = word.starts_with('-') ? command->get_option_no_throw(word) : nullptr;
      is_value = option != nullptr && option->get_items_expected_max() > 0;
      if (in_brackets) word.insert(0, "./");
    } else {
      is_value = false;
    }
    words.push_back(std::move(word));
  }
  return words;
}

std::string misjoined_value(std::span<char* const> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument == "--") break;
    if (argument.size() > 3 && argument.starts_with("--") && argument.find('=') == argument.size() - 1)
      return fmt::format("{} wants a value, found nothing after its '='",
                         argument.substr(0, argument.size() - 1));
    if (argument.size() > 2 && argument[0] == '-' && argument[1] != '-' && argument[2] == '=')
      return fmt::format("a short option takes its value without '=': {} {}", argument.substr(0, 2),
                         argument.size() > 3 ? argument.substr(3) : "…");
  }
  return {};
}

std::string explain_misuse(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App& command = chosen.empty() || !program.remaining().empty() ? program : *chosen.front();
  const std::vector<std::string> unread = command.remaining();
  const auto option = std::find_if(unread.begin(), unread.end(),
                                   [](const std::string& word) { return word.starts_with('-'); });
  if (&command == &program) {
    if (!unread.empty() && option != unread.begin()) return unknown_command(program, unread.front());
    if (unread.empty())
      return fmt::format("this wants a command: {}{}", fmt::join(command_names(program), ", "),
                         help_line(program, command));
  }
  if (option != unread.end()) return unknown_option(program, command, *option) + help_line(program, command);
  if (!unread.empty())
    return fmt::format("{} does not know what to do with '{}'{}", command.get_name(), unread.front(),
                       help_line(program, command));
  if (error.get_name() == "ArgumentMismatch") {
    const std::string_view what = error.what();
    return value_missing(command, std::string(what.substr(0, what.find(':')))) + help_line(program, command);
  }
  return error.what() + help_line(program, command);
}

}  // namespace tyndall::tools
