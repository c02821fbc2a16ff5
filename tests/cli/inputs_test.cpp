// Files that are read: pipes and devices where a file is wanted never keep the program waiting.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "cli/run_program.h"

namespace tyndall::test {
namespace UNNAMED {

class Inputs : public CliTest {
 protected:
  std::string pipe(const std::string& name) const {
    EXPECT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
    return path(name);
  }
  Outcome in_shell(const std::string& command) const { return run("/bin/sh", {"-c", command}); }
};

TEST_F(Inputs, AScenePipeThatNothingWritesToIsTold) {
  const std::string scene = pipe("a.tyn");
  for (const std::vector<std::string>& command : {std::vector<std::string>{"check", scene},
                                                  {"render", scene, "-o", path("a.png")},
                                                  {"inspect", scene}}) {
    const Outcome outcome = tyndall(command);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("a.tyn': nothing writes to this pipe"), std::string::npos) << outcome.err;
  }
}

TEST_F(Inputs, AScenePipeIsReadToItsEnd) {
  const std::string scene = pipe("a.tyn"), text = file("text.tyn", small_scene());
  const std::string check = "'" TYNDALL_PROGRAM "' check '" + scene + "'";
  // At once, late, and in two parts.
  for (const std::string& writer :
       {"cat '" + text + "' >'" + scene + "' &", "(sleep 0.3; cat '" + text + "' >'" + scene + "') &",
        "(head -c 40 '" + text + "'; sleep 0.3; tail -c +41 '" + text + "') >'" + scene + "' &"}) {
    const Outcome outcome = in_shell(writer + check);
    EXPECT_EQ(outcome.status, 0) << writer << outcome.err;
    EXPECT_NE(outcome.out.find("a.tyn: good"), std::string::npos) << outcome.out;
  }
  EXPECT_EQ(in_shell("'" TYNDALL_PROGRAM "' check /dev/stdin <'" + text + "'").status, 0);
  EXPECT_EQ(in_shell("cat '" + text + "' | '" TYNDALL_PROGRAM "' check /dev/stdin").status, 0);
}

TEST_F(Inputs, WhatASceneNamesIsAPlainFile) {
  pipe("pipe.exr");
  pipe("pipe.tyn");
  const std::pair<std::string, std::string> cases[] = {
      {"let _a = image(\"pipe.exr\")((0.5, 0.5))", "cannot read 'pipe.exr': it is not a file"},
      {"include \"pipe.tyn\"", "pipe.tyn': it is not a file"}};
  for (const auto& [text, message] : cases) {
    const Outcome outcome = tyndall({"check", file("a.tyn", small_scene() + "\n" + text + "\n")});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
}

TEST_F(Inputs, ComparedPicturesArePlainFiles) {
  const std::string good = path("good.exr"), piped = pipe("pipe.exr");
  ASSERT_EQ(tyndall({"render", file("a.tyn", small_scene()), "-o", good, "--samples", "1"}).status, 0);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"compare", piped, good}, {"compare", good, piped}}) {
    const Outcome outcome = tyndall(command);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("pipe.exr': it is no plain file"), std::string::npos) << outcome.err;
  }
}

// Any name that a file may have, for the files of all commands.
TEST_F(Inputs, NamesOfFilesAreTakenAsTheyAre) {
  for (const char* name : {"[x].tyn", "[x]", "[a,b]", "a b.tyn", "%s.tyn", "x=y.tyn", "'q'.tyn"}) {
    const std::string scene = file(name, small_scene());
    const auto good = [&](const std::vector<std::string>& words) {
      const Outcome outcome = tyndall(words);
      EXPECT_EQ(outcome.status, 0) << words[0] << " " << name << "\n" << outcome.err;
    };
    good({"check", scene, scene});
    good({"format", scene});
    good({"inspect", "--stage", "tree", scene});
    good({"render", scene, "-o", path("out.exr"), "--quiet"});
    EXPECT_TRUE(std::filesystem::exists(scene));
  }
  // Relative ones, which brackets begin.
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(path("."));
  EXPECT_EQ(tyndall({"check", "[x]"}).status, 0);
  EXPECT_EQ(tyndall({"format", "[a,b]", "[x]"}).status, 0);
  EXPECT_EQ(tyndall({"render", "[a,b]", "-o", "[c].exr", "--quiet"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists("[c].exr"));
  EXPECT_EQ(tyndall({"render", "[a,b]", "-o", "[c].tynpart", "--quiet"}).status, 0);
  std::filesystem::rename("[c].tynpart", "[c]");
  EXPECT_EQ(tyndall({"merge", "[c]", "-o", "d.exr"}).status, 0);
  std::filesystem::create_directory("[d]");
  std::filesystem::copy_file("[x].tyn", "[d]/a.tyn");
  EXPECT_EQ(tyndall({"golden", "[d]", "--update"}).status, 0);
  EXPECT_EQ(tyndall({"check", "[x]", "--include", "[d]"}).status, 0);
  std::filesystem::current_path(before);
}

TEST_F(Inputs, NamesThatAreTooLongAreToldAsThat) {
  const std::string name(300, 'x');
  const std::string scene = file("scene.tyn", small_scene());
  const std::vector<std::vector<std::string>> commands = {
      {"check", path(name + ".tyn")},
      {"format", path(name + ".tyn")},
      {"render", path(name + ".tyn"), "-o", path("out.exr")},
      {"render", scene, "-o", path(name + ".exr")},
      {"render", scene, "-o", path("out.exr"), "--stats", path(name + ".json")},
      {"compare", path(name + ".exr"), path(name + ".png")},
      {"develop", path(name + ".exr"), "-o", path("out.png")},
      {"sheet", path(name + ".png"), "-o", path("out.png")},
      {"golden", path(name)},
      {"golden", path(name + ".tyn")},
      {"measure", scene, "-o", path(name + ".html")},
  };
  for (const auto& command : commands) {
    const Outcome outcome = tyndall(command);
    EXPECT_EQ(outcome.status, 1) << command[0];
    EXPECT_NE(outcome.err.find("File name too long"), std::string::npos) << command[0] << "\n" << outcome.err;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
