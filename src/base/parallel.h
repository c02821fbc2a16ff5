// Parallel loops. The only place where threads are made (oneTBB, in parallel.cpp).
#pragma once

#include <cstddef>
#include <functional>

namespace tyndall {

// Threads that parallel_for would use for `threads` = 0.
int hardware_threads();

// Calls body(index, worker) for every index in [0, count), in any order; `worker` in [0, workers) names the
// scratch that this call may use alone. threads: 0 for all. Returns when all calls have returned.
void parallel_for(std::size_t count, int threads,
                  const std::function<void(std::size_t index, int worker)>& body);

// How many workers parallel_for(…, threads, …) may number.
int worker_count(int threads);

}  // namespace tyndall
