// `tyndall plan` in the hands of those that run it: GNU parallel, and Slurm on a cluster that the test
// starts. Whatever happens to tasks and machines, each frame ends as the one that is rendered alone, byte for
// byte.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>
#include <thread>
#include <tuple>

#include "cli/run_program.h"
#include "cluster/slurm.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// A task that runs: its process, the job's number and the part or frame that it makes.
struct Running {
  pid_t process = 0;
  std::string job, node, frame, output;
};

std::string variable(const std::string& environment, const std::string& name) {
  const std::size_t at = ('\0' + environment).find('\0' + name + '=');
  return at == std::string::npos ? std::string() : std::string(environment.c_str() + at + name.size() + 1);
}

class Cluster : public CliTest {
 protected:
  void SetUp() override {
    if (const std::string missing = SlurmCluster::what_is_missing(); !missing.empty())
      GTEST_SKIP() << missing;
    CliTest::SetUp();
    fs::create_directory(path("slurm"));
    fs::create_directory(path("the shot's"));
    scene_ = file("the shot's/a b.tyn", small_scene() +
                                            "animation { fps: 24 frames: 1..4 }\n"
                                            "sphere { center: (time, 0, 0) radius: 0.1 }\n");
    slurm_ = std::make_unique<SlurmCluster>(path("slurm"));
    ASSERT_EQ(slurm_->start(), "");
  }
  void TearDown() override {
    slurm_.reset();
    if (!IsSkipped()) CliTest::TearDown();
  }

  std::string in_shot(const std::string& name) const { return path("the shot's/" + name); }

  // Plans with these options, and submits.
  void submit(const Words& options) {
    Words words{"plan", scene_, "--slurm", "-o", in_shot("out.####.exr")};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome planned = tyndall(words);
    ASSERT_EQ(planned.status, 0) << planned.err;
    script_ = file("plan.slurm", planned.out);
    submit_again();
  }
  void submit_again() {
    const Outcome outcome = slurm_->shell("bash '" + script_ + "'");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ASSERT_TRUE(outcome.out.starts_with("submitted as ")) << outcome.out;
  }

  // The tasks of this test that run now.
  std::vector<Running> running() const {
    std::vector<Running> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string folder = entry.path().string();
      std::error_code gone;
      if (fs::read_symlink(folder + "/exe", gone) != fs::path(TYNDALL_PROGRAM)) continue;
      const std::string environment = read_file(folder + "/environ"), words = read_file(folder + "/cmdline");
      if (variable(environment, "SLURM_CONF") != path("slurm/slurm.conf")) continue;
      const auto after = [&](const std::string& option) {
        const std::size_t at = words.find('\0' + option + '\0');
        return at == std::string::npos ? std::string() : std::string(words.c_str() + at + option.size() + 2);
      };
      Running task{std::stoi(entry.path().filename()), variable(environment, "SLURM_JOB_ID"),
                   variable(environment, "SLURMD_NODENAME"), after("--frame"), after("-o")};
      if (const std::size_t mark = task.output.find("####"); mark != std::string::npos && !task.frame.empty())
        task.output.replace(mark, 4, "000" + task.frame);
      found.push_back(std::move(task));
    }
    return found;
  }

  // Slurm lets tasks that are queued again wait for two minutes: not here.
  void start_what_waits(const std::string& queue) const {
    std::istringstream lines(queue);
    for (std::string line; std::getline(lines, line);)
      if (line.find("(BeginTime)") != std::string::npos || line.find("(None)") != std::string::npos)
        slurm_->shell("scontrol update StartTime=now JobId=" + line.substr(0, line.find(' ')));
  }

  // Waits for a task that is in the middle of its work, and does something to it.
  void meddle(const std::function<void(const Running&)>& act) const {
    for (const auto end = Clock::now() + 60s; Clock::now() < end; std::this_thread::sleep_for(50ms)) {
      for (const Running& task : running())
        if (fs::exists(task.output + ".checkpoint")) {
          act(task);
          return wait_until_it_is_told(task);
        }
      if (running().empty()) start_what_waits(slurm_->queue());
    }
    FAIL() << "no task is in the middle of its work\n" << slurm_->queue() << task_logs();
  }

  // Waits until a signal has reached a task, or a little if it is to live on.
  static void wait_until_it_is_told(const Running& task) {
    for (int i = 0; i < 40 && ::kill(task.process, 0) == 0; ++i) std::this_thread::sleep_for(50ms);
  }

  // Waits until no job is left.
  void wait_for_end() const {
    for (const auto end = Clock::now() + 180s; Clock::now() < end; std::this_thread::sleep_for(500ms)) {
      const std::string queue = slurm_->queue();
      if (queue.empty()) return;
      start_what_waits(queue);
    }
    FAIL() << "jobs did not end\n" << slurm_->queue() << task_logs() << slurm_->logs();
  }

  std::string task_logs() const {
    std::string text;
    for (const auto& entry : fs::directory_iterator(in_shot("logs")))
      text += fmt::format("--- {}\n{}", entry.path().filename().string(), read_file(entry.path().string()));
    return text;
  }

  void expect_frames_as_alone(const Words& options) const {
    for (int frame = 1; frame <= 4; ++frame) {
      Words words{"render", scene_, "--frame", std::to_string(frame), "-o", in_shot("alone.exr")};
      words.insert(words.end(), options.begin(), options.end());
      ASSERT_EQ(tyndall(words).status, 0);
      EXPECT_TRUE(read_file(in_shot(fmt::format("out.{:04}.exr", frame))) == read_file(in_shot("alone.exr")))
          << frame << "\n"
          << task_logs();
    }
  }

  std::string scene_, script_;
  std::unique_ptr<SlurmCluster> slurm_;
};

