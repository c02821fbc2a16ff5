// The tables of docs/cli.md that are made from the code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <regex>

#include "docs/generated.h"
#include "render/film/aov.h"
#include "tools/commands.h"
#include "tools/numbers.h"
#include "tools/setting_options.h"

namespace tyndall::docs {
namespace UNNAMED {

TEST(CliManual, CommandsAreThoseOfTheProgram) {
  const std::string manual = read_file(root / "docs/cli.md");
  std::string table = "| command | does |\n| --- | --- |\n";
  for (const tools::Command* command : tools::commands) {
    table += fmt::format("| [`{0}`](#{0}) | {1} |\n", command->name, command->help);
    EXPECT_NE(manual.find(fmt::format("\n## {}\n", command->name)), std::string::npos) << command->name;
  }
  expect_part(root / "docs/cli.md", "commands", table);
}

TEST(CliManual, OutputsBesideThePictureAreThoseOfTheTable) {
  std::string table = "| name | channels | |\n| --- | --- | --- |\n";
  for (const render::AovInfo& info : render::aov_infos())
    table += fmt::format("| `{}` | {} | {} |\n", info.name, info.channels, info.documentation);
  expect_part(root / "docs/cli.md", "aovs", table);
}

TEST(CliManual, SettingsAreThoseOfTheScene) {
  CLI::App command;
  tools::GivenSettings given;
  tools::add_setting_options(command, given);
  std::string table = "| option | is |\n| --- | --- |\n";
  for (const CLI::Option* option : command.get_options()) {
    if (option == command.get_help_ptr()) continue;
    const std::string form = std::regex_replace(option->get_option_text(), std::regex(R"(\|)"), R"(\|)");
    table += fmt::format("| `{} {}` | {} |\n", option->get_name(), form, option->get_description());
  }
  expect_part(root / "docs/cli.md", "settings", table);
}

TEST(CliManual, NumbersAreThoseOfTheTables) {
  std::string table = "| option | wants |\n| --- | --- |\n";
  for (const tools::WholeOption& option : tools::whole_options())
    table += fmt::format("| `{}` | {} |\n", option.name, tools::wanted(option));
  for (const tools::RealOption& option : tools::real_options())
    table += fmt::format("| `{}` | {} |\n", option.name, option.wanted);
  expect_part(root / "docs/cli.md", "numbers", table);
}

}  // namespace
}  // namespace tyndall::docs
