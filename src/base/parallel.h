// Parallel loops. The only place where threads are made. A library's pool would end the program where a
// thread cannot be had; here the work is done by those that can.
#pragma once

#include <cstddef>
#include <functional>

namespace tyndall {

// Threads that parallel_for would use for `threads` = 0.
int hardware_threads();

// Calls body(index, worker) for every index in [0, count), in any order; `worker` in [0, workers) names the
// scratch that this call may use alone. threads: 0 for all; fewer take part when the system has no more to
// give. What a call throws ends the loop and is thrown on. Returns when all calls have returned: how many
// workers took part.
int parallel_for(std::size_t count, int threads,
                 const std::function<void(std::size_t index, int worker)>& body);

// Whether the system would give so many threads, now.
bool can_have_threads(int count);

// How many workers parallel_for(count, threads, …) wants, and so may number.
int loop_workers(std::size_t count, int threads);

}  // namespace tyndall
