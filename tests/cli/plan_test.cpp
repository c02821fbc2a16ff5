// `tyndall plan`: commands that make the frames, whoever runs them and however often, or an error now.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <utility>

#include "cli/run_program.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// A scene that moves, in a folder whose name means much to a shell.
class Plan : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    fs::create_directory(path(folder_));
    scene_ = file(folder_ + "/the shot.tyn", small_scene() +
                                                 "let part = 1\nanimation { fps: 24 frames: 1..3 }\n"
                                                 "sphere { center: (time, 0, 0) radius: 0.1 * part }\n");
  }
  std::string in_folder(const std::string& name) const { return path(folder_ + "/" + name); }
  Outcome plan(const Words& options) const {
    Words words{"plan", scene_};
    words.insert(words.end(), options.begin(), options.end());
    return tyndall(words);
  }
  // The frames of these options, each rendered alone, as alone.####.exr.
  void render_alone(int frames, const Words& options) const {
    for (int frame = 1; frame <= frames; ++frame) {
      Words words{"render", scene_, "--frame", std::to_string(frame), "-o", in_folder("alone.####.exr")};
      words.insert(words.end(), options.begin(), options.end());
      ASSERT_EQ(tyndall(words).status, 0);
    }
  }
  void expect_frames(int frames) const {
    for (int frame = 1; frame <= frames; ++frame) {
      const std::string number = "000" + std::to_string(frame);
      EXPECT_TRUE(read_file(in_folder("out." + number + ".exr")) ==
                  read_file(in_folder("alone." + number + ".exr")))
          << frame;
    }
  }
  // Runs the lines in a folder that is not the scene's.
  static Outcome run_lines(const std::string& script) { return run("/bin/sh", {"-e", script}); }

  std::string folder_ = "it's $HOME; \"#&";
  std::string scene_;
};

const Words setting{"--set", "part=1 + 1", "--samples", "5", "--aov", "depth,variance"};

TEST_F(Plan, LinesMakeTheFrames) {
  render_alone(3, setting);
  Words options = setting;
  options.insert(options.end(), {"--frames", "1..3", "--split", "2", "-o", in_folder("out.####.exr")});
  const Outcome planned = plan(options);
  ASSERT_EQ(planned.status, 0) << planned.err;
  const std::string script = file("plan.sh", planned.out);
  const Outcome made = run_lines(script);
  ASSERT_EQ(made.status, 0) << made.err;
  expect_frames(3);
  // Parts are gone; what is run again finds everything there.
  const auto is_part = [](const fs::directory_entry& entry) {
    return entry.path().extension() == ".tynpart";
  };
  EXPECT_EQ(std::count_if(fs::directory_iterator(path(folder_)), fs::directory_iterator(), is_part), 0);
  const auto written = fs::last_write_time(in_folder("out.0002.exr"));
  const Outcome again = run_lines(script);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(fs::last_write_time(in_folder("out.0002.exr")), written);
  EXPECT_NE(again.err.find("it is there already"), std::string::npos) << again.err;
  expect_frames(3);
}

// Parts come before merges, as the comments say how many.
TEST_F(Plan, LinesAreInTheOrderOfWhatTheyNeed) {
  const Outcome planned = plan({"--split", "2", "-o", in_folder("out.####.png"), "--seed", "3"});
  ASSERT_EQ(planned.status, 0) << planned.err;
  std::istringstream lines(planned.out);
  std::string kinds;
  for (std::string line; std::getline(lines, line);)
    kinds += line.starts_with('#') ? '#' : line.find(" render '") != std::string::npos ? 'r' : 'm';
  EXPECT_EQ(kinds.substr(kinds.find_first_not_of('#')), "rrrrrrmmm");
  EXPECT_NE(planned.out.find("head -n 6 | parallel"), std::string::npos) << planned.out;
  EXPECT_NE(planned.out.find("tail -n 3 | parallel"), std::string::npos) << planned.out;
}

TEST_F(Plan, ATaskMayHaveSeveralFrames) {
  render_alone(3, {"--threads", "1"});
  const Outcome planned = plan({"--chunk", "2", "-o", in_folder("out.####.exr"), "--threads", "2"});
  ASSERT_EQ(planned.status, 0) << planned.err;
  EXPECT_NE(planned.out.find("--frames 1,2 "), std::string::npos) << planned.out;
  EXPECT_EQ(run_lines(file("plan.sh", planned.out)).status, 0);
  expect_frames(3);
}

// A scene that has changed makes parts and pictures anew; one that has not keeps what there is.
TEST_F(Plan, StaleFramesAreMadeAgain) {
  const Words options{"--frame", "1", "--split", "2", "-o", in_folder("out.####.exr")};
  const std::string script = file("plan.sh", plan(options).out);
  ASSERT_EQ(run_lines(script).status, 0);
  const std::string before = read_file(in_folder("out.0001.exr"));
  file(folder_ + "/the shot.tyn", read_file(scene_) + "plane { point: (0, 0, -3)  normal: (0, 0, 1) }\n");
  ASSERT_EQ(run_lines(script).status, 0);
  EXPECT_FALSE(read_file(in_folder("out.0001.exr")) == before);
  render_alone(1, {});
  expect_frames(1);
}

