// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

namespace limitcheck::verify {

/// Calls body(begin, end) for ranges that make up [0, faces), on at most `threads` threads at a time; with
/// one thread, once and on the caller's. The ranges, and which thread takes which, are not determined: a body
/// writes only what depends on the face alone, to places that depend on the face alone.
template <class Body>
void faces_in_parallel(std::int64_t faces, int threads, const Body& body) {
  // More than oneTBB has would only earn a warning on standard error.
  using tbb::global_control;
  threads = std::min(threads,
                     static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism)));
  if (threads <= 1) {
    body(std::int64_t{0}, faces);
    return;
  }
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, faces),
                      [&](const auto& range) { body(range.begin(), range.end()); });
  });
}

}  // namespace limitcheck::verify
