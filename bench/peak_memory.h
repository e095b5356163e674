// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace limitcheck::bench {

/// The most bytes by which the process grows while `work` runs, measured in a child process. Call it while
/// the process has one thread; `work` must start none. 0 if it cannot be measured.
double peak_memory(const std::function<void()>& work);

}  // namespace limitcheck::bench
