// SPDX-License-Identifier: MIT
// Work in several processes, which nothing but files and counters connects.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace limitcheck::cli {

/// In memory that all processes share.
struct JobCounters {
  std::atomic<std::uint64_t> cases, findings, kinds;
};

/// Runs work(0) .. work(jobs - 1), each in a process of its own, and waits; calls `show` about ten times a
/// second. A signal that is noted (interrupt.h) is handed on to all. To be called before this process has
/// threads. Returns the largest exit code, or 128 plus the number of the signal that killed one of them.
///   work   returns its exit code; ends by itself when it is interrupted. The processes end with this one.
int run_jobs(int jobs, const std::function<int(int, JobCounters&)>& work,
             const std::function<void(const JobCounters&)>& show);

}  // namespace limitcheck::cli
