// SPDX-License-Identifier: MIT
// One small piece of work, once, for callgrind to count the instructions of; nothing before or after it is
// counted.
//   valgrind --tool=callgrind --collect-atstart=no instruction_case CASE
// Without an argument: the build, then the names of the cases. Callgrind knows no AVX-512, so AVX2 is the
// widest target.
#include <hwy/nanobenchmark.h>
#include <valgrind/callgrind.h>

#include <cstdint>
#include <cstdio>

#include "bench/cases/tracked.h"

// Highway's library measures this when it is loaded, by RDTSCP: valgrind says that there is such an instruction and, on a
// processor without it, ends. Nothing here reads a clock.
std::uint64_t hwy::platform::TimerResolution() {
  return 1;
}

int main(int argc, char** argv) {
  using namespace limitcheck;
  if (argc < 2) std::puts(bench::build_identity().c_str());
  for (const bench::Tracked& one : bench::tracked_cases()) {
    if (one.counted.empty()) continue;
    if (argc < 2) std::puts(one.counted.c_str());
    if (argc < 2 || one.counted != argv[1]) continue;
    const auto work = one.make(bench::Way::kCounted);
    CALLGRIND_TOGGLE_COLLECT;
    work();
    CALLGRIND_TOGGLE_COLLECT;
    return 0;
  }
  if (argc < 2) return 0;
  std::fprintf(stderr, "instruction_case: there is no case '%s'\n", argv[1]);
  return 2;
}
