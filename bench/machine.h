// SPDX-License-Identifier: MIT
// What the machine allows and a run uses: memory that is only written, and the most that a run keeps.
#pragma once

#include <functional>
#include <span>

namespace limitcheck::bench {

/// Memory that is only written, with the widest vectors of this machine: the least time that a route needs to deliver so
/// many bytes.
///   memory      a multiple of 64 bytes, aligned to 64
///   streaming   past the caches
void write_all(std::span<float> memory, bool streaming);

/// The most bytes by which the process grows while `work` runs, measured in a child process. Call it while
/// the process has one thread; `work` must start none. 0 if it cannot be measured.
double peak_memory(const std::function<void()>& work);

}  // namespace limitcheck::bench
