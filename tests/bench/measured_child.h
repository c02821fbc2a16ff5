// Runs work in a process of its own, so that its memory and time are its own too.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

inline constexpr std::size_t max_laps = 6;

// What a child used. CPU time is that of all its threads: what else the machine does hardly changes it.
struct Cost {
  std::array<double, max_laps> lap_cpu_seconds{};  // between the marks that the work set
  std::size_t laps = 0;
  double cpu_seconds = 0;
  double wall_seconds = 0;
  double peak_bytes = 0;      // most memory resident at a time, the program's own included
  double resident_bytes = 0;  // when the work ended, with what it still holds
};

inline double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

// CPU seconds of this process so far.
inline double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Bytes of this process that are in memory now.
inline double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Given to the work: mark() ends a lap.
class Laps {
 public:
  explicit Laps(Cost& cost) : cost_(cost), last_(cpu_seconds()) {}
  void mark() {
    const double now = cpu_seconds();
    cost_.lap_cpu_seconds[cost_.laps++] = now - last_;
    last_ = now;
  }
  // To be called while what the work made is still alive.
  void measure_memory() { cost_.resident_bytes = resident_bytes(); }

 private:
  Cost& cost_;
  double last_;
};

// Nothing when the child failed. The parent must have one thread only.
inline std::optional<Cost> measured_in_child(const std::function<bool(Laps&)>& work) {
  int channel[2];
  if (pipe(channel) != 0) return std::nullopt;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    Cost cost;
    const double cpu_before = cpu_seconds();
    const auto begin = std::chrono::steady_clock::now();
    Laps laps(cost);
    const bool good = work(laps);
    cost.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    cost.cpu_seconds = cpu_seconds() - cpu_before;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    cost.peak_bytes = static_cast<double>(usage.ru_maxrss) * 1024;
    const bool sent = good && write(channel[1], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost);
    std::_Exit(sent ? 0 : 1);
  }
  close(channel[1]);
  Cost cost;
  const bool received = read(channel[0], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost);
  close(channel[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!received || status != 0) return std::nullopt;
  return cost;
}

// CPU seconds that a run of an executable takes, its output unseen; nothing when it fails.
inline std::optional<double> measured_program(const std::string& executable,
                                              const std::vector<std::string>& arguments) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    std::vector<char*> words{const_cast<char*>(executable.c_str())};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    if (std::freopen("/dev/null", "w", stdout) != nullptr) execv(executable.c_str(), words.data());
    std::_Exit(1);
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0) return std::nullopt;
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace tyndall
