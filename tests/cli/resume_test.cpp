// `render --resume`: runs that are ended in any way, and go on to the picture of a run that was not.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class Resume : public CliTest {
 protected:
  // About a second of work on one thread.
  Words command(const std::string& output, const Words& more = {}) const {
    Words words{"render",
                file("a.tyn", small_scene()),
                "-o",
                path(output),
                "--resolution",
                "96x72",
                "--samples",
                "40",
                "--threads",
                "2",
                "--checkpoint-interval",
                "0.05"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static Words with(Words words, const std::string& option) {
    words.push_back(option);
    return words;
  }
  // Renders the picture that interrupted runs are to end as, and takes its time [s].
  double render_whole(const std::string& output, const Words& more = {}) const {
    const auto begin = std::chrono::steady_clock::now();
    const Outcome outcome = tyndall(command(output, more));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  Outcome run_for(double seconds, int signal, const Words& words) const {
    return tyndall(words, {.interrupt_after_seconds = seconds, .signal = signal});
  }
  // Kills runs at random moments; one that ends, and the last, are the whole picture.
  void expect_same_after_kills(const Words& options, const std::string& extension, int kills, unsigned seed) {
    const std::string whole = path("whole" + extension), output = "a" + extension;
    const double seconds = render_whole("whole" + extension, options);
    const Words words = with(command(output, options), "--resume");
    std::mt19937 random(seed);
    int resumed = 0;
    for (int i = 0; i <= kills; ++i) {
      const double moment = std::uniform_real_distribution<double>(0.1, 0.7)(random) * seconds;
      const Outcome outcome = i < kills ? run_for(moment, SIGKILL, words) : tyndall(words);
      resumed += outcome.err.find("goes on from there") != std::string::npos;
      if (outcome.status == 128 + SIGKILL && i < kills) continue;
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_TRUE(read_file(path(output)) == read_file(whole)) << options[0] << " " << i;
      EXPECT_FALSE(fs::exists(path(output + ".checkpoint")));
      fs::remove(path(output));
    }
    EXPECT_GT(resumed, 0) << "some run left something";
    // The scene and the whole: nothing is left beside.
    EXPECT_EQ(file_count(), 2u);
    fs::remove(whole);
  }
};

TEST_F(Resume, KilledRunsGoOnToTheSamePicture) {
  expect_same_after_kills({"--aov", "variance"}, ".exr", 3, 5);
}

TEST_F(Resume, KilledPartsGoOnToTheSamePart) {
  expect_same_after_kills({"--sample-range", "5..39"}, ".tynpart", 3, 6);
}

// Twenty moments, for pictures of each kind.
class ResumeSlow : public Resume {};
TEST_F(ResumeSlow, KilledAtTwentyMoments) {
  expect_same_after_kills({"--aov", "depth,variance"}, ".exr", 7, 1);
  expect_same_after_kills({"--error", "0.05"}, ".exr", 7, 2);
  expect_same_after_kills({"--crop", "5,3,90,70"}, ".png", 6, 3);
}

TEST_F(Resume, SignalsLoseNothing) {
  const Words options{"--error", "0.05"};
  const double seconds = render_whole("whole.exr", options);
  const Words words = with(command("a.exr", options), "--resume");
  int interrupted = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Outcome outcome;
    double after = 0.2 * seconds;
    do {  // later, where nothing had begun
      outcome = run_for(after, signal, words);
      after *= 1.3;
    } while (outcome.status == 128 + signal && (signal != SIGINT || !fs::exists(path("a.exr.checkpoint"))) &&
             after < 100);
    ASSERT_TRUE(outcome.status == 130 || outcome.status == 0) << outcome.status << outcome.err;
    interrupted += outcome.status == 130;
    EXPECT_EQ(fs::exists(path("a.exr.checkpoint")), outcome.status == 130);
  }
  EXPECT_GT(interrupted, 0);
  ASSERT_EQ(tyndall(words).status, 0);
  EXPECT_TRUE(read_file(path("a.exr")) == read_file(path("whole.exr")));
  const Outcome again = tyndall(words);
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.err.find("a.exr: it is there already"), std::string::npos) << again.err;
}

TEST_F(Resume, CheckpointsOfOtherPicturesAreToldAndNotUsed) {
  ASSERT_EQ(run_for(0.5 * render_whole("a.exr"), SIGINT, command("a.exr")).status, 130);
  const std::string bytes = read_file(path("a.exr.checkpoint"));
  ASSERT_FALSE(bytes.empty());
  const auto told = [&](const std::string& checkpoint, const Words& options, const std::string& words) {
    file("a.exr.checkpoint", checkpoint);
    const Outcome outcome = tyndall(command("a.exr", options));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words << "\n" << outcome.err;
    EXPECT_FALSE(fs::exists(path("a.exr.checkpoint")));
  };
  told(bytes, {"--resume", "--resolution", "8x6"},
       "is of another picture: --resolution was 96x72, is 8x6; rendering begins anew");
  told(bytes, {}, "has a part of this picture, and is not used: --resume goes on from it");
  fs::remove(path("a.exr"));
  told(bytes.substr(0, bytes.size() / 2), {"--resume"}, "it is damaged or cut short; rendering begins anew");
  file("c.tynpart", bytes);
  const Outcome merged = tyndall({"merge", path("c.tynpart"), "-o", path("m.exr")});
  EXPECT_NE(merged.err.find("is the checkpoint of a render that has not ended"), std::string::npos)
      << merged.err;
}

// No room for the checkpoint, as on a full disk: told at once, and the picture is rendered all the same.
TEST_F(Resume, ACheckpointThatCannotBeWrittenIsToldAndNotTheEnd) {
  std::string line;
  for (const std::string& word : command("a.png")) line += " '" + word + "'";
  const Outcome outcome =
      run("/bin/sh", {"-c", "ulimit -c 0; ulimit -f 100; exec '" TYNDALL_PROGRAM "'" + line});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("a.png.checkpoint': File too large; rendering goes on"), std::string::npos)
      << outcome.err;
  EXPECT_TRUE(image::read(path("a.png")).image);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
