#include "cluster/slurm.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// A port that is free now.
int free_port() {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool good = ::bind(descriptor, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                    ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  ::close(descriptor);
  return good ? ntohs(address.sin_port) : 0;
}

void write_key(const std::string& path) {
  std::random_device random;
  {
    std::ofstream key(path, std::ios::binary);
    for (int i = 0; i < 1024; ++i) key.put(static_cast<char>(random()));
  }
  fs::permissions(path, fs::perms::owner_read);
}

std::string configuration(const std::string& folder, const std::string& host, const std::string& user) {
  std::string text = fmt::format(R"(ClusterName=tyndall
SlurmctldHost={1}(127.0.0.1)
SlurmctldPort={3}
SlurmUser={2}
SlurmdUser={2}
AuthType=auth/munge
AuthInfo=socket={0}/munge.socket
CredType=cred/munge
StateSaveLocation={0}/state
SlurmdSpoolDir={0}/spool-%n
SlurmctldPidFile={0}/slurmctld.pid
SlurmdPidFile={0}/%n.pid
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=bf_interval=1,sched_interval=2
SlurmdTimeout=5
KillWait=10
ReturnToService=2
JobRequeue=1
MaxArraySize=3
)",
                                 folder, host, user, free_port());
  for (const char* node : {"one", "two"})
    text += fmt::format(
        "NodeName={} NodeHostname={} NodeAddr=127.0.0.1 Port={} CPUs=2 RealMemory=2048 State=UNKNOWN\n", node,
        host, free_port());
  return text + "PartitionName=all Nodes=ALL Default=YES State=UP MaxTime=INFINITE\n";
}

std::string first_line(const std::string& command) {
  const std::string out = run("/bin/sh", {"-c", command}).out;
  return out.substr(0, out.find('\n'));
}

// Waits for a child to end, at most so long.
bool ends_within(pid_t child, Clock::duration time) {
  for (const auto end = Clock::now() + time; Clock::now() < end; std::this_thread::sleep_for(20ms))
    if (::waitpid(child, nullptr, WNOHANG) != 0) return true;
  return false;
}

// The processes whose parent is this one: daemons, and what has lost its parent below them.
std::vector<pid_t> children() {
  std::vector<pid_t> found;
  std::istringstream out(read_file(fmt::format("/proc/self/task/{}/children", ::getpid())));
  for (pid_t child = 0; out >> child;) found.push_back(child);
  return found;
}

}  // namespace

SlurmCluster::SlurmCluster(std::string folder) : folder_(std::move(folder)) {
  // Daemons' children that outlive them become ours, so that they can be ended.
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
}

SlurmCluster::~SlurmCluster() {
  if (daemons_.contains("slurmctld")) {
    shell(
        "timeout 10 scancel --full --signal=KILL --user=\"$(id -un)\"; timeout 10 scancel --user=\"$(id "
        "-un)\"");
    for (int i = 0; i < 50 && !queue().empty(); ++i) std::this_thread::sleep_for(100ms);
  }
  for (const auto& [name, daemon] : daemons_) ::kill(daemon, SIGTERM);
  for (const auto& [name, daemon] : daemons_)
    if (!ends_within(daemon, 5s)) ::kill(daemon, SIGKILL);
  for (const auto end = Clock::now() + 10s; Clock::now() < end && !children().empty();) {
    for (const pid_t child : children()) ::kill(child, SIGKILL);
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    std::this_thread::sleep_for(20ms);
  }
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

std::string SlurmCluster::what_is_missing() {
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel"})
    if (first_line(fmt::format("PATH=$PATH:/usr/sbin:/sbin; command -v {}", program)).empty())
      return fmt::format("{} is not installed: apt-get install slurm-wlm munge", program);
  return {};
}

pid_t SlurmCluster::start_daemon(const std::string& name, const std::vector<std::string>& command) {
  const pid_t child = ::fork();
  if (child != 0) return daemons_[name] = child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // whatever ends the test ends the daemon
  const int log = ::open((folder_ + "/" + name + ".log").c_str(), O_CREAT | O_APPEND | O_WRONLY, 0644);
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::setenv("SLURM_CONF", (folder_ + "/slurm.conf").c_str(), 1);
  ::setenv("PATH", (std::string(std::getenv("PATH")) + ":/usr/sbin:/sbin").c_str(), 1);
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

std::string SlurmCluster::start() {
  fs::permissions(folder_, fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  fs::create_directory(folder_ + "/state");
  write_key(folder_ + "/munge.key");
  std::ofstream(folder_ + "/slurm.conf")
      << configuration(folder_, first_line("hostname -s"), first_line("id -un"));
  start_daemon("munged", {"munged", "--foreground", "--force", "--key-file=" + folder_ + "/munge.key",
                          "--socket=" + folder_ + "/munge.socket", "--pid-file=" + folder_ + "/munged.pid",
                          "--seed-file=" + folder_ + "/munge.seed", "--log-file=" + folder_ + "/munged.log"});
  for (int i = 0; i < 100 && !fs::exists(folder_ + "/munge.socket"); ++i) std::this_thread::sleep_for(50ms);
  start_daemon("slurmctld", {"slurmctld", "-D"});
  for (const char* node : {"one", "two"}) start_node(node);
  for (int i = 0; i < 150; ++i) {
    if (shell("sinfo -h -t idle -o %D").out == "2\n") return {};
    std::this_thread::sleep_for(200ms);
  }
  return "the nodes did not come up:\n" + logs();
}

void SlurmCluster::start_node(const std::string& node) { start_daemon(node, {"slurmd", "-D", "-N", node}); }

void SlurmCluster::kill_node(const std::string& node) {
  ::kill(daemons_.at(node), SIGKILL);
  ::waitpid(daemons_.at(node), nullptr, 0);
  daemons_.erase(node);
}

Outcome SlurmCluster::shell(const std::string& command) const {
  return run("/bin/bash", {"-c", command}, {.environment = {"SLURM_CONF=" + folder_ + "/slurm.conf"}});
}

std::string SlurmCluster::queue() const { return shell("timeout 10 squeue -h -r -o '%i %j %T %R'").out; }

std::string SlurmCluster::logs() const {
  std::string text;
  for (const char* name : {"munged", "slurmctld", "one", "two"})
    text += fmt::format("--- {}\n{}", name, read_file(folder_ + "/" + name + ".log"));
  return text;
}

}  // namespace tyndall::test
