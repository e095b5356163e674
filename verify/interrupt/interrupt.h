// SPDX-License-Identifier: MIT
// Ending early on a signal, with the results so far.
// Work that may be left where it is when a signal comes.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <string>

namespace limitcheck::verify {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is noted and nothing more; a second one of the same
/// kind takes its usual course and ends the process. Signals that were ignored stay ignored. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  std::array<struct sigaction, 3> before_{};
};

/// The number of the signal noted, or 0. Safe, and cheap, in any thread and inner loop.
int interrupted() noexcept;

/// "SIGINT", "SIGTERM", "SIGHUP".
std::string signal_name(int signal);

/// Thrown where long work cannot end in another way. It is not a std::exception, because code that turns
/// those into faults of the subject must not catch it.
struct Interrupted {};

inline void end_if_interrupted() {
  if (interrupted() != 0) throw Interrupted();
}

/// How long work that a signal interrupts may go on, to end in good order.
inline constexpr std::chrono::milliseconds kToEnd{300};

/// Runs `work` on a thread of its own and waits for it; exceptions pass on. If a signal is noted
/// (interrupt.h) and the work has not ended so long after, it is left: the answer is false, and the work goes
/// on. All that it uses must then live as long as the process, which `leave` ends.
[[nodiscard]] bool run_or_abandon(std::function<void()> work, std::chrono::milliseconds to_end = kToEnd);

/// Ends the process with this exit code, without destructors. Standard output is written out first; if that
/// fails, the exit code is `unwritten`.
[[noreturn]] void leave(int exit_code, int unwritten);

}  // namespace limitcheck::verify
