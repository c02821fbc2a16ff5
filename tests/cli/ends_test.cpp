// Runs that end before they are done: by signals, limits of the system and of time.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;

class Ends : public CliTest {
 protected:
  std::string scene() const { return file("a.tyn", small_scene()); }
  // The program in a shell, after `limits`.
  Outcome limited(const std::string& limits, const std::string& options) const {
    return run("/bin/sh", {"-c", "ulimit -c 0; " + limits + "; exec '" TYNDALL_PROGRAM "' render '" +
                                     scene() + "' -o '" + path("a.exr") + "' " + options});
  }
  void expect_no_rest() const {
    for (const auto& entry : fs::directory_iterator(path("")))
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }
};

TEST_F(Ends, SignalsSaveWhatThereIs) {
  for (const int signal : {SIGTERM, SIGHUP, SIGXCPU}) {
    fs::remove(path("a.exr"));
    fs::remove(path("a.exr.checkpoint"));
    const Outcome outcome = tyndall(
        {"render", scene(), "-o", path("a.exr"), "--samples", "100000000", "--checkpoint-interval", "0.1"},
        {.interrupt_after_seconds = 1e-3, .signal = signal, .wait_for = appears("a.exr.checkpoint")});
    EXPECT_EQ(outcome.status, 130) << signal << outcome.err;
    EXPECT_TRUE(image::read(path("a.exr")).image) << signal;
  }
}

// The picture goes to a pipe that nothing reads, which is waited for: the second signal ends that.
TEST_F(Ends, ASecondSignalEndsAtOnce) {
  ASSERT_EQ(::mkfifo(path("pipe.exr").c_str(), 0600), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Outcome outcome = tyndall({"render", scene(), "-o", path("pipe.exr"), "--samples", "100000000"},
                                    {.interrupt_after_seconds = 0.15, .signal = signal, .times = 2});
    EXPECT_EQ(outcome.status, 128 + signal) << outcome.err;
    EXPECT_EQ(outcome.err.find("nothing reads"), std::string::npos) << outcome.err;
  }
}

// One tile, which takes some seconds: nothing of it counts, and a good picture is not replaced by a black
// one.
TEST_F(Ends, WithoutAnySampleNothingIsWritten) {
  const std::string old = "an earlier picture";
  for (const bool by_signal : {true, false}) {
    file("a.exr", old);
    std::vector<std::string> command{"render",          scene(), "-o",      path("a.exr"),
                                     "--resolution",    "16x16", "--step",  "0.002",
                                     "--light-samples", "384",   "--stats", path("a.json")};
    if (!by_signal) command.insert(command.end(), {"--time-limit", "0.3"});
    const Outcome outcome =
        tyndall(command, {.interrupt_after_seconds = by_signal ? 0.6 : 0.0, .signal = SIGTERM});
    EXPECT_EQ(outcome.status, by_signal ? 130 : 1) << outcome.err;
    EXPECT_NE(outcome.err.find("a.exr' was not written: the run ended before any pixel had a sample"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(read_file(path("a.exr")), old);
    EXPECT_EQ(nlohmann::json::parse(read_file(path("a.json")))["samples"], 0);
    expect_no_rest();
  }
}

// A terminal that closes is no reason for what nohup started.
TEST_F(Ends, IgnoredSignalsStayIgnored) {
  const Outcome outcome =
      run("/bin/sh", {"-c", "trap '' HUP; '" TYNDALL_PROGRAM "' render '" + scene() + "' -o '" +
                                path("a.exr") + "' --time-limit 0.6 & sleep 0.2; kill -HUP $!; wait $!"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// At any time from the start through rendering to writing.
TEST_F(Ends, EarlySignalsLeaveNoRest) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    for (int i = 0; i < 8; ++i) {
      fs::remove(path("a.exr"));
      const Outcome outcome = tyndall(
          {"render", scene(), "-o", path("a.exr"), "--resolution", "300x200", "--samples", "1"},
          {.interrupt_after_seconds = 0.001 + 0.008 * i, .signal = signal, .wait_until_caught = false});
      EXPECT_TRUE(outcome.status == 0 || outcome.status == 130 || outcome.status == 128 + signal)
          << outcome.status << outcome.err;
      EXPECT_TRUE(fs::exists(path("a.exr")) || outcome.status != 0);
      if (fs::exists(path("a.exr"))) {
        EXPECT_TRUE(image::read(path("a.exr")).image);
      }
      expect_no_rest();
    }
}

TEST_F(Ends, AFileBeyondTheAllowedSizeIsAnError) {
  const Outcome outcome = limited("ulimit -f 1", "--quiet");
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(path("a.exr")));
  expect_no_rest();
}

TEST_F(Ends, ThreadsThatCannotBeHadAreNoAbort) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "sanitizers want all addresses";
#endif
  for (const std::string kilobytes : {"300000", "600000", "1000000"}) {
    const Outcome outcome =
        limited("ulimit -v " + kilobytes, "--resolution 200x200 --samples 1 --threads 400");
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 1)
        << kilobytes << ": " << outcome.status << outcome.err;
    const std::string told = outcome.status == 0 ? "threads could not be had" : "not enough memory";
    EXPECT_NE(outcome.err.find(told), std::string::npos) << outcome.err;
  }
}

// 64 million pixels, of which 16 are rendered: the film of all would take 4 GB.
TEST_F(Ends, ACropTakesTheMemoryOfItsPixels) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "sanitizers want all addresses";
#endif
  const Outcome outcome = limited("ulimit -v 1500000",
                                  "--resolution 8192x8192 --crop 5,6,9,10 --samples 1 "
                                  "--threads 1 --aov depth,samples --stats '" +
                                      path("a.json") + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(read_file(path("a.json")))["samples"], 16);
  EXPECT_LT(fs::file_size(path("a.exr")), 100'000u);
}

TEST_F(Ends, ATimeLimitEndsTheFirstPassToo) {
  const Outcome outcome = tyndall({"render", scene(), "-o", path("a.exr"), "--resolution", "1024x1024",
                                   "--step", "0.001", "--time-limit", "0.5", "--stats", path("a.json")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto statistics = nlohmann::json::parse(read_file(path("a.json")));
  EXPECT_TRUE(statistics["out_of_time"]);
  EXPECT_LT(statistics["seconds"]["render"], 5) << "the whole pass takes minutes";
  EXPECT_GT(statistics["pixels_without_samples"], 0);
  EXPECT_EQ(statistics["pixels_without_samples"].get<int>() + statistics["samples"].get<int>(), 1024 * 1024);
  EXPECT_NE(outcome.err.find("pixels have no samples"), std::string::npos) << outcome.err;
  const image::ReadResult saved = image::read(path("a.exr"));
  for (const auto& [key, value] : saved.metadata)
    if (key == "tyndall:samples") {
      EXPECT_NE(value.find("on average"), std::string::npos) << value;
    }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
