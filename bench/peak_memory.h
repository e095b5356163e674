// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace limitcheck::bench {

/// Bytes of memory by which the process grows at most while `work` runs: done in a child process, so that
/// nothing of it stays. Call it while the process has one thread, and let `work` start none. 0 if it cannot
/// be had.
double peak_memory(const std::function<void()>& work);

}  // namespace limitcheck::bench
