// `tyndall golden`: scenes with their references, as people test theirs.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;

class Golden : public CliTest {
 protected:
  // A scene with an error in the extinction of one of its media.
  std::string scene(const std::string& name, const std::string& error = "1") const {
    fs::create_directories(path("tests"));
    return file("tests/" + name, R"(render { resolution: (24, 16)  samples: 64  bounces: 8 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }
volume { in: box { min: (-1.2, -1.2, -1.2)  max: (1.2, 1.2, 1.2) }
         medium: { density = 0.8 * )" +
                                     error +
                                     R"(  albedo = (0.9, 0.6, 0.3) } }
volume { in: sphere { center: (0, -1, 1.5)  radius: 0.6 }  medium: { density = 2  albedo = 0.8 } }
light environment { radiance: 0.5 }
)");
  }
  Outcome golden(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{"golden", path("tests")};
    command.insert(command.end(), options.begin(), options.end());
    return tyndall(command);
  }
};

void expect_told(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << "\nin\n" << text;
}

TEST_F(Golden, EqualPicturesPassAndOthersDoNot) {
  scene("a.tyn");
  scene("b.tyn");
  const Outcome made = golden({"--update"});
  EXPECT_EQ(made.status, 0) << made.err;
  expect_told(made.out, {"created", "24x16", "2 created"});
  const Outcome same = golden();
  EXPECT_EQ(same.status, 0) << same.out;
  expect_told(same.out, {"equal to the last bit", "2 passed", "threads of"});
  EXPECT_EQ(golden({"--threads", "1"}).status, 0);

  scene("b.tyn", "1.01");
  const Outcome other = golden({"--report", path("page.html"), "--junit", path("out.xml")});
  EXPECT_EQ(other.status, 3) << other.out;
  expect_told(other.out, {"passed", "differs", "relmse", "FLIP", "the scene's text has changed"});
  const std::string page = read_file(path("page.html")), xml = read_file(path("out.xml"));
  expect_told(page,
              {"<!doctype html>", "data:image/png;base64,iVBOR", "reference", "result", "error", "1 of 2"});
  EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "it needs no other file";
  expect_told(xml, {"tests=\"2\" failures=\"1\" errors=\"0\"", "name=\"b\"", "<failure", "machine"});
  EXPECT_EQ(golden({"--max", "1"}).status, 0);
}

TEST_F(Golden, UpdateTellsWhatChangedAndLeavesTheRest) {
  scene("a.tyn");
  scene("b.tyn");
  ASSERT_EQ(golden({"--update"}).status, 0);
  scene("b.tyn", "2");
  const auto before = fs::last_write_time(path("tests/a.exr"));
  const Outcome renewed = golden({"--update"});
  EXPECT_EQ(renewed.status, 0);
  expect_told(renewed.out, {"1 unchanged, 1 changed", "relmse", "mean"});
  EXPECT_EQ(fs::last_write_time(path("tests/a.exr")), before);
  EXPECT_EQ(golden().status, 0);
}

// The seed is fixed, so this cannot fail by chance; tests/laws/golden_test.cpp has many.
TEST_F(Golden, StatisticsCatchOnePercentOfExtinction) {
  scene("a.tyn");
  ASSERT_EQ(golden({"--update"}).status, 0);
  const Outcome same = golden({"--statistical"});
  EXPECT_EQ(same.status, 0) << same.out;
  expect_told(same.out, {"seed 1", "p = "});
  scene("a.tyn", "1.01");
  const Outcome other = golden({"--statistical", "--seed", "5", "--json"});
  EXPECT_EQ(other.status, 3) << other.out;
  const auto result = nlohmann::json::parse(other.out)["results"][0];
  EXPECT_EQ(result["outcome"], "differs");
  EXPECT_LT(result["z_test"]["p"], 0.001);
  scene("a.tyn");
  EXPECT_EQ(golden({"--statistical", "--seed", "0"}).status, 1) << "the reference's own seed tells nothing";
}

// A reference is rendered again as it was rendered.
TEST_F(Golden, ReferencesKeepTheirOptions) {
  const std::string a = scene("a.tyn");
  ASSERT_EQ(tyndall({"render", a, "-o", path("tests/a.exr"), "--aov", "depth,variance", "--samples", "8",
                     "--resolution", "16x8", "--seed", "3", "--quiet"})
                .status,
            0);
  const Outcome same = golden();
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_EQ(golden({"--statistical"}).status, 0);
  EXPECT_EQ(golden({"--update"}).status, 0);
  const image::ReadResult read = image::read(path("tests/a.exr"));
  ASSERT_TRUE(read.image);
  EXPECT_EQ(read.image->width, 16);
}

TEST_F(Golden, ReferencesMayHaveAFolderOfTheirOwn) {
  scene("a.tyn");
  fs::create_directories(path("pictures"));
  const std::vector<std::string> there{"--references", path("pictures")};
  EXPECT_EQ(golden(there).status, 1) << "there is no reference yet";
  EXPECT_EQ(golden({"--update", "--references", path("pictures")}).status, 0);
  EXPECT_TRUE(fs::exists(path("pictures/a.exr")));
  EXPECT_FALSE(fs::exists(path("tests/a.exr")));
  EXPECT_EQ(golden(there).status, 0);
  scene("a.tyn", "1.01");
  EXPECT_EQ(golden(there).status, 3);

  fs::create_directories(path("others"));
  const std::string other = file("others/a.tyn", read_file(path("tests/a.tyn")));
  const Outcome both = tyndall({"golden", path("tests"), other, "--references", path("pictures")});
  EXPECT_EQ(both.status, 1);
  expect_told(both.err, {"would be the reference of both", "tests/a.tyn", "others/a.tyn"});
  const Outcome nowhere = golden({"--references", path("nowhere")});
  EXPECT_EQ(nowhere.status, 1);
  expect_told(nowhere.err, {"--references wants a folder"});
}

TEST_F(Golden, ErrorsTeach) {
  fs::create_directories(path("tests"));
  const Outcome none = golden();
  EXPECT_EQ(none.status, 1);
  expect_told(none.err, {"has no scene (.tyn)", "--update"});
  EXPECT_EQ(tyndall({"golden", path("nowhere")}).status, 1);

  const std::string a = scene("a.tyn");
  const Outcome missing = golden({"--junit", path("out.xml")});
  EXPECT_EQ(missing.status, 1);
  expect_told(missing.out, {"there is no reference", "--update"});
  expect_told(read_file(path("out.xml")), {"errors=\"1\"", "<error"});

  const image::Image other{3, 2, {"R", "G", "B"}, std::vector<float>(18)};
  ASSERT_EQ(image::write(path("tests/a.exr"), other, {}), "");
  expect_told(golden().out, {"is of no use: Tyndall did not render it"});
  ASSERT_EQ(tyndall({"render", a, "-o", path("tests/a.exr"), "--crop", "0,0,8,8", "--quiet"}).status, 0);
  expect_told(golden().out, {"--crop"});
  EXPECT_EQ(golden({"--update"}).status, 0);

  file("tests/a.tyn", "let a = b\n");
  const Outcome bad = golden();
  EXPECT_EQ(bad.status, 1);
  expect_told(bad.out, {"problem", "a.tyn:1:9: error"});
  scene("a.tyn");
  EXPECT_EQ(golden({"--report", path("no/folder.html")}).status, 1);
  EXPECT_EQ(golden({"--report", path("tests/a.exr")}).status, 1) << "it would overwrite a reference";
  EXPECT_EQ(golden({"--seed", "3"}).status, 2);
  EXPECT_EQ(golden({"--update", "--statistical"}).status, 2);
}

TEST_F(Golden, OtherSizesAreTold) {
  const std::string a = scene("a.tyn");
  ASSERT_EQ(golden({"--update"}).status, 0);
  std::string text = read_file(a);
  text.replace(text.find("(24, 16)"), 8, "(20, 16)");
  file("tests/a.tyn", text);
  const Outcome outcome = golden();
  EXPECT_EQ(outcome.status, 3);
  expect_told(outcome.out, {"the picture is 20x16, its reference 24x16"});
}

TEST_F(Golden, IncludedFoldersAreFoundFromAnywhere) {
  fs::create_directories(path("lib"));
  file("lib/thick.tyn", "let thick = 0.8\n");
  fs::create_directories(path("tests"));
  file("tests/a.tyn", R"(include "thick.tyn"
render { resolution: (8, 6)  samples: 4 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0) }
volume { in: sphere {}  medium: { density = thick  albedo = 0.5 } }
light environment { radiance: 0.5 }
)");
  const fs::path before = fs::current_path();
  fs::current_path(path("."));
  const Outcome made = tyndall({"golden", "tests", "--include", "lib", "--update"});
  EXPECT_EQ(made.status, 0) << made.out;
  fs::current_path(path("tests"));
  const Outcome below = tyndall({"golden", "."});
  EXPECT_EQ(below.status, 0) << below.out;
  const Outcome given = tyndall({"golden", ".", "--include", "../lib"});
  EXPECT_EQ(given.status, 0) << given.out;
  EXPECT_EQ(given.out.find("--include has changed"), std::string::npos) << given.out;
  fs::current_path(before);
}

