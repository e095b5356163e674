// SPDX-License-Identifier: MIT
// Times one case on request, so that two builds, each in a process of its own, can take turns of a few
// milliseconds and share the same conditions on a busy machine.
//   timing_turns          the build, then the names of the cases
//   timing_turns CASE     makes the case ready and runs it once
//   timing_turns --serve  reads "REPETITIONS CASE" lines; answers each with the nanoseconds of processor
//                         time per run, one number per repetition of about two milliseconds, or "? CASE"
//                         if there is no such case
#include <cstdio>
#include <ctime>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <utility>

#include "bench/cases/tracked.h"

namespace {

using namespace limitcheck;

/// The cases that are timed, by name.
std::map<std::string, bench::Tracked> cases() {
  std::map<std::string, bench::Tracked> list;
  for (bench::Tracked& one : bench::tracked_cases())
    if (!one.timed.empty()) list.emplace(one.timed, std::move(one));
  return list;
}

double processor_nanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

double timed(const std::function<void()>& work, int runs) {
  const double start = processor_nanoseconds();
  for (int k = 0; k < runs; ++k) work();
  return (processor_nanoseconds() - start) / runs;
}

struct Ready {
  std::function<void()> work;
  int runs = 1;  // that take about two milliseconds
};

Ready make_ready(const bench::Tracked& one) {
  Ready ready{one.make(bench::Way::kTimed)};
  const double nanoseconds = timed(ready.work, 1);
  ready.runs = nanoseconds < 2e6 ? static_cast<int>(2e6 / nanoseconds) + 1 : 1;
  return ready;
}

void serve() {
  const auto list = cases();
  std::map<std::string, Ready> ready;
  int repetitions = 0;
  for (std::string name; std::cin >> repetitions && std::getline(std::cin >> std::ws, name);) {
    const auto found = list.find(name);
    if (found == list.end()) {
      std::cout << "? " << name << std::endl;
      continue;
    }
    auto at = ready.find(name);
    if (at == ready.end()) at = ready.emplace(name, make_ready(found->second)).first;
    for (int k = 0; k < repetitions; ++k)
      std::cout << (k > 0 ? " " : "") << timed(at->second.work, at->second.runs);
    std::cout << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--serve") {
    serve();
    return 0;
  }
  const auto list = cases();
  if (argc > 1) {
    const auto found = list.find(argv[1]);
    if (found == list.end()) {
      std::fprintf(stderr, "timing_turns: there is no case '%s'\n", argv[1]);
      return 2;
    }
    found->second.make(bench::Way::kTimed)();
    return 0;
  }
  std::puts(bench::build_identity().c_str());
  for (const auto& [name, one] : list) std::puts(name.c_str());
  return 0;
}
