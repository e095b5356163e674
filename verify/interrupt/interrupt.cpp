// SPDX-License-Identifier: MIT
#include "verify/interrupt/interrupt.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace limitcheck::verify {
namespace {

constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<int> noted{0};
static_assert(std::atomic<int>::is_always_lock_free, "the handler may touch nothing else");

extern "C" void note(int signal) {
  noted.store(signal, std::memory_order_relaxed);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  noted = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  noted = 0;
}

int interrupted() noexcept {
  return noted.load(std::memory_order_relaxed);
}

std::string signal_name(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "SIGHUP";
}

bool run_or_abandon(std::function<void()> work, std::chrono::milliseconds to_end) {
  std::packaged_task<void()> task(work);
  std::future<void> ended = task.get_future();
  std::thread thread;
  try {
    thread = std::thread(std::move(task));
  } catch (const std::system_error&) {  // there are no more threads to be had
    work();
    return true;
  }
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> until;
  while (ended.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
    if (interrupted() == 0) continue;
    if (!until) until = Clock::now() + to_end;
    if (Clock::now() < *until) continue;
    thread.detach();
    return false;
  }
  thread.join();
  ended.get();  // exceptions pass on
  return true;
}

void leave(int exit_code, int unwritten) {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  std::fflush(stderr);
  std::_Exit(written ? exit_code : unwritten);
}

}  // namespace limitcheck::verify