// About two seconds of work for half of a frame. Four frames are more than an array of this cluster takes.
const Words setting{"--resolution", "96x72", "--samples", "200", "--checkpoint-interval", "0.1"};

TEST_F(Cluster, FramesSurviveKilledTasksAndLostMachines) {
  Words options = setting;
  options.insert(options.end(), {"--split", "2", "--cpus", "1", "--time", "10", "--memory", "256MB"});
  submit(options);
  std::string killed, late, lost;
  meddle([&](const Running& task) {
    killed = task.output;
    ::kill(task.process, SIGKILL);
  });
  meddle([&](const Running& task) { slurm_->shell("scontrol requeue " + task.job); });
  meddle([&](const Running& task) {
    late = task.output;
    slurm_->shell("scancel --batch --signal=USR1 " + task.job);  // what Slurm does before the time limit
  });
  // The machine is lost for Slurm, but its tasks go on: each then runs twice.
  meddle([&](const Running& task) {
    lost = task.node;
    slurm_->kill_node(lost);
    slurm_->shell("scontrol update State=DOWN Reason=lost NodeName=" + lost);
    EXPECT_EQ(::kill(task.process, 0), 0) << "the task lives on";
    const std::string job = slurm_->shell("scontrol show job " + task.job).out;
    EXPECT_NE(job.find("JobState=PENDING"), std::string::npos) << job;
    EXPECT_EQ(job.find("Restarts=0"), std::string::npos) << job;
  });
  wait_for_end();
  slurm_->start_node(lost);
  const std::string told = task_logs();
  EXPECT_NE(told.find("ended with status 137, is queued again"), std::string::npos) << killed << told;
  EXPECT_NE(told.find("ended with status 130, is queued again"), std::string::npos) << late << told;
  EXPECT_NE(told.find("rendering goes on from there"), std::string::npos) << told;
  expect_frames_as_alone({"--resolution", "96x72", "--samples", "200"});

  // All of it once more does nothing.
  const auto written = fs::last_write_time(in_shot("out.0003.exr"));
  submit_again();
  wait_for_end();
  EXPECT_EQ(fs::last_write_time(in_shot("out.0003.exr")), written);
  for (const auto& entry : fs::directory_iterator(in_shot(".")))
    EXPECT_NE(entry.path().extension(), ".tynpart") << entry.path() << task_logs();
}

TEST_F(Cluster, TasksMayHaveSeveralWholeFrames) {
  submit({"--chunk", "3"});  // each on a machine of its own
  wait_for_end();
  expect_frames_as_alone({});
}

// The comments of a plan say how GNU parallel runs it: that is done.
class GnuParallel : public CliTest {};
TEST_F(GnuParallel, RunsPlansAsTheirCommentsSay) {
  if (run("/bin/sh", {"-c", "parallel --version"}).status != 0)
    GTEST_SKIP() << "GNU parallel is not installed: apt-get install parallel";
  fs::create_directory(path("it's a $HOME"));
  const std::string scene = file("it's a $HOME/a b.tyn", small_scene()),
                    output = path("it's a $HOME/out.##.exr");
  for (const auto& [option, number, lines] :
       {std::tuple("--split", "2", "head -n 6"), std::tuple("--chunk", "1", "parallel")}) {
    const Outcome planned = tyndall({"plan", scene, "--frames", "-1..1", option, number, "-o", output});
    ASSERT_EQ(planned.status, 0) << planned.err;
    // From the first command to the line that is no comment.
    const std::size_t begin = planned.out.find("grep -v"), end = planned.out.find("\n/", begin);
    ASSERT_TRUE(begin < end && end != std::string::npos) << planned.out;
    std::string command = planned.out.substr(begin, end - begin);
    EXPECT_NE(command.find(lines), std::string::npos) << command;
    for (std::size_t at; (at = command.find("\n#")) != std::string::npos;) command.replace(at, 2, "");
    for (std::size_t at; (at = command.find("THIS_FILE")) != std::string::npos;)
      command.replace(at, 9, "'" + file("plan.sh", planned.out) + "'");
    const Outcome made = run("/bin/sh", {"-c", command});
    EXPECT_EQ(made.status, 0) << command << made.out << made.err;
    for (const auto& [frame, name] : {std::pair("-1", "-1"), std::pair("0", "00"), std::pair("1", "01")}) {
      const std::string picture = path(std::string("it's a $HOME/out.") + name + ".exr");
      ASSERT_EQ(tyndall({"render", scene, "--frame", frame, "-o", path("alone.exr")}).status, 0);
      EXPECT_TRUE(read_file(picture) == read_file(path("alone.exr"))) << frame;
      fs::remove(picture);
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
