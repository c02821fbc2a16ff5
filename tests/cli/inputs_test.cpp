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

}  // namespace UNNAMED
}  // namespace tyndall::test
