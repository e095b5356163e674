// SPDX-License-Identifier: MIT
#include "verify/shared_bits/test_support/profile.h"

#include <dlfcn.h>
#include <sys/time.h>
#include <ucontext.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <memory>

namespace limitcheck::verify {

namespace {

// By address in the file, from the program's own symbol table.
const std::map<std::uintptr_t, std::string>& functions() {
  static const std::map<std::uintptr_t, std::string> all = [] {
    std::map<std::uintptr_t, std::string> list;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
        popen("nm -C --defined-only \"/proc/$PPID/exe\" 2>/dev/null", "r"), pclose);
    if (!pipe) return list;
    char* line = nullptr;
    std::size_t room = 0;
    while (getline(&line, &room, pipe.get()) > 0) {
      std::string text(line);
      const std::size_t kind = text.find(' ');
      if (kind == std::string::npos || kind + 3 > text.size()) continue;
      if (std::string("tTwW").find(text[kind + 1]) == std::string::npos) continue;
      text.pop_back();  // the line's end
      list[std::strtoull(line, nullptr, 16)] = text.substr(kind + 3);
    }
    std::free(line);
    return list;
  }();
  return all;
}

std::uintptr_t load_address() {
  Dl_info info{};
  return dladdr(reinterpret_cast<const void*>(&load_address), &info) != 0
             ? reinterpret_cast<std::uintptr_t>(info.dli_fbase)
             : 0;
}

constexpr std::size_t kMostSamples = 1 << 16;
std::array<std::uintptr_t, kMostSamples> samples;
std::atomic<std::size_t> sample_count{0};

void take_sample(int, siginfo_t*, void* context) {
  const auto* where = static_cast<const ucontext_t*>(context);
  const std::size_t at = sample_count.fetch_add(1, std::memory_order_relaxed);
#if defined(__x86_64__)
  if (at < kMostSamples) samples[at] = static_cast<std::uintptr_t>(where->uc_mcontext.gregs[REG_RIP]);
#endif
}

}  // namespace

std::string function_at(std::uintptr_t address) {
  Dl_info info{};
  // Not in this program: a shared library.
  if (dladdr(reinterpret_cast<const void*>(address), &info) == 0) return "";
  const std::uintptr_t base = load_address();
  if (reinterpret_cast<std::uintptr_t>(info.dli_fbase) != base) return "";
  const auto after = functions().upper_bound(address - base);
  return after == functions().begin() ? "" : std::prev(after)->second;
}

std::map<std::string, int> profile(const std::function<void()>& work, const std::string& part, int least,
                                   double most) {
  functions();  // read beforehand
  struct sigaction action {};
  struct sigaction before {};
  action.sa_sigaction = &take_sample;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  sigaction(SIGPROF, &action, &before);
  const itimerval interval{{0, 500}, {0, 500}}, never{};

  std::map<std::string, int> found;
  int hits = 0;
  const std::clock_t start = std::clock();
  do {
    sample_count = 0;
    // A timer that is set anew ticks first after one or two of the system's ticks of 1 to 10 ms: pieces of work
    // that are shorter would never be seen.
    const std::clock_t turn = std::clock();
    setitimer(ITIMER_PROF, &interval, nullptr);
    do {
      work();
    } while (static_cast<double>(std::clock() - turn) < .2 * CLOCKS_PER_SEC);
    setitimer(ITIMER_PROF, &never, nullptr);
    const std::size_t count = std::min<std::size_t>(sample_count, kMostSamples);
    for (std::size_t k = 0; k < count; ++k) {
      const std::string name = function_at(samples[k]);
      ++found[name];
      hits += name.find(part) != std::string::npos;
    }
  } while (hits < least && static_cast<double>(std::clock() - start) < most * CLOCKS_PER_SEC);
  sigaction(SIGPROF, &before, nullptr);
  return found;
}

}  // namespace limitcheck::verify
