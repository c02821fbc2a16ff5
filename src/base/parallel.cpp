#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace tyndall {

int hardware_threads() { return tbb::info::default_concurrency(); }

int worker_count(int threads) { return threads > 0 ? threads : hardware_threads(); }

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t, int)>& body) {
  // More workers than the hardware has threads are allowed: results may not depend on their number.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(worker_count(threads)));
  tbb::task_arena arena(worker_count(threads));
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, count,
        [&](std::size_t index) { body(index, tbb::this_task_arena::current_thread_index()); },
        tbb::simple_partitioner{});
  });
}

}  // namespace tyndall
