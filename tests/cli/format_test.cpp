// `tyndall format` on files: they are replaced whole, named by --check, and left alone when they have errors.
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/run_program.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
using Format = CliTest;

const std::string untidy = "sphere{radius:1}// a ball\n", tidy = "sphere { radius: 1 }  // a ball\n";

TEST_F(Format, ReplacesAFileAndNamesIt) {
  const std::string scene = file("a.tyn", untidy);
  const Outcome first = tyndall({"format", scene});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out, scene + ": formatted\n");
  EXPECT_EQ(read_file(scene), tidy);
  const Outcome second = tyndall({"format", scene});
  EXPECT_EQ(second.status, 0);
  EXPECT_EQ(second.out, "");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Format, KeepsPermissionsAndLinks) {
  const std::string scene = file("a.tyn", untidy);
  const auto mode = fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read;
  fs::permissions(scene, mode);
  fs::create_symlink(scene, path("link.tyn"));
  EXPECT_EQ(tyndall({"format", path("link.tyn")}).status, 0);
  EXPECT_TRUE(fs::is_symlink(path("link.tyn")));
  EXPECT_EQ(read_file(scene), tidy);
  EXPECT_EQ(fs::status(scene).permissions(), mode);
}

TEST_F(Format, CheckNamesWhatWouldChange) {
  const std::string first = file("a.tyn", untidy), second = file("b.tyn", tidy);
  const Outcome outcome = tyndall({"format", "--check", first, second});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out, first + ": would be formatted\n");
  EXPECT_EQ(read_file(first), untidy);
  EXPECT_EQ(tyndall({"format", "--check", second}).status, 0);
}

TEST_F(Format, KeepsLineEndsAndTheByteOrderMark) {
  const auto with = [](std::string text, const std::string& end) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
      text.replace(at, 1, end);
    return text;
  };
  const std::string before = "sphere{radius:1}// a ball\n/* of\n glass */\nlet a=1\n",
                    after = "sphere { radius: 1 }  // a ball\n/* of\n glass */\nlet a = 1\n";
  for (const std::string mark : {"", "\xef\xbb\xbf"})
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const std::string scene = file("a.tyn", mark + with(before, end));
      EXPECT_EQ(tyndall({"format", scene}).out, scene + ": formatted\n");
      EXPECT_EQ(read_file(scene), mark + with(after, end));
      EXPECT_EQ(tyndall({"format", "--check", scene}).status, 0);
    }
  const std::string mixed = file("m.tyn", "let a = 1\r\nlet b = 2\r\nlet c = 3\nlet d = 4\rlet e = 5\r\n");
  EXPECT_EQ(tyndall({"format", mixed}).status, 0);
  EXPECT_EQ(read_file(mixed), with("let a = 1\nlet b = 2\nlet c = 3\nlet d = 4\nlet e = 5\n", "\r\n"));
}

TEST_F(Format, LeavesFilesWithErrorsAlone) {
  const std::string broken = file("a.tyn", "sphere{radius:}"), good = file("b.tyn", untidy);
  const Outcome outcome = tyndall({"format", broken, good, path("missing.tyn")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("a.tyn:1:15: error: expected a value"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot read"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_file(broken), "sphere{radius:}");
  EXPECT_EQ(read_file(good), tidy);
}

TEST_F(Format, SaysWhenItCannotWrite) {
  const std::string scene = file("a.tyn", untidy);
  fs::permissions(scene, fs::perms::owner_read);
  const Outcome outcome = tyndall({"format", scene});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("cannot write"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_file(scene), untidy);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Format, ReplacesPlainFilesOnly) {
  fs::create_symlink("/dev/null", path("null.tyn"));
  const Outcome outcome = tyndall({"format", path("null.tyn")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("it is no plain file"), std::string::npos) << outcome.err;
}

}  // namespace UNNAMED
}  // namespace tyndall::test
