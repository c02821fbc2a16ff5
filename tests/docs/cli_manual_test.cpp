// The tables of docs/cli.md that are made from the code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "docs/generated.h"
#include "render/aov.h"
#include "tools/numbers.h"

namespace tyndall::docs {
namespace {

TEST(CliManual, OutputsBesideThePictureAreThoseOfTheTable) {
  std::string table = "| name | channels | |\n| --- | --- | --- |\n";
  for (const render::AovInfo& info : render::aov_infos())
    table += fmt::format("| `{}` | {} | {} |\n", info.name, info.channels, info.documentation);
  expect_part(root / "docs/cli.md", "aovs", table);
}

TEST(CliManual, NumbersAreThoseOfTheTables) {
  std::string table = "| option | wants |\n| --- | --- |\n";
  for (const tools::WholeOption& option : tools::whole_options)
    table += fmt::format("| `{}` | {} |\n", option.name, tools::wanted(option));
  for (const tools::RealOption& option : tools::real_options)
    table += fmt::format("| `{}` | {} |\n", option.name, tools::wanted(option));
  expect_part(root / "docs/cli.md", "numbers", table);
}

}  // namespace
}  // namespace tyndall::docs
