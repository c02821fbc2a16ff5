#include "base/parallel.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace tyndall {
namespace {

// Starts up to `count` threads that run body(0), body(1), …: as many as the system has room for.
std::vector<std::thread> start_threads(int count, const std::function<void(int)>& body) {
  std::vector<std::thread> threads;
  try {
    threads.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) threads.emplace_back(body, i);
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  return threads;
}

}  // namespace

int hardware_threads() {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(CPU_COUNT(&allowed), 1);
  return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

int loop_workers(std::size_t count, int threads) {
  const auto most = static_cast<std::size_t>(threads > 0 ? threads : hardware_threads());
  return static_cast<int>(std::clamp<std::size_t>(count, 1, most));
}

bool can_have_threads(int count) {
  std::atomic<bool> go{false};
  std::vector<std::thread> threads = start_threads(count, [&go](int) { go.wait(false); });
  const bool all = threads.size() == static_cast<std::size_t>(count);
  go = true;
  go.notify_all();
  for (std::thread& thread : threads) thread.join();
  return all;
}

int parallel_for(std::size_t count, int threads, const std::function<void(std::size_t, int)>& body) {
  const int workers = loop_workers(count, threads);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&](int worker) {
    try {
      for (std::size_t index; (index = next.fetch_add(1)) < count;) body(index, worker);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others = start_threads(workers - 1, [&work](int i) { work(i + 1); });
  work(0);
  for (std::thread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
  return 1 + static_cast<int>(others.size());
}

}  // namespace tyndall