// A scene that takes long, and warns before.
constexpr const char* slow_scene = R"(render { resolution: (64, 48)  samples: 100000 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0) }
let _unused = 1
volume { in: sphere {}  medium: { density = 5  albedo = 0.9 } }
light environment { radiance: 0.5 }
)";

// The processes that were started with this word, other than this one.
std::vector<pid_t> processes_of(const std::string& word) {
  std::vector<pid_t> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string command = read_file((entry.path() / "cmdline").string());
    if (command.find(word) != std::string::npos && command.find("render") != std::string::npos)
      found.push_back(static_cast<pid_t>(std::stol(name)));
  }
  return found;
}
bool soon(const std::function<bool()>& holds) {
  for (int i = 0; i < 1000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

TEST_F(Golden, AKilledRenderIsToldAsThat) {
  fs::create_directories(path("tests"));
  const std::string scene = file("tests/slow.tyn", slow_scene);
  std::thread killer([&] {
    EXPECT_TRUE(soon([&] {
      const std::vector<pid_t> renders = processes_of(scene);
      for (const pid_t process : renders) ::kill(process, SIGKILL);
      return !renders.empty();
    }));
  });
  const Outcome outcome = golden({"--update"});
  killer.join();
  EXPECT_EQ(outcome.status, 1);
  expect_told(outcome.out, {"problem", "signal 9 ended it"});
}

TEST_F(Golden, AnInterruptionShowsInReports) {
  fs::create_directories(path("tests"));
  // The render that runs is waited for.
  std::string text = slow_scene;
  text.replace(text.find("100000"), 6, "300");
  const std::string scene = file("tests/slow.tyn", text);
  RunOptions options;
  options.interrupt_after_seconds = 0.1;
  options.wait_for = [&] { return !processes_of(scene).empty(); };
  const Outcome outcome =
      tyndall({"golden", path("tests"), "--update", "--junit", path("out.xml"), "--threads", "1"}, options);
  EXPECT_EQ(outcome.status, 130);
  expect_told(outcome.err, {"1 of 1 scenes were not tested"});
  expect_told(read_file(path("out.xml")), {"tests=\"1\" failures=\"0\" errors=\"1\"", "interruption"});
}

TEST_F(Golden, WhatAKilledRunLeftIsRemoved) {
  fs::create_directories(path("tests"));
  fs::create_directories(path("tmp"));
  const std::string scene = file("tests/slow.tyn", slow_scene);
  RunOptions options;
  options.interrupt_after_seconds = 0.05;
  options.signal = SIGKILL;
  options.wait_until_caught = false;
  options.wait_for = [&] { return !processes_of(scene).empty(); };
  options.environment = {"TMPDIR=" + path("tmp")};
  EXPECT_EQ(tyndall({"golden", path("tests"), "--update"}, options).status, 128 + SIGKILL);
  EXPECT_TRUE(soon([&] { return processes_of(scene).empty(); })) << "renders end with what started them";
  ASSERT_FALSE(fs::is_empty(path("tmp")));
  for (const auto& folder : fs::directory_iterator(path("tmp")))
    fs::last_write_time(folder.path(), fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::remove(scene);
  this->scene("fast.tyn");
  RunOptions quiet;
  quiet.environment = options.environment;
  EXPECT_EQ(tyndall({"golden", path("tests"), "--update"}, quiet).status, 0);
  EXPECT_TRUE(fs::is_empty(path("tmp")));
}

}  // namespace UNNAMED
}  // namespace tyndall::test
