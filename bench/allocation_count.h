// SPDX-License-Identifier: MIT
// Counts exactly what a piece of work asks of the allocator: every operator new, malloc, calloc, realloc and
// aligned allocation of the process passes here.
#pragma once

#include <cstdint>
#include <functional>

namespace limitcheck::bench {

struct Allocations {
  std::int64_t count = 0;  ///< blocks asked for
  std::int64_t kept = 0;   ///< bytes asked for and not yet freed; of this work's blocks alone
  std::int64_t peak = 0;   ///< largest value that `kept` had
};

/// Of all threads, while work runs. One at a time.
Allocations count_allocations(const std::function<void()>& work);

}  // namespace limitcheck::bench