// A merge that was ended while it removed parts removes the others; parts that are of another picture are
// told.
TEST_F(Plan, MergesEndWhatAnEarlierOneBegan) {
  const auto part = [&](const std::string& name, const std::string& range, const std::string& seed,
                        const std::string& samples = "4") {
    ASSERT_EQ(tyndall({"render", scene_, "--samples", samples, "--seed", seed, "--sample-range", range, "-o",
                       in_folder(name)})
                  .status,
              0);
  };
  const Words merge{"merge", in_folder("a.tynpart"), in_folder("b.tynpart"),
                    "-o",    in_folder("out.exr"),   "--remove-parts"};
  part("a.tynpart", "0..1", "1");
  EXPECT_EQ(tyndall(merge).status, 1);
  EXPECT_TRUE(fs::exists(in_folder("a.tynpart")));
  part("b.tynpart", "2..3", "1");
  ASSERT_EQ(tyndall(merge).status, 0);
  const std::string whole = read_file(in_folder("out.exr"));
  EXPECT_FALSE(fs::exists(in_folder("a.tynpart")) || fs::exists(in_folder("b.tynpart")));
  part("b.tynpart", "2..3", "1");
  EXPECT_EQ(tyndall(merge).status, 0);
  EXPECT_FALSE(fs::exists(in_folder("b.tynpart")));
  // A part of a picture that has more samples is of another one.
  part("b.tynpart", "2..3", "1", "6");
  EXPECT_EQ(tyndall(merge).status, 1);
  EXPECT_TRUE(fs::exists(in_folder("b.tynpart")));
  part("b.tynpart", "2..3", "2");
  EXPECT_EQ(tyndall(merge).status, 1);
  EXPECT_TRUE(fs::exists(in_folder("b.tynpart")));
  EXPECT_TRUE(read_file(in_folder("out.exr")) == whole);
}

// Two processes have the same task: one has ended, the other saves what it has so far and is killed.
TEST_F(Plan, AFinishedPictureStaysWhatASecondRunDoes) {
  const Words words{
      "render", scene_,      "-o", in_folder("out.exr"),    "--resolution", "64x48",   "--samples",
      "200",    "--threads", "1",  "--checkpoint-interval", "0.02",         "--resume"};
  ASSERT_EQ(tyndall(words).status, 0);
  const std::string whole = in_folder("whole.exr");
  fs::rename(in_folder("out.exr"), whole);
  for (const int signal : {SIGKILL, SIGTERM}) {
    // The finished picture takes the place of the first that is saved; the run is ended after it has saved
    // what it has three times more, which its checkpoint tells.
    const std::string out = in_folder("out.exr"), checkpoint = out + ".checkpoint";
    bool has_finished = false;
    int saved = 0;
    fs::file_time_type last;
    const auto has_saved_more = [&] {
      std::error_code failed;
      const fs::file_time_type now = fs::last_write_time(checkpoint, failed);
      if (failed || !fs::exists(out)) return false;
      if (!std::exchange(has_finished, true)) {
        fs::copy_file(whole, in_folder("copy.exr"));
        fs::rename(in_folder("copy.exr"), out);
      } else if (now != last) {
        ++saved;
      }
      last = now;
      return saved >= 3;
    };
    const Outcome outcome =
        tyndall(words, {.interrupt_after_seconds = 1e-3, .signal = signal, .wait_for = has_saved_more});
    EXPECT_EQ(outcome.status, signal == SIGKILL ? 128 + SIGKILL : 130) << outcome.err;
    EXPECT_GE(saved, 3);
    EXPECT_TRUE(read_file(in_folder("out.exr")) == read_file(whole)) << signal;
    fs::remove(in_folder("out.exr"));
  }
}

