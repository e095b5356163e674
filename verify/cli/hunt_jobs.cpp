// SPDX-License-Identifier: MIT
#include "verify/cli/hunt_jobs.h"

#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <vector>

#include "verify/cli/commands.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::cli {
namespace {

struct Unmap {
  void operator()(JobCounters* counters) const { munmap(counters, sizeof *counters); }
};

std::unique_ptr<JobCounters, Unmap> shared_counters() {
  void* memory =
      mmap(nullptr, sizeof(JobCounters), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return std::unique_ptr<JobCounters, Unmap>(new (memory) JobCounters{});
}

// In the new process.
[[noreturn]] void run(int job, JobCounters& counters, const std::function<int(int, JobCounters&)>& work) {
  setpgid(0, 0);  // Ctrl-C comes to the first process, which hands it on
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  int code = kBadInput;
  try {
    code = work(job, counters);
  } catch (const std::exception& error) {
    fmt::print(stderr, "limitcheck: {}\n", error.what());
  }
  std::fflush(nullptr);
  _exit(code);
}

}  // namespace

int run_jobs(int jobs, const std::function<int(int, JobCounters&)>& work,
             const std::function<void(const JobCounters&)>& show) {
  const auto counters = shared_counters();
  std::fflush(nullptr);
  std::vector<pid_t> running;
  int code = 0;
  for (int job = 0; job < jobs; ++job) {
    const pid_t pid = fork();
    if (pid == 0) run(job, *counters, work);
    if (pid < 0) {
      fmt::print(stderr, "limitcheck: a process cannot be started: {}\n", std::strerror(errno));
      code = kBadInput;
      break;
    }
    running.push_back(pid);
  }
  bool told = false;
  while (!running.empty()) {
    if (const int signal = verify::interrupted(); signal != 0 && !told) {
      for (const pid_t pid : running) kill(pid, signal);
      told = true;
    }
    std::erase_if(running, [&](pid_t pid) {
      int status = 0;
      if (waitpid(pid, &status, WNOHANG) != pid) return false;
      code = std::max(code, WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status));
      return true;
    });
    show(*counters);
    usleep(50'000);
  }
  return code;
}

}  // namespace limitcheck::cli
