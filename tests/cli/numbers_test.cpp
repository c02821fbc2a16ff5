// Numbers on the command line: every option of the tables reads them alike.
#include "tools/numbers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"
#include "scene/render_settings.h"

namespace tyndall::test {
namespace UNNAMED {

using Numbers = CliTest;

std::string metadata(const std::string& path, const std::string& name) {
  for (const auto& [key, value] : image::read(path).metadata)
    if (key == name) return value;
  return {};
}

// A form with numbers in it: "WxH" of number(0) and number(1).
template <class Number>
std::string filled(std::string_view form, Number&& number) {
  std::string text;
  int count = 0;
  for (std::size_t i = 0; i < form.size();) {
    const auto stands = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
    if (!stands(form[i])) {
      text += form[i++];
      continue;
    }
    while (i < form.size() && stands(form[i])) ++i;
    text += number(count++);
  }
  return text;
}

// A command in which the option stands, with what it needs beside.
std::vector<std::string> command_with(const std::string& option, const std::string& value,
                                      const std::string& scene, const std::string& picture) {
  if (option == "--significance") return {"compare", picture, picture + ".other.exr", option, value};
  if (option == "--max" || option == "--pixels-per-degree")
    return {"compare", picture, picture, option, value};
  if (option == "--white-balance" || option == "--bloom")
    return {"develop", picture, option, value, "-o", picture + ".developed.exr"};
  if (option == "--slice") return {"inspect", scene, "--medium", "cloud", option, value, "-o", picture};
  if (option == "--columns" || option == "--width")
    return {"sheet", picture, "-o", picture + ".sheet.png", option, value};
  if (option == "--seeds" || option == "--reference-error")
    return {"measure", scene, option, value, "--budget", "1s", "--quiet"};
  if (option == "--split" || option == "--chunk")
    return {"plan", scene, "-o", picture, "--samples", "16", option, value};
  if (option == "--cpus") return {"plan", scene, "-o", picture, "--slurm", option, value};
  std::vector<std::string> command{"render", scene, "-o", picture, option, value};
  const auto add = [&](std::vector<std::string> more) {
    command.insert(command.end(), more.begin(), more.end());
  };
  if (option == "--pixel") add({"--sample", "0"});
  if (option == "--sample") add({"--pixel", "0,0"});
  if (option == "--error" || option == "--time-limit") add({"--samples", "1"});
  return command;
}

void expect_refused(const std::vector<std::string>& command, const std::string& option,
                    const std::string& value, const std::string& wanted) {
  const Outcome outcome = tyndall(command);
  EXPECT_EQ(outcome.status, 2) << option << " '" << value << "'\n" << outcome.err;
  EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(wanted), std::string::npos) << option << " '" << value << "'\n" << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

const std::string no_numbers[] = {"0x12", "", "3 ", " 3", "٣", "nan", "inf", "-inf", "+3", "three", "3;"};

TEST_F(Numbers, WholeOnesAreDecimalAndWithinTheirRange) {
  const std::string scene = file("a.tyn", small_scene());
  for (const tools::WholeOption& option : tools::whole_options()) {
    const std::string name(option.name);
    const std::string range = "from " + std::to_string(option.least) + " to " + std::to_string(option.most);
    const auto refuse = [&](const std::string& number) {
      const std::string value = filled(option.form, [&](int) { return number; });
      expect_refused(command_with(name, value, scene, path("a.png")), name, value, range);
    };
    for (const std::string& number : no_numbers) refuse(number);
    for (const std::string number : {"1e3", "3.0", "99999999999999999999999", "-1000000001"}) refuse(number);
    const int good = static_cast<int>(std::max<std::int64_t>(8, option.least));
    const std::string zeros = filled(option.form, [&](int i) { return "0" + std::to_string(good + i); });
    const Outcome outcome = tyndall(command_with(name, zeros, scene, path("a.png")));
    EXPECT_EQ(outcome.status, 0) << name << " " << zeros << "\n" << outcome.err;
  }
  EXPECT_EQ(file_count(), 3u) << "the scene, a picture and a sheet";
}

TEST_F(Numbers, OthersAreDecimalAndFinite) {
  const std::string scene = file("a.tyn", small_scene());
  const auto render = [&] {
    return tyndall({"render", scene, "-o", path("a.exr"), "--aov", "variance"}).status;
  };
  ASSERT_EQ(render(), 0);
  for (const tools::RealOption& option : tools::real_options()) {
    if (option.name == "--significance") {
      ASSERT_EQ(render(), 0) << "the options before it took the picture";
      // The same that does not tell its seed.
      const image::ReadResult read = image::read(path("a.exr"));
      ASSERT_TRUE(read.image) << read.error;
      ASSERT_EQ(image::write(path("a.exr.other.exr"), *read.image, {}), "");
    }
    const std::string name(option.name), before = name == "--slice" ? "z=" : "";
    const auto refuse = [&](const std::string& value) {
      expect_refused(command_with(name, value, scene, path("a.exr")), name, value,
                     "wants " + std::string(option.wanted));
    };
    for (const std::string& number : no_numbers) refuse(before + number);
    refuse(before + "1e999");
    if (name != "--slice" && name != "--frames" && name != "--exposure") refuse("-1");
    if (!option.takes_zero) refuse("0");
    const std::vector<std::string> good = name == "--frames" ? std::vector<std::string>{"07", "-1"}
                                          : name == "--white-balance"
                                              ? std::vector<std::string>{"03200", "3.2e3K", "1,5e-1,00.5"}
                                              : std::vector<std::string>{"00.5", "5e-1"};
    for (const std::string& number : good) {
      const Outcome outcome = tyndall(command_with(name, before + number, scene, path("a.exr")));
      EXPECT_EQ(outcome.status, 0) << name << " " << number << "\n" << outcome.err;
    }
  }
  for (const std::string step : {"adaptive", "adaptive(0)", "adaptive(100%)", "auto(0x1%)", "auto(nan%)",
                                 "auto(-1%)", "auto(100%)", "auto(1)", "auto()", "auto(1%"})
    expect_refused({"render", scene, "-o", path("a.exr"), "--step", step}, "--step", step, "auto(1%)");
}

TEST_F(Numbers, ZerosInFrontMeanNothing) {
  const std::string scene = file("a.tyn", small_scene() + "animation { fps: 24 frames: 1..48 }\n");
  const std::pair<std::string, std::string> frames[] = {{"0012", "12"}, {"08", "8"}, {"1", "1"}};
  for (const auto& [text, number] : frames) {
    const Outcome outcome = tyndall({"render", scene, "-o", path("a.exr"), "--frame", text, "--seed", text,
                                     "--samples", text, "--bounces", "32"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
    EXPECT_EQ(metadata(path("a.exr"), "tyndall:frame"), number);
    EXPECT_EQ(metadata(path("a.exr"), "tyndall:seed"), number);
    EXPECT_EQ(metadata(path("a.exr"), "tyndall:samples"), "0.." + std::to_string(std::stoi(number) - 1));
  }
}

TEST_F(Numbers, TheEndsOfTheRangeOfSeedsAreSeeds) {
  const std::string scene = file("a.tyn", small_scene());
  const std::string last = "18446744073709551615";
  ASSERT_EQ(tyndall({"render", scene, "-o", path("a.exr"), "--seed", last}).status, 0);
  EXPECT_EQ(metadata(path("a.exr"), "tyndall:seed"), last);
  EXPECT_EQ(tyndall({"render", scene, "-o", path("a.exr"), "--seed", "18446744073709551616"}).status, 2);
}

TEST_F(Numbers, OneLimitForSceneAndCommandLine) {
  std::size_t settings = 0;
  scene::RenderSettings::fields([&](auto, const scene::SettingInfo& info) {
    if (!info.range || info.name == "resolution") return;
    ++settings;
    const tools::WholeOption& row = tools::whole_option(info.option);
    const auto in_scene = [&](std::uint64_t value) {
      constexpr auto text = R"(
render {{ {}: {} }}
camera spherical {{ from: (0, 0, 5)  to: (0, 0, 0) }}
)";
      return tyndall({"check", file("b.tyn", fmt::format(text, info.name, value))});
    };
    EXPECT_EQ(in_scene(row.most).status, 0) << in_scene(row.most).err;
    EXPECT_EQ(in_scene(row.most + 1).status, 1);
    EXPECT_NE(in_scene(row.most + 1)
                  .err.find("from " + std::to_string(row.least) + " to " + std::to_string(row.most)),
              std::string::npos)
        << in_scene(row.most + 1).err;
  });
  EXPECT_GE(settings, 3u);
}

TEST_F(Numbers, TheLastOfARepeatedOptionCounts) {
  const std::string scene = file("a.tyn", small_scene());
  for (const tools::WholeOption& option : tools::whole_options()) {
    const std::string name(option.name), value = filled(option.form, [&](int i) {
                                           return std::to_string(i + std::max<std::int64_t>(1, option.least));
                                         });
    std::vector<std::string> command = command_with(name, value, scene, path("a.png"));
    command.insert(command.end(), {name, value});
    const Outcome outcome = tyndall(command);
    EXPECT_EQ(outcome.status, 0) << name << "\n" << outcome.err;
  }
  const Outcome outcome =
      tyndall({"render",  scene,     "-o",       path("first.exr"), "-o",       path("last.exr"), "--seed",
               "1",       "--seed",  "2",        "--aov",           "depth",    "--aov",          "albedo",
               "--quiet", "--quiet", "--method", "tracking",        "--method", "decoupled"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(path("first.exr")));
  EXPECT_EQ(metadata(path("last.exr"), "tyndall:seed"), "2");
  EXPECT_EQ(image::read(path("last.exr")).image->channels,
            (std::vector<std::string>{"R", "G", "B", "albedo.R", "albedo.G", "albedo.B"}));
  const Outcome inspected = tyndall({"inspect", scene, "--stage", "tokens", "--stage", "tree"});
  EXPECT_EQ(inspected.out, tyndall({"inspect", scene, "--stage", "tree"}).out);
  EXPECT_EQ(tyndall({"compare", path("last.exr"), path("last.exr"), "--max", "1", "--max", "0"}).status, 0);
}

// --set and --include are lists.
TEST_F(Numbers, ListsGoOn) {
  std::filesystem::create_directory(path("one"));
  std::filesystem::create_directory(path("two"));
  file("one/one.tyn", "let x = 1\n");
  file("two/two.tyn", "let y = 1\n");
  const std::string scene =
      file("a.tyn",
           "let u = 1\nlet v = 1\ninclude \"one.tyn\"\ninclude \"two.tyn\"\nlet w = 1 / (u + v - 9)\n"
           "camera spherical { from: (0, 0, 5) to: (0, 0, x + y + w) }\n");
  const std::vector<std::string> command{"check",     scene,   "--include", path("one"), "--include",
                                         path("two"), "--set", "u=4",       "--set",     "v=5"};
  const Outcome outcome = tyndall(command);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("zero"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("no file"), std::string::npos) << outcome.err;
}

TEST_F(Numbers, HelpTellsTheRanges) {
  const std::string help =
      tyndall({"render", "--help"}).out + tyndall({"plan", "--help"}).out + tyndall({"sheet", "--help"}).out;
  for (const tools::WholeOption& option : tools::whole_options())
    EXPECT_NE(help.find(std::to_string(option.most) + ")"), std::string::npos) << option.name << "\n" << help;
}

}  // namespace UNNAMED
}  // namespace tyndall::test
