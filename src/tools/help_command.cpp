// `tyndall help NAME`: what the language knows by that name.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "base/diagnostics.h"
#include "tools/commands.h"
#include "tools/reference.h"
#include "tools/report.h"

namespace tyndall::tools {

namespace {

struct HelpArguments {
  std::vector<std::string> words;
};

std::string padded(std::string_view text, std::size_t width) {
  return std::string(text) + std::string(width - std::min(width, text.size()), ' ');
}

std::string entry(const ReferenceStatement& statement) {
  std::string out = statement.name + " { … }\n";
  if (!statement.documentation.empty()) out += "  " + statement.documentation + "\n";
  std::size_t width = 0;
  for (const ReferenceParameter& p : statement.parameters) width = std::max(width, p.name.size());
  for (const ReferenceParameter& p : statement.parameters) {
    out += fmt::format("  {}:  {}", padded(p.name, width), p.documentation);
    if (p.required)
      out += " (required)";
    else if (p.one_of_several)
      out += " (one of those that say so is required)";
    else if (!p.standard.empty())
      out += fmt::format(" (default: {})", p.standard);
    out += '\n';
  }
  return out;
}

std::string entry(const ReferenceFunction& function) {
  const std::string picture = picture_of(function);
  return fmt::format("{}\n  gives: {}\n  {}\n  For example: {}\n{}", function.call, function.result,
                     function.documentation, function.example,
                     picture.empty() ? "" : fmt::format("  It looks like this: {}\n", picture));
}

std::string entry(const ReferenceOutput& output, std::string_view body) {
  return fmt::format("{} = …, an output of a {}\n  {}{}\n", output.name, body, output.documentation,
                     output.standard.empty() ? "" : fmt::format(" (default: {})", output.standard));
}

// Whether a statement is meant by these words: all of its name, or one of its two words.
bool is_meant(const ReferenceStatement& statement, std::string_view words) {
  const std::string_view name = statement.name;
  if (name == words) return true;
  const std::size_t space = name.find(' ');
  return space != std::string_view::npos &&
         (name.substr(0, space) == words || name.substr(space + 1) == words);
}

// Statements that have a parameter of that name.
std::string users_of(std::string_view parameter) {
  std::string out;
  for (const ReferenceStatement& statement : reference_statements())
    for (const ReferenceParameter& p : statement.parameters)
      if (p.name == parameter) out += fmt::format("  {}: {}\n", statement.name, p.documentation);
  return out.empty() ? out : fmt::format("{}, a parameter of\n{}", parameter, out);
}

std::vector<std::string_view> all_names() {
  std::vector<std::string_view> names;
  for (const ReferenceStatement& statement : reference_statements()) {
    names.push_back(statement.name);
    for (const ReferenceParameter& p : statement.parameters) names.push_back(p.name);
  }
  for (const ReferenceFunction& function : reference_functions()) names.push_back(function.name);
  for (const ReferenceWord& word : reference_words()) names.push_back(word.word);
  for (const auto* outputs : {&reference_medium_outputs(), &reference_material_outputs()})
    for (const ReferenceOutput& output : *outputs) names.push_back(output.name);
  return names;
}

ExitStatus run_help(const HelpArguments& arguments) {
  if (arguments.words.empty()) {
    print_result(cheat_sheet());
    return ExitStatus::done;
  }
  const std::string words = fmt::format("{}", fmt::join(arguments.words, " "));
  std::vector<std::string> found;
  for (const ReferenceWord& word : reference_words())
    if (word.word == words)
      found.push_back(fmt::format("{}\n  {}\n  For example: {}\n", word.word, word.meaning, word.example));
  for (const ReferenceFunction& function : reference_functions())
    if (function.name == words) found.push_back(entry(function));
  for (const ReferenceStatement& statement : reference_statements())
    if (is_meant(statement, words)) found.push_back(entry(statement));
  for (const ReferenceOutput& output : reference_medium_outputs())
    if (output.name == words) found.push_back(entry(output, "medium"));
  for (const ReferenceOutput& output : reference_material_outputs())
    if (output.name == words) found.push_back(entry(output, "material"));
  if (const std::string users = users_of(words); !users.empty()) found.push_back(users);
  if (found.empty()) {
    const std::string guess = did_you_mean(words, all_names());
    return misuse(fmt::format("the language has nothing named '{}'; {}", words,
                              guess.empty() ? "tyndall help prints all that it has" : guess));
  }
  print_result(fmt::format("{}", fmt::join(found, "\n")));
  return ExitStatus::done;
}

Action help_options(CLI::App& command) {
  const auto arguments = std::make_shared<HelpArguments>();
  command
      .add_option("words", arguments->words,
                  "A function, statement, parameter or output; without one, a page of all of them")
      ->option_text("NAME");
  return [arguments] { return run_help(*arguments); };
}

}  // namespace

constinit const Command help_command{"help", "Say what a word of the scene language is", help_options};

}  // namespace tyndall::tools
