// The tables of docs/cli.md that are made from the code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "docs/generated.h"
#include "render/aov.h"

namespace tyndall::docs {
namespace {

TEST(CliManual, OutputsBesideThePictureAreThoseOfTheTable) {
  std::string table = "| name | channels | |\n| --- | --- | --- |\n";
  for (const render::AovInfo& info : render::aov_infos())
    table += fmt::format("| `{}` | {} | {} |\n", info.name, info.channels, info.documentation);
  expect_part(root / "docs/cli.md", "aovs", table);
}

}  // namespace
}  // namespace tyndall::docs
