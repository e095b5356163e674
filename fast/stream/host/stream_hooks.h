// SPDX-License-Identifier: MIT
// What the states of StreamTessellator have in common beyond those of other engines.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

namespace limitcheck::fast::row_stream {

struct StreamHooks {
  std::function<void(std::size_t done, std::size_t total)> progress;
  std::size_t worker_bytes = 0;

  /// Evaluates batches 0 .. count - 1 in parallel, by one of the workers for each thread of the arena, which
  /// are kept from frame to frame: run(worker, b) returns how many of `total` it has done.
  template <class Worker, class Run>
  void run_batches(tbb::task_arena& arena, std::vector<Worker>& workers, std::size_t count, std::size_t total,
                   Run&& run) {
    if (workers.empty()) workers.resize(static_cast<std::size_t>(arena.max_concurrency()));
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t b) {
        const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
        const std::size_t here = run(workers[thread], b);
        const std::size_t finished = done += here;
        if (progress && telling.try_lock()) {
          progress(finished, total);
          telling.unlock();
        }
      });
    });
    for (const Worker& worker : workers) worker_bytes = std::max(worker_bytes, worker.bytes());
  }

 protected:
  ~StreamHooks() = default;
};

}  // namespace limitcheck::fast::row_stream
