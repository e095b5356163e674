// SPDX-License-Identifier: MIT
#include "verify/interrupt/interrupt.h"

#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
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

namespace {

constexpr std::chrono::milliseconds kLook{20};

// What the two threads share; the one that is left keeps it.
struct Shared {
  std::mutex mutex;
  std::condition_variable ended;
  bool has_ended = false;
  std::exception_ptr error;
};

}  // namespace

bool run_or_abandon(std::function<void()> work, std::chrono::milliseconds to_end) {
  const auto shared = std::make_shared<Shared>();
  std::optional<std::thread> thread;
  try {
    thread.emplace([shared, work] {
      std::exception_ptr error;
      try {
        work();
      } catch (...) {
        error = std::current_exception();
      }
      const std::scoped_lock lock(shared->mutex);
      shared->has_ended = true;
      shared->error = error;
      shared->ended.notify_all();
    });
  } catch (const std::system_error&) {  // there are no more threads to be had
    work();
    return true;
  }
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> until;
  std::unique_lock lock(shared->mutex);
  while (!shared->ended.wait_for(lock, kLook, [&] { return shared->has_ended; })) {
    if (interrupted() == 0) continue;
    if (!until) until = Clock::now() + to_end;
    if (Clock::now() < *until) continue;
    thread->detach();
    return false;
  }
  lock.unlock();
  thread->join();
  if (shared->error) std::rethrow_exception(shared->error);
  return true;
}

void leave(int exit_code, int unwritten) {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  std::fflush(stderr);
  std::_Exit(written ? exit_code : unwritten);
}

}  // namespace limitcheck::verify
