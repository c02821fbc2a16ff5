// The parallel loop: every index once, whatever threads there are.
#include "base/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace tyndall {
namespace UNNAMED {

std::vector<int> visits(std::size_t count, int threads, int& workers) {
  std::vector<std::atomic<int>> counts(count);
  std::atomic<bool> named_well{true};
  workers = parallel_for(count, threads, [&](std::size_t index, int worker) {
    ++counts[index];
    if (worker < 0 || worker >= threads) named_well = false;
  });
  EXPECT_TRUE(named_well);
  return {counts.begin(), counts.end()};
}

TEST(Parallel, EveryIndexOnce) {
  for (const int threads : {1, 2, 7})
    for (const std::size_t count : {0, 1, 5, 1000}) {
      int workers = 0;
      EXPECT_EQ(visits(count, threads, workers), std::vector<int>(count, 1));
      EXPECT_LE(workers, threads);
      EXPECT_GE(workers, 1);
    }
}

TEST(Parallel, WhatACallThrowsIsThrownOn) {
  for (const int threads : {1, 3})
    EXPECT_THROW(parallel_for(100, threads,
                              [](std::size_t index, int) {
                                if (index == 42) throw std::runtime_error("no");
                              }),
                 std::runtime_error);
}

// A limit of address space stands for a system that has no more threads to give: stacks find no room.
TEST(Parallel, FewerThreadsDo) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "sanitizers want all addresses";
#endif
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlimit tight{pages * static_cast<std::size_t>(::getpagesize()) + (std::size_t{100} << 20),
                     before.rlim_max};
  setrlimit(RLIMIT_AS, &tight);
  int workers = 0;
  const std::vector<int> counts = visits(3000, 1000, workers);
  const bool all = can_have_threads(1000);
  setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(counts, std::vector<int>(3000, 1));
  EXPECT_LT(workers, 1000);
  EXPECT_FALSE(all);
  EXPECT_TRUE(can_have_threads(2));
}

}  // namespace
}  // namespace tyndall