TEST_F(Plan, WrongInputIsToldNow) {
  const std::string out = in_folder("out.####.exr"), one = in_folder("out.exr");
  struct Row {
    Words options;
    int status;
    std::string told;
  };
  const Row rows[] = {
      {{}, 2, "plan wants the pictures to write: -o 'out.####.exr'"},
      {{"-o", one}, 0, ""},
      {{"-o", one, "--frames", "1..3"}, 2, "3 frames cannot all be written to"},
      {{"-o", out, "--frames", ","}, 2, "--frames: wants frames"},
      {{"-o", out, "--split", "0"}, 2, "--split: wants a whole number from 1 to 1024, not '0'"},
      {{"-o", out, "--split", "3"}, 2, "--split 3 wants as many samples of a pixel or more, and there are 2"},
      {{"-o", out, "--split", "2", "--chunk", "2"}, 2, "--chunk"},
      {{"-o", out, "--split", "2", "--error", "0.1"}, 2, "--error does not go with --split"},
      {{"-o", out, "--split", "2", "--time-limit", "9"}, 2, "--time-limit does not go with --split"},
      {{"-o", out, "--split", "2", "--sample-range", "0..0"}, 2, "--sample-range does not go with --split"},
      {{"-o", out, "--split", "2", "--stats", in_folder("s.####.json")},
       2,
       "--stats does not go with --split"},
      {{"-o", in_folder("out.####.tynpart"), "--split", "2"}, 2, "--split wants a picture to merge"},
      {{"-o", out, "--stats", in_folder("s.json")}, 2, "cannot all be written to"},
      {{"-o", out, "--movie", in_folder("m.mp4")},
       2,
       "--movie does not go with plan: no task has all frames"},
      {{"-o", out, "--overwrite"}, 2, "--overwrite does not go with plan"},
      {{"-o", out, "--json"}, 2, "--json does not go with plan"},
      {{"-o", out, "--pixel", "1,1", "--sample", "0"}, 2, "does not go with plan"},
      {{"-o", out, "--part-of", one}, 2, "--part-of"},
      {{"-o", out, "--time", "90"}, 2, "--time requires --slurm"},
      {{"-o", out, "--slurm", "--time", "2"}, 2, "--time: wants minutes or [D-]HH:MM:SS, from 3 minutes on"},
      {{"-o", out, "--slurm", "--time", "0:02:59"}, 2, "--time: wants minutes"},
      {{"-o", out, "--slurm", "--time", "1:60:00"}, 2, "--time: wants minutes"},
      {{"-o", out, "--slurm", "--memory", "8"}, 2, "--memory: wants a size"},
      {{"-o", out, "--slurm", "--cpus", "0"}, 2, "--cpus: wants a whole number from 1"},
      {{"-o", out, "--slurm", "--partition", "a b"}, 2, "--partition: wants a name"},
      {{"-o", path("none/out.####.exr")}, 1, "none"},
      {{"-o", in_folder("out.####.gif")}, 1, "gif"},
      {{"-o", in_folder("out.####.png"), "--aov", "depth"}, 2, "--aov wants an .exr"},
      {{"-o", out, "--set", "part=1 / 0"}, 1, "zero"},
      {{"-o", out, "--set", "part=1\n"}, 2, "a plan has one command a line"},
      {{"-o", out, "--crop", "0,0,99,9"}, 2, "--crop 0,0,99,9 reaches outside"},
      {{"-o", in_folder("the shot.tyn")}, 1, "the shot.tyn"},
  };
  for (const Row& row : rows) {
    const Outcome outcome = plan(row.options);
    EXPECT_EQ(outcome.status, row.status) << row.told << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(row.told), std::string::npos) << row.told << "\n" << outcome.err;
    EXPECT_EQ(outcome.out.empty(), row.status != 0) << row.told;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(path(folder_)), fs::directory_iterator()), 1);
}

// An error that one frame alone has is found, and the others are looked at, too.
TEST_F(Plan, EachFrameIsChecked) {
  file(folder_ + "/the shot.tyn",
       small_scene() +
           "animation { fps: 1 frames: 1..9 }\nsphere { center: (0, 0, 1 / (time - 4)) radius: 0.1 }\n");
  const Outcome outcome = plan({"-o", in_folder("out.####.exr")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("zero"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  file(folder_ + "/the shot.tyn", "animation { fps: 24 frames: 1..2 }\nrender { samples: 3 + frame }\n" +
                                      small_scene().substr(small_scene().find("camera")));
  const Outcome uneven = plan({"-o", in_folder("out.####.exr"), "--split", "2"});
  EXPECT_EQ(uneven.status, 2);
  EXPECT_NE(uneven.err.find("these have 4 to 5: give --samples"), std::string::npos) << uneven.err;
  EXPECT_EQ(plan({"-o", in_folder("out.####.exr"), "--split", "2", "--samples", "4"}).status, 0);
}

// The script is one of bash, and has what was asked for; tests/cluster runs it.
TEST_F(Plan, SlurmScriptsHaveWhatWasAskedFor) {
  const Outcome planned = plan({"--split", "2", "-o", in_folder("out.####.exr"), "--slurm", "--time",
                                "12:00:00", "--memory", "2GB", "--cpus", "4", "--partition", "night"});
  ASSERT_EQ(planned.status, 0) << planned.err;
  for (const std::string line :
       {"#SBATCH --requeue", "#SBATCH --open-mode=append", "#SBATCH --signal=B:USR1@60",
        "#SBATCH --time=12:00:00", "#SBATCH --mem=2097152K", "#SBATCH --partition=night"})
    EXPECT_NE(planned.out.find("\n" + line + "\n"), std::string::npos) << line << planned.out;
  for (const std::string words :
       {" --threads 4", "--cpus-per-task=4", "--dependency=aftercorr", "frames=(1 2 3)\n"})
    EXPECT_NE(planned.out.find(words), std::string::npos) << words << planned.out;
  const std::string script = file("plan.slurm", planned.out);
  EXPECT_EQ(run("/bin/bash", {"-n", script}).err, "");
  EXPECT_NE(plan({"-o", in_folder("out.####.exr"), "--slurm"}).out.find("--exclusive --mem=0"),
            std::string::npos);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
